"""Pseudo-geodesics on smooth surfaces (§3.1): curves whose osculating planes enclose the angle θ with the surface.

A curve with unit tangent t bends by κ_n n + κ_g n × t. Its osculating plane encloses θ with the tangent plane when
κ_g = σ κ_n cot θ, σ = ±1 the side; it then contains sin θ n + σ cos θ n × t. θ = 90° gives geodesics. On a sphere of
radius R the curvature is 1 / (R sin θ): circles of radius R sin θ.
"""

from dataclasses import dataclass, replace

import numpy as np

from plisse.errors import InvalidDesign
from plisse.geometry.surface import Surface, SurfacePoints
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.stops import Stop, Trace

__all__ = ["trace"]

SMALLEST_ANGLE = np.radians(1.0)
SHARPEST = 0.5  # κ · step above which a curve counts as curled up
TURNS = 4 * np.pi  # geodesic turning after which it does, too
CLOSING = 0.05  # steps by which a closed curve may miss its beginning
HALVINGS = 16


def trace(surface: Surface, starts, directions, theta, side=1.0, *, length: float | None = None,
          step: float | None = None, both: bool = True, beyond: bool = False) -> tuple[Trace, ...]:
    """Pseudo-geodesics from `starts` (N, 3) in `directions` (N, 3); `theta` in radians and `side` ±1, one or (N,).

    Classical Runge–Kutta steps of arc length `step` (default: diagonal / 200), every stage projected onto the surface,
    all curves at once. Each curve runs at most `length` (default: three diagonals) each way; with `both` it is traced
    backwards as well. `beyond` continues over the boundary where the surface can. The side stays fixed along a curve;
    it does not follow the sign of κ_n.
    """
    limit = 3 * surface.diagonal if length is None else float(length)
    step = surface.diagonal / 200 if step is None else float(step)
    if not (step > 0 and 0 < limit < np.inf):
        raise InvalidDesign(f"curves cannot be traced over the length {limit:g} in steps of {step:g}; "
                            "give positive numbers")
    count = max(1, int(np.ceil(limit / step - 1e-9)))
    starts, directions, theta, side = _inputs(starts, directions, theta, side)
    cotangent = side / np.tan(theta)
    if not both:
        return _march(surface, starts, directions, cotangent, limit / count, count, beyond)
    # running backwards n × t changes its sign, and with it the side of the same plane
    curves = _march(surface, np.tile(starts, (2, 1)), np.concatenate([directions, -directions]),
                    np.concatenate([cotangent, -cotangent]), limit / count, count, beyond)
    return tuple(ahead if ahead.closed else Trace.both_ways(behind, ahead)
                 for ahead, behind in zip(curves[:len(starts)], curves[len(starts):], strict=True))


def _inputs(starts, directions, theta, side) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    starts = np.atleast_2d(np.asarray(starts, dtype=float))
    directions = np.broadcast_to(np.asarray(directions, dtype=float), starts.shape)
    theta = np.broadcast_to(np.asarray(theta, dtype=float), len(starts))
    side = np.broadcast_to(np.asarray(side, dtype=float), len(starts))
    if not ((theta >= SMALLEST_ANGLE) & (theta <= np.pi / 2 + 1e-12)).all():
        raise InvalidDesign(f"curves with inclination {np.degrees(theta.min()):.3g}° … {np.degrees(theta.max()):.3g}° "
                            "cannot be traced from a point and a direction; give inclinations from 1° to 90°")
    if not (np.isfinite(starts).all() and np.isfinite(directions).all()):
        raise InvalidDesign("the starting points and directions of traced curves must be finite numbers")
    return starts, directions, theta, side


@dataclass(frozen=True, eq=False)
class _State:
    """Heads of the curves under way: where they are, which way they run, how far they have turned."""

    index: np.ndarray
    at: SurfacePoints
    tangent: np.ndarray
    turning: np.ndarray
    cotangent: np.ndarray

    def select(self, which: np.ndarray) -> "_State":
        at = SurfacePoints(self.at.positions[which], self.at.normals[which], self.at.bending[which],
                           self.at.known[which])
        return _State(self.index[which], at, self.tangent[which], self.turning[which], self.cotangent[which])


def _march(surface: Surface, starts: np.ndarray, directions: np.ndarray, cotangent: np.ndarray, step: float,
           count: int, beyond: bool) -> tuple[Trace, ...]:
    """Curves in one direction, `count` steps long at most."""
    at = surface.project(starts)
    state = _State(np.arange(len(starts)), at, _tangential(directions, at.normals), np.zeros(len(starts)), cotangent)
    if not (norm(state.tangent) > 0.5).all():
        where = int(np.argmin(norm(state.tangent)))
        raise InvalidDesign(f"the direction at starting point {where} is normal to the surface; give a tangential one")
    origin = state
    stops = np.full(len(starts), Stop.LENGTH, dtype=object)
    rows, owners = [at.positions], [state.index]
    crossings: list[tuple[_State, _State]] = []
    for number in range(1, count + 1):
        if len(state.index) == 0:
            break
        after, curvature = _step(surface, state, step)
        ended = _ends(state, after, curvature, origin.select(state.index), step, number, beyond)
        for stop, which in ended.items():
            stops[state.index[which]] = stop
        if (crosses := ended[Stop.BOUNDARY]).any():
            crossings.append((state.select(crosses), after.select(crosses)))
        going = ~np.logical_or.reduce(list(ended.values()))
        state = after.select(going)
        rows.append(state.at.positions)
        owners.append(state.index)
    if crossings:
        owners += [before.index for before, _ in crossings]
        rows.append(_on_boundary(surface, crossings, step))
    return _collected(np.concatenate(rows), np.concatenate(owners), stops, step)


