"""What a fit makes small: distances from guides in amplitudes, and hinges against faces turning over."""

import numpy as np

from plisse.geometry.components import dot
from plisse.solve.principal.guide import nearest_on_rulings, off_tangent
from plisse.solve.principal.march import Crease
from plisse.solve.principal.strip import Strip, successor
from plisse.solve.principal.target import Target

__all__ = ["off_guide", "regularity_hinges", "rim_hinges", "rim_miss", "rim_reach"]

_FLATTEST = np.radians(20.0)  # ruling angles below this are pushed up
_NARROWEST = 0.25  # of the typical width
_SHORTEST = 0.35  # of the mean edge length, signed along the neighbouring crease
_REACH = (0.3, 2.0)  # how far, in typical widths, rims are looked for


def off_guide(target: Target, crease: int, points: np.ndarray) -> np.ndarray:
    """Offsets from the guide in amplitudes, (B, 3 n); feet belong to the first member of the batch."""
    foot, tangent = target.polylines[crease].feet(points[:, 0])
    offset = off_tangent(points, foot, tangent) / target.amplitude * target.weights
    return np.moveaxis(offset, 1, 0).reshape(points.shape[1], -1)


def rim_reach(target: Target, crease: int, strip: Strip) -> tuple[np.ndarray, np.ndarray]:
    """By how much rulings miss the next crease's guide, signed, and where on the ruling (B, n) that is."""
    width = target.widths[crease]
    _, reach = _toward(target, crease, strip, np.full(strip.points.shape[-1], width))
    return _toward(target, crease, strip, np.clip(np.nan_to_num(reach[0], nan=width), *_reach(width)))


def rim_miss(target: Target, crease: int, strip: Strip) -> tuple[np.ndarray, np.ndarray]:
    """Distances of rulings from the next guide in amplitudes, and where on them, in widths: (B, n)."""
    miss, reach = rim_reach(target, crease, strip)
    return miss / target.amplitude * target.weights, reach / target.widths[crease]


def rim_hinges(target: Target, crease: int, strip: Strip, reach: np.ndarray) -> list[np.ndarray]:
    """Hinges for a free rim at `reach` (B, n) widths: it stays in front, and its edges run forward."""
    distance = np.clip(reach, *_REACH) * target.widths[crease]
    return _masked(target, [3 * _hinge(reach, _NARROWEST),
                            10 * _hinge(_advance(target, crease, strip, distance), _SHORTEST)])


def regularity_hinges(target: Target, crease: int, before: Strip, found: Crease) -> list[np.ndarray]:
    """Hinges on sin β, distance, signed edge lengths and the angle of the rulings beyond."""
    flat = np.sin(_FLATTEST)
    count = found.sine.shape[-1]
    along = np.abs(dot(found.beyond.rulings[..., :count], found.beyond.edges))
    return _masked(target, [10 * _hinge(found.sine, flat),
                            10 * _hinge(found.distances / target.widths[crease], _NARROWEST),
                            10 * _hinge(_advance(target, crease, before, found.distances), _SHORTEST),
                            5 / flat * _hinge(1 - along, 1 - np.cos(_FLATTEST))])


def _toward(target: Target, crease: int, strip: Strip, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    foot, tangent = target.polylines[crease].feet(strip.points[:, 0] + distance * strip.rulings[:, 0])
    return nearest_on_rulings(strip.points, strip.rulings, foot, tangent)


def _reach(width: float) -> tuple[float, float]:
    return _REACH[0] * width, _REACH[1] * width


def _advance(target: Target, crease: int, strip: Strip, distance: np.ndarray) -> np.ndarray:
    """Edges of the crease at a distance (B, n), along the strip's crease, in mean edge lengths (B, faces)."""
    points = strip.points + distance * strip.rulings
    edges = (successor(points) - points)[..., :strip.edges.shape[-1]]
    return dot(edges, strip.edges) / target.edge_lengths[crease]


def _hinge(values: np.ndarray, least: float) -> np.ndarray:
    return np.maximum(0.0, least - values)


def _masked(target: Target, hinges: list[np.ndarray]) -> list[np.ndarray]:
    """Inside the window only; what is not finite outside of it must not count either."""
    return [np.where(target.weights[:hinge.shape[-1]] > 0, hinge, 0.0) for hinge in hinges]
