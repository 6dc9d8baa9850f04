"""Explicit principal structures, crease by crease: `python benchmarks/marching.py`."""

import numpy as np

from cases import shipped
from clocks import alone, turns
from plisse.geometry.components import cross
from plisse.recipe import Helix, March
from plisse.solve.marching import marched_design
from plisse.solve.principal.march import next_crease
from plisse.solve.principal.seed import rectifying_binormals, seed_strip
from plisse.solve.principal.strip import Strip

TITLE = "Marching"
SAMPLES, TOGETHER = 243, 100


def measured(quick: bool = False) -> dict:
    """Seconds of whole marches, and of one crease on one strip and on a hundred at once."""
    repeats = 2 if quick else 10
    helix = Helix(radius=100, pitch=110, turns=1.1)
    shell = shipped("march-shell")
    whole = {"12 × 243": (helix, March(creases=12, distance=6, samples=SAMPLES)), "march-shell": (shell.curve, shell.march)}
    rows = []
    for name, (curve, march) in whole.items():
        found = marched_design(curve, march)
        clocks = turns(repeats, it=lambda curve=curve, march=march: marched_design(curve, march))["it"]
        rows.append({"name": name, "vertices": found.structure.topology.vertex_count, **clocks})
    one, many = _seed(1), _seed(TOGETHER)
    clocks = turns(10 * repeats, one=lambda: _next(one), many=lambda: _next(many))
    return {"rows": rows, "samples": SAMPLES, "together": TOGETHER, "crease": clocks,
            "million_vertices_per_second": TOGETHER * SAMPLES / clocks["many"]["cpu"] / 1e6}


def _seed(count: int) -> Strip:
    """Strips of a helix that open by slightly different angles."""
    turn = np.linspace(0, 2.2 * np.pi, SAMPLES)
    points = np.stack([100 * np.cos(turn), 100 * np.sin(turn), 17.5 * turn])[:, None]
    upwards = np.broadcast_to(np.array([0.0, 0, 1])[:, None, None], (3, 1, SAMPLES - 1))
    binormals = rectifying_binormals(points, upwards)
    return seed_strip(points, binormals, np.radians(np.linspace(43, 47, count)), 1.0)


def _next(strip: Strip) -> None:
    """The crease that starts parallel to the strip's own, at a distance of 6."""
    middle = SAMPLES // 2
    ruling, edge, normal = strip.rulings[..., middle], strip.edges[..., middle], strip.normals[..., middle]
    across = (cross(ruling, normal) * edge).sum(axis=0)
    count = len(across)
    next_crease(strip, np.full(count, 6.0), np.pi - np.arctan2(across, (ruling * edge).sum(axis=0)),
                np.full(count, -np.pi / 2))


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Principal structures that are exact by construction, without any linear algebra; processor milliseconds.", "",
           "| | vertices | ms |", "|---|--:|--:|"]
    out += [f"| march {row['name']} | {row['vertices']:,} | {1000 * row['cpu']:.1f} |" for row in found["rows"]]
    crease, count = found["crease"], found["together"]
    out += [f"| one crease | {found['samples']} | {1000 * crease['one']['cpu']:.2f} |",
            f"| {count} creases at once | {count * found['samples']:,} | {1000 * crease['many']['cpu']:.1f} |"]
    return [*out, "", f"At once that is {found['million_vertices_per_second']:.1f} million vertices per second."]


if __name__ == "__main__":
    alone(measured)
