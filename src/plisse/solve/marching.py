"""Explicit designs: principal structures marched outwards from a curve, three numbers per crease (§2.4, §2.5)."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from plisse.errors import Infeasible
from plisse.geometry.components import cross
from plisse.geometry.curves import seed_curve
from plisse.geometry.frames import regularised_frame
from plisse.geometry.polyline import arc_length
from plisse.geometry.vectors import unit
from plisse.recipe import Curve, March
from plisse.solve.living import Extent, living_part
from plisse.solve.masked import MaskedGrid
from plisse.solve.principal.closed import close_crease, closed_crease
from plisse.solve.principal.march import Crease, next_crease
from plisse.solve.principal.seed import rectifying_binormals, seed_strip
from plisse.solve.principal.series import SmoothCurve
from plisse.solve.principal.strip import Strip, edge_directions
from plisse.structure.pleated import PleatedStructure

__all__ = ["Marched", "marched_design"]

FINE = 401
SEED_TOLERANCE = 1e-4
SMOOTHING = 0.05
SHORTEST = 0.1
CLOSES = 1e-9


@dataclass(frozen=True, eq=False)
class Marched:
    """An exact principal structure, not developed, and sentences about where it ended before the design did."""

    structure: PleatedStructure
    notes: list[str]


def marched_design(curve: Curve, recipe: March) -> Marched:
    """The structure that a curve and the numbers of a march determine.

    Creases get an odd number of samples, so that a vertex lies in the middle. Where strips die the structure ends, and
    notes say where and why. Raises Infeasible where fewer than three creases remain.
    """
    samples = recipe.samples + 1 - recipe.samples % 2
    notes = [] if samples == recipe.samples else [f"march.samples was raised from {recipe.samples} to {samples}, because "
                                                  "the numbers of a crease belong to a vertex in its middle"]
    strips, numbers = _seed_strips(curve, recipe, samples), _numbers(recipe)
    rows, extents = {recipe.seed_index: strips[0].points[:, 0]}, dict[int, Extent]()
    for side, strip in zip((1, -1), strips, strict=True):
        notes += _march(strip, side, numbers, recipe, curve.closed, rows, extents)
    if len(rows) < 3:
        raise Infeasible("fewer than three creases remain: " + "; ".join(notes))
    return Marched(_assembled(rows, extents, curve.closed), notes)


def _seed_strips(curve: Curve, recipe: March, samples: int) -> tuple[Strip, Strip]:
    """The strips on both sides of the seed, which is a smooth series whatever the number of samples."""
    points = seed_curve(curve, FINE)
    length = arc_length(points, curve.closed)[-1]
    binormal = regularised_frame(points, curve.closed, SMOOTHING * length).binormal
    between = np.roll(binormal, -1, axis=0) + binormal if curve.closed else binormal[1:] + binormal[:-1]
    smooth = SmoothCurve.fitted(points.T, unit(between).T, curve.closed, SEED_TOLERANCE * length)
    seed = smooth.points(samples)
    binormals = rectifying_binormals(seed, smooth.midpoint_reference(samples), curve.closed)
    lean = np.radians(recipe.turn) * (-1.0) ** np.arange(binormals.shape[-1])
    edges = edge_directions(seed, curve.closed)
    binormals = np.cos(lean) * binormals + np.sin(lean) * cross(edges, binormals)
    half = np.array([np.radians(recipe.opening) / 2])
    after, before = (seed_strip(seed, binormals, half, side, curve.closed) for side in (1.0, -1.0))
    return after, before


def _numbers(recipe: March) -> np.ndarray:
    """Distance, direction and fold angle (m, 3) of every crease in radians; distances from the side of the seed."""
    count, seed = recipe.creases, recipe.seed_index
    strips = _along_family(recipe.distance, (np.arange(count - 1) + 0.5) / (count - 1))
    distance = np.concatenate([strips[:seed], [0.0], strips[seed:]])
    position = np.arange(count) / (count - 1)
    fold = 180 - recipe.opening if recipe.fold is None else recipe.fold
    return np.stack([distance, np.radians(_along_family(recipe.direction, position)),
                     np.radians(_along_family(fold, position))], axis=1)


def _along_family(value, positions: np.ndarray) -> np.ndarray:
    """One number for each position from a value, a list, or a profile [[position, value], …]."""
    values = np.asarray(value, dtype=float)
    if values.ndim < 2:
        return np.broadcast_to(values, positions.shape)
    return PchipInterpolator(*values.T)(np.clip(positions, *values[[0, -1], 0]))


def _march(strip: Strip, side: int, numbers: np.ndarray, recipe: March, closed: bool, rows: dict[int, np.ndarray],
           extents: dict[int, Extent]) -> list[str]:
    """Fill `rows` (3, n) and the extents of strips, outwards on one side; sentences about what died."""
    faces = strip.normals.shape[-1]
    notes: list[str] = []
    extent = Extent(0, faces, "", "")
    outwards = range(recipe.seed_index + side, recipe.creases if side > 0 else -1, side)
    for step, number in enumerate(outwards):
        distance, direction, fold = numbers[number]
        # mountain and valley in turn; seen from the two sides of the seed a fold has opposite signs
        crease, gap = _next(strip, distance, direction, -side * (-1) ** step * fold, closed)
        grown = living_part(strip, crease.distances, extent, closed)
        if gap > CLOSES or grown.faces < max(3, SHORTEST * faces):
            why = f"it misses itself by {gap:.1e}" if gap > CLOSES else grown.before or grown.beyond
            return [*notes, f"the structure ends before crease {number + 1} of the design, because {why}"]
        notes += _shortened(number, extent, grown, faces)
        extent, strip = grown, crease.beyond
        rows[number], extents[min(number, number - side)] = strip.points[:, 0], extent
    return notes


def _next(strip: Strip, distance: float, direction: float, fold: float, closed: bool) -> tuple[Crease, float]:
    """The next crease, turned by `direction` from the last one, and by how much a closed one misses itself."""
    direction += _parallel(strip, closed)
    with np.errstate(all="ignore"):
        if not closed:
            return next_crease(strip, *np.array([[distance], [direction], [fold]])), 0.0
        found, gap = close_crease(strip, np.array([distance]), np.array([[direction, fold]]))
        return closed_crease(strip, np.array([distance]), *found.T), float(np.nan_to_num(gap[0], nan=np.inf))


def _parallel(strip: Strip, closed: bool) -> float:
    """The direction β, against the ruling taken backward, of a crease that starts parallel to the strip's own."""
    at = 0 if closed else strip.points.shape[-1] // 2
    ruling, faces = strip.rulings[:, 0, at], [at - 1, at]
    edges, normals = strip.edges[:, 0, faces], strip.normals[:, 0, faces]
    across = cross(np.repeat(ruling[:, None], 2, axis=1), normals)
    return float(np.pi - np.arctan2((edges * across).sum(axis=0), ruling @ edges).mean())


def _shortened(number: int, before: Extent, now: Extent, faces: int) -> list[str]:
    """Where a crease is shorter than the last one although that one ran to the end of the curve."""
    notes = []
    if now.before and before.first == 0:
        notes.append(f"from crease {number + 1} of the design on the structure begins at {100 * now.first / faces:.0f} % of "
                     f"the curve, because there {now.before}")
    if now.beyond and before.end == faces:
        notes.append(f"from crease {number + 1} of the design on the structure ends at {100 * now.end / faces:.0f} % of the "
                     f"curve, because there {now.beyond}")
    return notes


def _assembled(rows: dict[int, np.ndarray], extents: dict[int, Extent], closed: bool) -> PleatedStructure:
    numbers = sorted(rows)
    vertices = np.concatenate([rows[number].T for number in numbers])
    columns = len(vertices) // len(numbers)
    mask = np.zeros((len(numbers) - 1, columns - (not closed)), bool)
    for row, number in zip(mask, numbers, strict=False):
        row[extents[number].first:extents[number].end] = True
    part = MaskedGrid.of((len(numbers), columns), closed, mask)
    return PleatedStructure(part.topology, vertices[part.used])
