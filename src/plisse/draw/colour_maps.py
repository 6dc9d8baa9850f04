"""Qualities of a structure as colours: planarity, angle sums, principal defect, openings, deviation (Figs 17, 19, 21)."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from plisse.draw import colours
from plisse.draw.scale import Scale, defect_scale, linear_scale
from plisse.measure.deviation import crease_deviation
from plisse.measure.folds import fold_angles
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect, principal_defect
from plisse.result import Result
from plisse.solve.zigzag import zigzag_curves
from plisse.structure.pattern import Pattern
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["NAMES", "ColourMap", "colour_maps", "deviation_from_guides", "deviation_from_surface", "deviation_of"]

@dataclass(frozen=True, eq=False)
class ColourMap:
    """Values at all corners (C,) in the order of `topology.corners`, nan where there is none, and their scale."""

    name: str
    title: str
    values: np.ndarray
    scale: Scale
    palette: Literal["quality", "opening"] = "quality"

    def colours(self, values: np.ndarray) -> np.ndarray:
        """Colours (…, 3) of values (…,)."""
        shares = self.scale.shares(values)
        paint = colours.quality if self.palette == "quality" else colours.opening
        return np.where(np.isnan(shares)[..., None], colours.rgb(colours.UNKNOWN), paint(np.nan_to_num(shares)))

    @property
    def label(self) -> str:
        """The title up to its colon: the few words of a button."""
        return self.title.partition(":")[0]

    @property
    def largest(self) -> float:
        """The largest value."""
        return float(np.nanmax(self.values, initial=0.0))

    @property
    def smallest(self) -> float:
        """The smallest value."""
        return float(np.nanmin(self.values, initial=np.inf))


def colour_maps(structure: PleatedStructure, deviation: ColourMap | None = None) -> dict[str, ColourMap]:
    """All maps that the structure allows, by name; `deviation` needs to know what the structure should be near to."""
    maps = [*(make(structure) for make in MAPS.values()), deviation]
    return {found.name: found for found in maps if found is not None}


def _planarity(structure: PleatedStructure) -> ColourMap:
    values = planarity_defect(structure.topology, structure.vertices)[structure.topology.corners.face]
    return ColourMap("planarity", "planarity: distance of diagonals / length", values, defect_scale(values.max()))


def _angle(structure: PleatedStructure) -> ColourMap:
    values = np.abs(angle_defect(structure.topology, structure.vertices))[structure.topology.corners.vertex]
    return ColourMap("angle", "angle sum: |Σω − 2π| in radians", values, defect_scale(values.max()))


def _principal(structure: PleatedStructure) -> ColourMap:
    values = principal_defect(structure.topology, structure.vertices)[structure.topology.corners.vertex]
    return ColourMap("principal", "principal defect: |ω1 + ω3 − π| in radians", values, defect_scale(values.max()))


def _opening(structure: PleatedStructure) -> ColourMap | None:
    openings = _openings(structure)
    if not np.isfinite(openings).any():
        return None
    scale = linear_scale(float(np.nanmin(openings)), float(np.nanmax(openings)), "°", least=5.0)
    return ColourMap("opening", "opening angle of creases: 180° is flat", openings, scale, "opening")


# a map has the name of its entry, and is None where the structure has nothing to show
MAPS: dict[str, Callable[[PleatedStructure], ColourMap | None]] = {
    "planarity": _planarity, "angle": _angle, "principal": _principal, "opening": _opening}
NAMES = (*MAPS, "deviation")


def deviation_of(result: Result) -> ColourMap | None:
    """The deviation from the surface, or else from the guiding curves, of a result that knows them."""
    structure, pattern = result.structure, result.pattern
    if structure is None or result.family:
        return None
    if result.overlay is not None:
        return deviation_from_surface(structure.topology, result.overlay.distances, result.overlay.amplitude)
    amplitude = getattr(result.design.pattern, "amplitude", None)
    if pattern is None or amplitude is None:
        return None
    return deviation_from_guides(structure, pattern, amplitude)


def deviation_from_surface(topology: Topology, distances: np.ndarray, amplitude: float) -> ColourMap | None:
    """Distances (F,) of faces from a reference surface in amplitudes; None where they are not of these faces."""
    if len(distances) != topology.face_count:
        return None
    return _deviation("deviation: of the mid-surface from the reference in amplitudes",
                      (np.abs(distances) / amplitude)[topology.corners.face])


def deviation_from_guides(structure: PleatedStructure, pattern: Pattern, amplitude: float) -> ColourMap | None:
    """Distances of creases from the zigzag of a pattern in amplitudes; None where creases are not those of the pattern."""
    topology = structure.topology
    samples, rest = divmod(topology.vertex_count, pattern.creases)
    if rest or topology.hubs or samples < 2:
        return None
    guides = zigzag_curves(pattern.resampled(samples), amplitude)
    distances = crease_deviation(structure.vertices.reshape(pattern.creases, samples, 3), guides, pattern.closed)
    return _deviation("deviation: of creases from the pattern in amplitudes",
                      (distances.ravel() / amplitude)[topology.corners.vertex])


def _deviation(title: str, values: np.ndarray) -> ColourMap:
    known = values[np.isfinite(values)]
    most = float(known.max()) if len(known) else 1.0
    return ColourMap("deviation", title, values, linear_scale(0.0, most, least=0.1))


def _openings(structure: PleatedStructure) -> np.ndarray:
    """Opening angles in degrees at corners (C,): of the crease through the vertex, on the rim of that across the strip."""
    topology = structure.topology
    edges, corner = topology.edges, topology.corners
    inner = edges.is_crease & ~edges.is_boundary
    opening = 180 - np.degrees(np.abs(fold_angles(topology, structure.vertices)[inner]))
    ends = edges.vertices[inner].ravel()
    count = np.bincount(ends, minlength=topology.vertex_count)
    mean = np.bincount(ends, opening.repeat(2), topology.vertex_count) / np.where(count > 0, count, np.nan)
    across = np.where(corner.next_is_crease, corner.previous, corner.next)
    return np.where(np.isnan(mean[corner.vertex]), mean[across], mean[corner.vertex])
