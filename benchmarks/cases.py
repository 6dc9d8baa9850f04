"""The designs that are measured."""

from msgspec.structs import replace

from plisse.io.designs import read_design
from plisse.layout.guiding import guiding
from plisse.recipe import Design
from plisse.shipped import shipped_design
from plisse.solve.zigzag import zigzag
from plisse.structure.pleated import PleatedStructure

__all__ = ["HELIX", "helix", "helix_settings", "shipped", "zigzagged"]

HELIX = "fig15b"  # three quarters of a turn of a helix, 14 creases
THETA = 20.0


def shipped(name: str) -> Design:
    """A design of the gallery."""
    return read_design(str(shipped_design(name)))


def helix(creases: int, samples: int) -> Design:
    """Pleats on a helix on any grid: the strips together are as wide as those of the shipped design."""
    design = shipped(HELIX)
    return replace(design, pattern=replace(design.pattern, **helix_settings(creases, samples)))


def helix_settings(creases: int, samples: int) -> dict:
    """What `helix` changes in the pattern of the shipped design."""
    pattern = shipped(HELIX).pattern
    scale = (pattern.creases - 1) / (creases - 1)
    return {"theta": THETA, "creases": creases, "samples": samples, "width": pattern.width * scale,
            "amplitude": pattern.amplitude * scale}


def zigzagged(design: Design) -> PleatedStructure:
    """Where the solvers of a design on a curve start (§3.3)."""
    guide = guiding(design.curve, design.pattern)
    return zigzag(guide.pattern.resampled(guide.samples), guide.amplitude)
