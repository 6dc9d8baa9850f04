"""From a family of curves to a pattern: columns along its orthogonal trajectories, cropped to a rectangle (§3.3).

Trajectories start on one crease and cross to the next so that their chord makes equal angles with both. Around a closed
family they do not come back to where they began; the miss is spread evenly over all steps, so that columns close.
"""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.family import Family, fan, shoot
from plisse.layout.guides import Guide, boundary_guide, guide_through
from plisse.layout.stops import Stop
from plisse.structure.pattern import Pattern, interpolate_along

__all__ = ["fan_pattern", "guided_pattern", "pattern_of", "trajectories"]

PROBES = 160  # trajectories by which the usable rectangle is found
GAPS = (0.35, 2.9)  # usable gaps, relative to the width of the strip at the guide
SHORTEST = 1.5  # mean widths that creases must be long
NEWTON_STEPS = 6
CLOSING_STEPS = 12


@dataclass(frozen=True, eq=False)
class Crossing:
    """Trajectories across a family: arc lengths (m, n) on every curve, nan past its end, and `points` (m, n, 3).

    `gaps` (strips, n) are the distances between neighbouring curves along trajectories.
    """

    at: np.ndarray
    points: np.ndarray
    gaps: np.ndarray

    def usable(self, family: Family, limits: tuple[float, float]) -> np.ndarray:
        """Mask (strips, n − 1 or n) of the cells whose corners exist, in order, with gaps within limits of nominal."""
        count = len(family.curves)
        relative = self.gaps / family.spacing[:, None]
        with np.errstate(invalid="ignore"):
            good = (relative > limits[0]) & (relative < limits[1])
            steps = np.diff(self.at, axis=1)
            rising = steps > 0.1 * np.nanmedian(steps)
        following = (np.arange(len(good)) + 1) % count
        if family.closed_curves:
            return good & np.roll(good, -1, axis=1)
        return good[:, 1:] & good[:, :-1] & rising[:len(good)] & rising[following]


def trajectories(family: Family, start: int, at: np.ndarray) -> Crossing:
    """Orthogonal trajectories from arc lengths (n,) on the curve number `start`."""
    count = len(family.curves)
    if family.closed:
        return _crossing(family, np.roll(_closed(family, start, at), start, axis=0))
    rows: dict[int, np.ndarray] = {start: at}
    for towards in (1, -1):
        row = start
        while 0 <= row + towards < count:
            rows[row + towards] = _opposite(family, row, row + towards, rows[row])
            row += towards
    return _crossing(family, np.stack([rows[row] for row in range(count)]))


def pattern_of(family: Family, surface: Surface, amplitude: float, samples: int, *, crop: bool = True,
               gaps: tuple[float, float] = GAPS) -> Pattern:
    """Curves with offset directions cos θ n + sin θ m on the largest usable rectangle of a family.

    Without `crop` all curves must be used, and only the columns are chosen. `gaps` are the smallest and the largest
    usable distance between curves, relative to the width of their strip at the guide. Curves are shifted across
    themselves where local gaps differ from those at the guide, so that strips mirror in their creases everywhere.
    Raises Infeasible where too little of the family is usable.
    """
    rows, start, window = _rectangle(family, crop, gaps)
    closed_curves = family.closed_curves
    part = Family(family.curves[rows], family.theta,
                  family.spacing if family.closed else family.spacing[rows.start:rows.stop - 1], family.closed,
                  family.turns[rows], family.side)
    at = np.linspace(*window, samples, endpoint=not closed_curves)
    crossing = trajectories(part, start - rows.start, at)
    side = np.where((np.arange(len(crossing.at)) + rows.start) % 2, 1.0, -1.0)
    shift = side[:, None] * _local_shift(crossing.gaps, side[0], family, amplitude)
    across = family.side * _across(crossing.points, surface.project(crossing.points.reshape(-1, 3)).normals, closed_curves)
    shifted = surface.project((crossing.points + shift[..., None] * across).reshape(-1, 3))
    points, normals = (field.reshape(crossing.points.shape) for field in (shifted.positions, shifted.normals))
    across = family.side * _across(points, shifted.normals, closed_curves)
    binormals = np.cos(family.theta) * normals + np.sin(family.theta) * across
    if rows.start % 2:  # the first crease of a pattern lies below, this one above: turn the pattern upside down
        binormals = -binormals
    following = np.roll(points, -1, axis=0) if family.closed else points[1:]
    widths = norm(following - points[:len(following)])
    return Pattern(points, binormals, np.full(len(points), family.theta), widths, closed_curves, family.closed)


