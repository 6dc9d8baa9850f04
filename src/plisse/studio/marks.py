"""What stands in the scene beside the structure: the seed curve, the reference surface, the places of problems."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.curves import seed_curve
from plisse.layout.coverage import AreaSamples, located, reach_of
from plisse.recipe import MILLIMETRES, Recipe
from plisse.result import Report, Result
from plisse.structure.front import front_up
from plisse.structure.place import vertex_named
from plisse.structure.pleated import PleatedStructure

__all__ = ["Reference", "overlap_of", "reference_of", "seed_line", "trouble_of"]

CURVE_POINTS = 400


@dataclass(frozen=True, eq=False)
class Reference:
    """A reference surface: points (N, 3), triangles (T, 3), and which of them (T,) lie under the structure."""

    points: np.ndarray
    triangles: np.ndarray
    is_covered: np.ndarray


def seed_line(recipe: Recipe) -> np.ndarray | None:
    """Points (N, 3) along the curve that a design starts from, None where there is none."""
    curve = getattr(recipe, "curve", None)
    if curve is None:
        return None
    points = seed_curve(curve, CURVE_POINTS)
    return np.concatenate([points, points[:1]]) if curve.closed else points


def reference_of(result: Result) -> Reference | None:
    """The reference surface of a result, None where there is none."""
    mesh = result.overlay.mesh if result.overlay is not None else result.surface
    if mesh is None:
        return None
    covered = np.ones(len(mesh.triangles), bool)
    if result.overlay is not None and result.structure is not None:
        structure = result.structure
        reach = reach_of(result.overlay.amplitude, structure.mean_edge)
        middles = AreaSamples.of(mesh.vertices, mesh.triangles, levels=0)
        covered = located(middles, structure.vertices[structure.topology.quads], reach) >= 0
    return Reference(mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32), covered)


def trouble_of(structure: PleatedStructure, report: Report) -> np.ndarray | None:
    """Where (3,) the first sentence of a report that names a place points to."""
    for sentence in [*report.reasons, *report.warnings]:
        vertex = vertex_named(structure.topology, sentence)
        if vertex is not None:
            return structure.vertices[vertex]
    return None


def overlap_of(structure: PleatedStructure, report: Report) -> np.ndarray | None:
    """The place (2,) where the sheet overlaps, in the frame of `flat_view`."""
    if structure.development is None or report.development is None or report.development.overlap_at_mm is None:
        return None
    place = np.array(report.development.overlap_at_mm) / MILLIMETRES[report.units]
    mirrored = not np.shares_memory(front_up(structure), structure.development)
    return place * [-1.0, 1.0] if mirrored else place
