"""What the numbers of a design must be to each other, beyond the type of each."""

import math
from itertools import pairwise

import numpy as np

from plisse.errors import InvalidDesign
from plisse.io.march_consistency import check_march
from plisse.io.strips_consistency import check_strips
from plisse.memory import peak_bytes, refuse_too_large
from plisse.recipe import (
    Arc,
    ClosedForm,
    ConicCreases,
    Curve,
    Design,
    Ellipse,
    Helix,
    March,
    Pattern,
    Points,
    Spline,
    TorusKnot,
)

__all__ = ["check_design"]

MAX_VERTICES = 250_000
LARGEST_RATIO = 1e5


def check_design(design: Design) -> Design:
    """The same design; raises InvalidDesign where its numbers contradict each other."""
    check_strips(design)
    if design.closed_form is not None:
        if design.curve is not None or design.pattern is not None or design.march is not None:
            raise InvalidDesign("a design has either closed_form or curve and pattern, but this one has both; remove one")
        _check_size("closed_form", design.closed_form)
        form = design.closed_form
        if isinstance(form, ConicCreases) and form.growth**form.creases > LARGEST_RATIO:
            raise InvalidDesign(f"closed_form.growth = {form.growth:g} over {form.creases} creases makes the last one "
                                f"{form.growth**form.creases:.0e} times as large as the first; lower one of them")
        return design
    if design.march is not None:
        return _check_marched(design, design.march)
    if design.curve is None or design.pattern is None:
        section = "curve" if design.curve is None else "pattern"
        raise InvalidDesign(f"{section} is missing; add a [{section}] section, as `plisse gallery fig01d` shows")
    _check_size("pattern", design.pattern, principal=design.solve.principal, closed=design.curve.closed)
    _check_pattern(design.pattern)
    if design.curve.closed:
        _check_ring(design.pattern.width)
    if design.curve.closed and design.pattern.samples < 5:
        raise InvalidDesign(f"pattern.samples is {design.pattern.samples}, too few for a closed curve; give at least 5")
    if design.solve.cut is not None and not design.curve.closed:
        raise InvalidDesign("solve.cut is set, but the curve is open and needs no cut; remove it or set curve.closed")
    if design.solve.weights is not None and not any(design.solve.weights):
        raise InvalidDesign("solve.weights are all 0, so there is nothing to minimise; give at least one above 0")
    _check_curve(design.curve)
    _check_scale(_size(design.curve), design.pattern)
    return design


def _check_marched(design: Design, march: March) -> Design:
    """The same design; raises InvalidDesign where curve and march do not make one."""
    if design.curve is None:
        raise InvalidDesign("curve is missing; add a [curve] section from which the creases march, as `plisse gallery "
                            "march-shell` shows")
    _check_size("march", march)
    check_march(march, closed=design.curve.closed)
    if design.solve.cut is not None and not design.curve.closed:
        raise InvalidDesign("solve.cut is set, but the curve is open and needs no cut; remove it or set curve.closed")
    _check_curve(design.curve)
    _check_lengths("march.distance", march.distance, _size(design.curve))
    return design


def _check_size(section: str, grid: Pattern | March | ClosedForm, *, principal: bool = False, closed: bool = False) -> None:
    """Refuse sizes that take too long, or more memory than there is."""
    vertices = grid.creases * grid.samples
    if vertices > MAX_VERTICES:
        raise InvalidDesign(f"{section}.creases × {section}.samples = {vertices} vertices is more than plisse solves "
                            f"({MAX_VERTICES}, about a minute and 2 GB); lower {section}.samples")
    peak = peak_bytes(vertices, min(grid.creases, grid.samples), principal=principal, closed=closed)
    refuse_too_large(peak, f"{section}.creases × {section}.samples = {vertices} vertices", f"lower {section}.samples")


def _check_pattern(pattern: Pattern) -> None:
    if isinstance(pattern.theta, list) and len(pattern.theta) != pattern.creases:
        raise InvalidDesign(f"pattern.theta has {len(pattern.theta)} values, but pattern.creases is "
                            f"{pattern.creases}; give one value, or one per crease")
    _check_width(pattern.width, pattern.creases)


def _check_scale(size: float, pattern: Pattern) -> None:
    """Refuse lengths so different that they belong to different units."""
    _check_lengths("pattern.width", pattern.width, size)
    _check_lengths("pattern.amplitude", pattern.amplitude, size)
    widths = _lengths(pattern.width)
    if not 1 / LARGEST_RATIO < pattern.amplitude / widths.min() < LARGEST_RATIO:
        raise InvalidDesign(f"pattern.amplitude is {pattern.amplitude:g} and pattern.width {widths.min():g}; "
                            "give an amplitude of about half the width")