def guided_pattern(surface: Surface, mesh: ReferenceMesh | None, guide, *, theta: float, width: float,
                   amplitude: float, creases: int | None = None, samples: int = 60, angle: float = 90.0,
                   closed_family: bool = False, tuned: bool = True, length: float | None = None,
                   beyond: bool = False) -> Pattern:
    """The pattern of pseudo-geodesics of inclination `theta` (degrees) that cross a guide at an angle (degrees).

    `guide` is a Guide, or points (K, 3): two are joined by a geodesic, more by a smooth curve, which `closed_family`
    closes; "boundary" is the longest boundary loop of the mesh. The number of creases is kept when it is given,
    otherwise the largest usable rectangle decides. Raises Infeasible, saying where, if the family falls into disarray.
    """
    theta = _checked(theta)
    if isinstance(guide, str):
        if guide != "boundary" or mesh is None:
            raise InvalidDesign("a guide is a list of points, or \"boundary\" on a surface that is a mesh")
        guide = boundary_guide(surface, mesh)
    elif not isinstance(guide, Guide):
        guide = guide_through(surface, guide, closed_family)
    family = shoot(surface, guide, theta=theta, width=width, amplitude=amplitude, creases=creases,
                   angle=np.radians(angle), tuned=tuned, length=length, beyond=beyond)
    return pattern_of(family, surface, amplitude, samples, crop=creases is None)


def fan_pattern(surface: Surface, point, *, theta: float, amplitude: float, creases: int, radius: float,
                samples: int = 60, sector: tuple[float, float] | None = None, towards=None, side: float = 1.0,
                length: float | None = None, gaps: tuple[float, float] = GAPS, beyond: bool = False) -> Pattern:
    """The pattern of pseudo-geodesics of inclination `theta` (degrees) that leave a point (see `fan`).

    A full fan is a closed family; a `sector` (degrees) is open. It begins and ends where the creases are gaps[0] and
    gaps[1] times as far apart as on a flat disk of the given radius.
    """
    angles = None if sector is None else (float(np.radians(sector[0])), float(np.radians(sector[1])))
    family = fan(surface, point, theta=_checked(theta), creases=creases, radius=radius, sector=angles, towards=towards,
                 side=side, length=length, beyond=beyond)
    return pattern_of(family, surface, amplitude, samples, crop=False, gaps=gaps)


def _checked(theta: float) -> float:
    """Inclination in radians."""
    if not 0 < theta < 90:
        raise InvalidDesign(f"pattern.theta is {theta:g}; creases guided on a surface need an inclination above 0 and "
                            "below 90 degrees")
    return float(np.radians(theta))


def _across(points: np.ndarray, normals: np.ndarray, closed: bool) -> np.ndarray:
    """Unit tangents m = t × n (m, n, 3) across curves."""
    parameters = np.linspace(0, 1, points.shape[1], endpoint=not closed)
    velocity = interpolate_along(points, closed)(parameters, 1).swapaxes(0, 1)
    normals = normals.reshape(points.shape)
    return unit(np.cross(velocity - dot(velocity, normals)[..., None] * normals, normals))


