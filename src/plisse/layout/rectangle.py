"""The largest usable rectangle of a family, or what is wrong with the family."""

import numpy as np

from plisse.errors import Infeasible
from plisse.layout.crossing import trajectories
from plisse.layout.family import Family
from plisse.layout.stops import Stop

__all__ = ["GAPS", "PROBES", "usable_rectangle"]

PROBES = 160  # trajectories by which the usable rectangle is found
GAPS = (0.35, 2.9)  # usable gaps, relative to the width of the strip at the guide
SHORTEST = 1.5  # mean widths that creases must be long


def usable_rectangle(family: Family, crop: bool, gaps: tuple[float, float]) -> tuple[slice, int, tuple[float, float]]:
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