def _check_lengths(name: str, value: float | list, size: float) -> None:
    """Refuse a length, or a list or profile of lengths, of another scale than the curve."""
    least, most = size / LARGEST_RATIO, 10 * size
    for k, length in enumerate(_lengths(value)):
        if not least < length < most:
            place = f"{name}[{k}]" if isinstance(value, list) else name
            raise InvalidDesign(f"{place} is {length:g}, but the curve measures {size:.3g} model units; give a length "
                                f"between {least:.4g} and {most:.4g}, or the curve in the same units")


def _lengths(value: float | list) -> np.ndarray:
    """The lengths (N,) in one length, a list of them, or a profile [[position, length], …]."""
    lengths = np.array(value, dtype=float)
    return lengths[:, 1] if lengths.ndim == 2 else np.atleast_1d(lengths)


def _size(curve: Curve) -> float:
    """Rough extent of a curve in model units."""
    if isinstance(curve, Spline | Points):
        columns = list(zip(*(curve.points or []), strict=True))
        return max(max(column) - min(column) for column in columns)
    if isinstance(curve, Arc):
        return curve.radius * min(math.radians(curve.angle), 2)
    if isinstance(curve, Helix):
        return max(curve.radius * min(2 * math.pi * curve.turns, 2), abs(curve.pitch) * curve.turns)
    return max(curve.a, curve.b) if isinstance(curve, Ellipse) else curve.R


def _check_curve(curve: Curve) -> None:
    if isinstance(curve, Spline | Points):
        _check_points(curve)
        if isinstance(curve, Points) and curve.smooth > _size(curve):
            raise InvalidDesign(f"curve.smooth is {curve.smooth:g}, more than the whole curve measures; give less")
    elif isinstance(curve, Helix) and curve.closed:
        raise InvalidDesign("curve.closed is true, but a helix never closes; set curve.closed = false")
    elif isinstance(curve, Arc | Ellipse) and curve.closed and curve.angle < 360:
        raise InvalidDesign(f"curve.angle is {curve.angle} degrees, but curve.closed asks for a closed curve; "
                            "set curve.closed = false or curve.angle = 360")
    elif isinstance(curve, TorusKnot) and math.gcd(curve.p, curve.q) != 1:
        raise InvalidDesign(f"curve.p = {curve.p} and curve.q = {curve.q} have a common divisor, so the torus knot "
                            "would run over itself; give numbers without one")
    elif isinstance(curve, TorusKnot) and curve.r >= curve.R:
        raise InvalidDesign(f"curve.r = {curve.r} is not smaller than curve.R = {curve.R}; give a thinner tube")


def _check_points(curve: Spline | Points) -> None:
    points = curve.points or []
    least = 4 if curve.closed else 3
    if len(points) < least:
        raise InvalidDesign(f"curve.points has {len(points)} points; give at least {least}")
    if len(points) > 100_000:
        raise InvalidDesign(f"curve.points has {len(points)} points; give at most 100000")
    size = _size(curve)
    last = len(points) if curve.closed and points[0] != points[-1] else len(points) - 1
    for i in range(last):
        j = (i + 1) % len(points)
        if math.dist(points[i], points[j]) <= 1e-9 * size:
            raise InvalidDesign(f"curve.points[{i}] and curve.points[{j}] are the same point {points[i]}; remove one")
    if not curve.closed and math.dist(points[0], points[-1]) <= 1e-9 * size:
        raise InvalidDesign("curve.points begins and ends in the same point; set curve.closed = true and leave out the last")
    largest = max(abs(x) for p in points for x in p)
    if largest > 1e12 or size < 1e-9 * largest or size < 1e-12:
        raise InvalidDesign(f"curve.points span {size:g} model units at coordinates up to {largest:g}; "
                            "that is lost in rounding, so scale or move the curve")


def _check_ring(width: object) -> None:
    """On closed curves positions 0 and 1 are one place."""
    if not isinstance(width, list) or not isinstance(width[0], list):
        return
    first, last = width[0], width[-1]
    if last[0] - first[0] == 1 and first[1] != last[1]:
        raise InvalidDesign(f"pattern.width is {first[1]:g} at position 0 and {last[1]:g} at position 1, but on a closed "
                            "curve these are one place; give one width for both")


def _check_width(width: object, creases: int) -> None:
    if not isinstance(width, list):
        return
    tables = [isinstance(entry, list) for entry in width]
    if any(tables) and not all(tables):
        raise InvalidDesign("pattern.width mixes lengths and [position, width] rows; give one kind")
    if not all(tables) or not width:
        if len(width) != creases - 1:
            raise InvalidDesign(f"pattern.width has {len(width)} values, but {creases} creases have {creases - 1} "
                                "strips between them; give one value, one per strip, or a table [[position, width], …]")
        return
    for k, row in enumerate(width):
        if len(row) != 2 or row[1] <= 0 or not 0 <= row[0] <= 1:
            raise InvalidDesign(f"pattern.width[{k}] is {row}; give [position from 0 to 1 along the curve, width above 0]")
    positions = [row[0] for row in width]
    if len(width) < 2 or any(b <= a for a, b in pairwise(positions)):
        raise InvalidDesign(f"pattern.width has the positions {positions}; give at least two, in increasing order")