def _local_shift(gaps: np.ndarray, first_side: float, family: Family, amplitude: float) -> np.ndarray:
    """Half of what (s1 − s2)/2 lacks (m, n) at every curve, s1 and s2 the strips beside it."""
    if family.closed:
        before, after = np.roll(gaps, 1, axis=0), gaps
    else:
        before, after = np.concatenate([gaps[1:2], gaps]), np.concatenate([gaps, gaps[-2:-1]])
    side = first_side * np.where(np.arange(len(before)) % 2, -1.0, 1.0)[:, None]
    mean, half = 0.5 * (before + after), 0.5 * side * (before - after)  # below (side −1) the strip after it climbs
    slope = max(np.sin(family.theta) / amplitude, 1e-9)
    wanted = (np.sqrt((slope * mean) ** 2 + 1) - 1) / slope
    return 0.5 * (wanted - half)


def _crossing(family: Family, at: np.ndarray) -> Crossing:
    points = np.stack([spline(row) for spline, row in zip(family.splines, at, strict=True)])
    following = np.roll(points, -1, axis=0)[:len(family.spacing)]
    return Crossing(at, points, norm(following - points[:len(following)]))


def _closed(family: Family, start: int, at: np.ndarray) -> np.ndarray:
    """Arc lengths (m, n) on the curves from `start` on, once around: steps are slanted so that columns close.

    The slant, the same at every step of a column, is found by the secant method.
    """
    count = len(family.curves)
    order = (start + np.arange(count + 1)) % count
    share = family.spacing[order[:-1]] / family.spacing.sum()

    def around(slant: np.ndarray) -> np.ndarray:
        rows = [at]
        for step in range(count):
            rows.append(_opposite(family, order[step], order[step + 1], rows[-1]) - share[step] * slant)
        return np.stack(rows)

    # a family with rotational symmetry has columns at equal distances from the guide
    slant = np.sum([_opposite(family, order[step], order[step + 1], at) - at for step in range(count)], axis=0)
    before, rows = slant + 1e-3 * family.spacing.sum(), around(slant)
    miss, missed = rows[-1] - at, around(before)[-1] - at
    for _ in range(CLOSING_STEPS):
        if not np.nanmax(np.abs(miss), initial=0) > 1e-9 * family.spacing.sum():
            break
        slope = (miss - missed) / np.where(slant == before, np.nan, slant - before)
        step = np.nan_to_num(miss / np.where(np.abs(slope) > 1e-3 * share.max(), slope, np.nan))
        before, missed, slant = slant, miss, slant - step
        rows = around(slant)
        miss = rows[-1] - at
    rows[:, ~(np.abs(miss) < 1e-3 * family.spacing.mean())] = np.nan
    return rows[:-1]


def _opposite(family: Family, row: int, following: int, at: np.ndarray) -> np.ndarray:
    """Arc lengths on a neighbouring curve whose chords make equal angles with both; nan past its ends."""
    spline, neighbour = family.splines[row], family.splines[following]
    origin, tangent = spline(at), unit(spline(at, 1))
    low, high = neighbour.x[[0, -1]]
    slack = 0.0 if family.closed_curves else 1e-9 * (high - low)
    longest = 2 * float(family.spacing.mean())
    found = at.copy()
    for _ in range(NEWTON_STEPS):
        held = found if family.closed_curves else np.clip(found, low, high)  # straight beyond the ends
        velocity = neighbour(held, 1)
        both = tangent + unit(velocity)
        error = dot(neighbour(held) + (found - held)[:, None] * velocity - origin, both)
        found = found - np.clip(error / np.maximum(dot(velocity, both), 0.4), -longest, longest)
    if family.closed_curves:
        return found
    with np.errstate(invalid="ignore"):
        return np.where((found >= low - slack) & (found <= high + slack), found, np.nan)


