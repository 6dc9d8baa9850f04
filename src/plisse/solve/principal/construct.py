"""The explicit construction as such: seed polyline and numbers in, exact principal structure out (§2.5)."""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.components import cross, dot, norm, unit
from plisse.solve.principal.closed import close_crease, closed_crease
from plisse.solve.principal.march import next_crease
from plisse.solve.principal.seed import rectifying_binormals, seed_strip
from plisse.solve.principal.strip import Strip, edge_directions

__all__ = ["march_closed", "march_structure"]

_CLOSED = 1e-9  # largest gap of a crease that counts as closed


def march_structure(seed: np.ndarray, half_opening: np.ndarray | float, after: np.ndarray,
                    before: np.ndarray | None = None, *, rims: tuple[float, float] | None = None,
                    reference: np.ndarray | None = None) -> np.ndarray:
    """Vertices (m, n, 3) of the principal structure through an open seed polyline (n, 3).

    `after` (k, 3) has distance t, direction β and signed fold angle φ of the creases after the seed, outwards,
    each prescribed in the middle; a β of nan means parallel to the crease before. `before` has those on the
    other side. Each side ends with a free rim at the distances `rims` (before, after; by default the last t).
    For pleats φ alternates, beginning negative after and positive before the seed, whose own fold angle is
    π − 2 half_opening. Everything may carry a batch axis in front: seed (B, n, 3) or (n, 3), half_opening (B,),
    after and before (B, k, 3), and the vertices are (B, m, n, 3).
    `reference` (3,) says on which side of the seed the strips lie; by default its mean binormal.
    """
    return _structure(seed, half_opening, after, before, rims, reference, False)


def march_closed(seed: np.ndarray, half_opening: np.ndarray | float, after: np.ndarray,
                 before: np.ndarray | None = None, *, rims: tuple[float, float] | None = None,
                 reference: np.ndarray | None = None) -> np.ndarray:
    """Like `march_structure` for closed seeds (n, 3), the first point not repeated; n should be odd.

    Numbers belong to vertex and face 0; t is kept, β and φ are guesses from which the closing ones are
    found. Raises `Infeasible` where a crease does not close.
    """
    return _structure(seed, half_opening, after, before, rims, reference, True)


def _structure(seed, half_opening, after, before, rims, reference, closed: bool) -> np.ndarray:
    after = np.asarray(after, dtype=float)
    before = np.zeros((*after.shape[:-2], 0, 3)) if before is None else np.asarray(before, dtype=float)
    single = np.ndim(seed) == 2 and np.ndim(half_opening) == 0 and after.ndim == 2
    points, half, numbers = _batched(np.asarray(seed, dtype=float), half_opening, (before, after))
    with np.errstate(all="ignore"):
        binormals = rectifying_binormals(points, _reference(points, reference, closed), closed)
        sides = [_march(seed_strip(points, binormals, half, sign, closed), trios, rim, closed)
                 for sign, trios, rim in zip((-1, 1), numbers, rims or (None, None), strict=True)]
    creases = np.stack([*sides[0][::-1], points, *sides[1]])
    vertices = creases.transpose(2, 0, 3, 1)
    return vertices[0] if single else vertices


def _march(strip: Strip, trios: np.ndarray, rim: float | None, closed: bool) -> list[np.ndarray]:
    """Creases (3, B, n) with numbers (B, k, 3) on one side, then the rim; none without numbers and rim."""
    creases: list[np.ndarray] = []
    for distance, given, fold in trios.transpose(1, 2, 0):
        direction = np.where(np.isnan(given), _parallel(strip, closed), given)
        if closed:
            guess = np.stack([direction, fold], axis=-1)
            closing, gap = close_crease(strip, distance, guess)
            if not gap.max() < _CLOSED:
                raise Infeasible(f"closed crease {len(creases) + 1} from the seed misses itself "
                                 f"by {gap.max():.1e} rad")
            strip = closed_crease(strip, distance, *closing.T).beyond
        else:
            strip = next_crease(strip, distance, direction, fold).beyond
        creases.append(strip.points)
    last = trios[:, -1, 0] if trios.shape[1] else None
    reach = np.full(strip.points.shape[1], rim) if rim is not None else last
    if reach is not None:
        creases.append(strip.points + reach[:, None] * strip.rulings)
    return creases


def _parallel(strip: Strip, closed: bool) -> np.ndarray:
    """Direction β (B,) of a crease parallel to the strip's, where numbers are prescribed."""
    vertex = 0 if closed else strip.points.shape[-1] // 2
    along = unit(strip.edges[..., vertex - 1] + strip.edges[..., vertex])
    ruling = strip.rulings[..., vertex]
    return np.pi - np.arctan2(norm(cross(ruling, along)), dot(ruling, along))


def _batched(seed: np.ndarray, half_opening, sides: tuple) -> tuple[np.ndarray, np.ndarray, list[np.ndarray]]:
    """Component-first seeds (3, B, n), half openings (B,) and numbers (B, k, 3) of both sides, of one B."""
    seed = seed if seed.ndim == 3 else seed[None]
    half = np.atleast_1d(np.asarray(half_opening, dtype=float))
    trios = [side if side.ndim == 3 else side[None] for side in sides]
    count = max(len(seed), len(half), *(len(side) for side in trios))
    points = np.broadcast_to(seed, (count, *seed.shape[1:])).transpose(2, 0, 1)
    trios = [np.broadcast_to(side, (count, *side.shape[1:])) for side in trios]
    return points, np.broadcast_to(half, count), trios


def _reference(points: np.ndarray, reference: np.ndarray | None, closed: bool) -> np.ndarray:
    """A constant field (3, B, faces): the given direction or the mean binormal."""
    edges = edge_directions(points, closed)
    if reference is None:
        turning = cross(edges[..., :-1], edges[..., 1:])
        direction = unit(turning.sum(axis=-1))[..., None]
    else:
        direction = np.asarray(reference, dtype=float)[:, None, None]
    return np.broadcast_to(direction, edges.shape)