def _step(surface: Surface, state: _State, step: float | np.ndarray) -> tuple[_State, np.ndarray]:
    """One Runge–Kutta step, and the curvature (N,) at its beginning."""
    step = np.broadcast_to(np.asarray(step, dtype=float), len(state.index))[:, None]
    position, tangent = state.at.positions, state.tangent
    bend, turn = _bend(state.at, tangent, state.cotangent)
    first = tangent, bend
    slopes = [first]
    for part in (0.5, 0.5, 1.0):
        velocity, acceleration = slopes[-1]
        at = surface.project(position + part * step * velocity)
        direction = _tangential(tangent + part * step * acceleration, at.normals)
        slopes.append((direction, _bend(at, direction, state.cotangent)[0]))
    (v1, a1), (v2, a2), (v3, a3), (v4, a4) = slopes
    at = surface.project(position + step / 6 * (v1 + 2 * v2 + 2 * v3 + v4))
    direction = _tangential(tangent + step / 6 * (a1 + 2 * a2 + 2 * a3 + a4), at.normals)
    return replace(state, at=at, tangent=direction, turning=state.turning + turn * step[:, 0]), norm(bend)


def _bend(at: SurfacePoints, tangent: np.ndarray, cotangent: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Curvature vectors κ_n n + κ_g n × t (N, 3) and geodesic curvatures κ_g (N,)."""
    normal_curvature = np.einsum("ni,nij,nj->n", tangent, at.bending, tangent)
    geodesic_curvature = normal_curvature * cotangent
    across = np.cross(at.normals, tangent)
    return normal_curvature[:, None] * at.normals + geodesic_curvature[:, None] * across, geodesic_curvature


def _tangential(vectors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Unit tangent vectors; zero where nothing tangential is left."""
    flat = vectors - dot(vectors, normals)[:, None] * normals
    return np.where((norm(flat) > 1e-9 * norm(vectors))[:, None], unit(flat), 0.0)


def _ends(before: _State, after: _State, curvature: np.ndarray, origin: _State, step: float, number: int,
          beyond: bool) -> dict[Stop, np.ndarray]:
    """Which curves end in this step, and why; no curve for two reasons."""
    move = norm(after.at.positions - before.at.positions)
    curled = (curvature * step > SHARPEST) | (np.abs(after.turning) > TURNS)
    fine = np.isfinite(after.at.bending).all(axis=(1, 2)) & (move > 0.7 * step) & (move < 1.5 * step)
    lost = ~curled & ~(fine & (dot(after.tangent, before.tangent) > -0.5))
    boundary = ~lost & ~curled & ~after.at.known & (not beyond)
    closed = ~lost & ~curled & ~boundary & (number > 6) & _returns(before, after, origin, step)
    return {Stop.LEFT_CHART: lost, Stop.CURLED_UP: curled, Stop.BOUNDARY: boundary, Stop.CLOSED: closed}


def _returns(before: _State, after: _State, origin: _State, step: float) -> np.ndarray:
    """Whether this step passes the curve's beginning in its direction."""
    home, direction = origin.at.positions, origin.tangent
    came, goes = (dot(state.at.positions - home, direction) for state in (before, after))
    chord = after.at.positions - before.at.positions
    fraction = np.clip(-came / np.maximum(goes - came, 1e-300), 0, 1)
    # the arc lies beside its chord by up to κ step² / 8
    arc = 0.5 * fraction * (1 - fraction) * step
    sagitta = arc[:, None] * (before.tangent - after.tangent)
    miss = norm(before.at.positions + fraction[:, None] * chord + sagitta - home)
    # a head within a hundredth of a step before home is home: the polyline must not end in a tiny edge
    passes = (came < -0.01 * step) & (goes >= -0.01 * step)
    return passes & (miss < CLOSING * step) & (dot(after.tangent, direction) > 0.9)


def _on_boundary(surface: Surface, crossings: list[tuple[_State, _State]], step: float) -> np.ndarray:
    """Last known points (N, 3) of the steps that cross the boundary: halvings of their cubics, projected."""
    begin, end = (np.concatenate([pair[i].at.positions for pair in crossings]) for i in (0, 1))
    leave, arrive = (step * np.concatenate([pair[i].tangent for pair in crossings]) for i in (0, 1))
    low, high, best = np.zeros((len(begin), 1)), np.ones((len(begin), 1)), begin
    for _ in range(HALVINGS):
        s = 0.5 * (low + high)
        cubic = ((1 + 2 * s) * begin + s * leave) * (1 - s) ** 2 + ((3 - 2 * s) * end - (1 - s) * arrive) * s**2
        found = surface.project(cubic)
        known = found.known[:, None]
        low, high = np.where(known, s, low), np.where(known, high, s)
        best = np.where(known, found.positions, best)
    return best


def _collected(points: np.ndarray, owners: np.ndarray, stops: np.ndarray, step: float) -> tuple[Trace, ...]:
    if len(stops) == 0:
        return ()
    order = np.argsort(owners, kind="stable")
    pieces = np.split(points[order], np.cumsum(np.bincount(owners, minlength=len(stops)))[:-1])
    return tuple(Trace(_without_stub(piece, step), stop) for piece, stop in zip(pieces, stops, strict=True))


def _without_stub(points: np.ndarray, step: float) -> np.ndarray:
    """Leave out the last point but one where the boundary cut the last step to almost nothing; a start remains."""
    if len(points) < 2 or norm(points[-1] - points[-2]) > 0.05 * step:
        return points
    return points[:1] if len(points) == 2 else np.delete(points, -2, axis=0)