def _rectangle(family: Family, crop: bool, gaps: tuple[float, float]) -> tuple[slice, int, tuple[float, float]]:
    """Curves of the largest usable rectangle, the curve where its columns start, and their range on it."""
    count, ranges = len(family.curves), family.ranges
    whole = family.closed or not crop
    shortest = int(np.argmin(np.ptp(ranges, axis=1)))
    best, found = 0.0, None
    for start in [0] if family.closed else sorted({count // 2, count // 4, (3 * count) // 4, shortest}):
        at = np.linspace(ranges[start, 0], ranges[start, 1], PROBES, endpoint=not family.closed_curves)
        crossing = trajectories(family, start, at)
        top, bottom, left, right = _largest(crossing.usable(family, gaps), crossing.gaps, start, whole,
                                            family.closed_curves)
        area = float(np.nansum(crossing.gaps[top:bottom, left:right])) * float(at[1] - at[0])
        if area > best:
            window = ranges[start] if family.closed_curves else at[[left, right]]
            best, found = area, (slice(0, count) if whole else slice(top, bottom + 1), start, window)
    if found is None or np.ptp(found[2]) < SHORTEST * family.spacing.mean():
        raise Infeasible(_disarray(family, gaps))
    rows, start, window = found
    return rows, start, (float(window[0]), float(window[1]))


def _largest(usable: np.ndarray, gaps: np.ndarray, start: int, all_rows: bool,
             all_columns: bool) -> tuple[int, int, int, int]:
    """First and last strip (exclusive), first and last column (exclusive) of the largest usable rectangle.

    It must touch the curve `start`, for trajectories begin there.
    """
    strips, columns = usable.shape
    height = np.where(usable, np.nan_to_num(gaps[:, :columns]), 0.0)
    best, found = 0.0, (0, 0, 0, 0)
    tops = [0] if all_rows else range(strips)
    for top in tops:
        alive = np.ones(columns, dtype=bool)
        depth = np.zeros(columns)
        for bottom in range(top, strips):
            alive &= usable[bottom]
            depth += height[bottom]
            if not alive.any():
                break
            if (all_rows and bottom < strips - 1) or not top <= start <= bottom + 1 or (all_columns and not alive.all()):
                continue
            padded = np.concatenate([[False], alive, [False]]).astype(int)
            edges = np.flatnonzero(np.diff(padded)).reshape(-1, 2)
            total = np.concatenate([[0.0], np.cumsum(depth)])
            for left, right in edges:
                area = total[right] - total[left]
                if area > best and (bottom - top >= 1):
                    best, found = area, (top, bottom + 1, int(left), int(right))
    return found


def _disarray(family: Family, limits: tuple[float, float]) -> str:
    """What is wrong with a family that has no usable rectangle."""
    count = len(family.curves)
    lean = f"theta ({np.degrees(family.theta):.3g}°)"
    curled = [index for index, curve in enumerate(family.curves) if Stop.CURLED_UP in (curve.stop, curve.first_stop)]
    if curled:
        index = curled[len(curled) // 2]
        reach = float(np.abs(family.ranges[index]).max())
        return (f"curve {index + 1} of {count} curls up within {reach:.4g} of the guide: raise {lean} towards 90, or "
                "cross the surface with another guide")
    start = count // 2
    crossing = trajectories(family, start, np.linspace(family.ranges[start, 0], family.ranges[start, 1], PROBES))
    relative = crossing.gaps / family.spacing[:, None]
    middle = int(np.argmin(np.abs(crossing.at[start])))
    for offset in range(PROBES):
        for column in {max(middle - offset, 0), min(middle + offset, PROBES - 1)}:
            gaps = relative[:, column]
            if (gaps <= limits[0]).any() or (gaps >= limits[1]).any():
                narrow = bool((gaps <= limits[0]).any())
                strip = int(np.nanargmin(gaps) if narrow else np.nanargmax(gaps))
                where = abs(float(crossing.at[start, column]))
                what = "run together and would cross" if narrow else "run apart"
                return (f"curves {strip + 1} and {(strip + 1) % count + 1} of {count} {what} {where:.4g} from the guide: "
                        f"change {lean}, give fewer creases, or another guide")
    short = int(np.argmin(np.ptp(family.ranges, axis=1)))
    if family.curves[short].stop is Stop.LENGTH:
        return f"the creases are not longer than {SHORTEST:g} widths; give a larger length or a smaller width"
    return (f"curve {short + 1} of {count} is only {np.ptp(family.ranges[short]):.4g} long ({family.curves[short].stop}): "
            "give fewer creases, or a guide through the middle of the surface")
