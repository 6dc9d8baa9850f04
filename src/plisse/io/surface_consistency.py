"""What the options of a surface section must be to each other: one sentence for every contradiction."""

import math

from plisse.errors import InvalidDesign
from plisse.io.strips_consistency import check_surface_strips
from plisse.layout.positions import upright_amplitude
from plisse.recipe import Surface, SurfaceDesign, SurfacePattern

__all__ = ["check_surface_design"]

KINDS = ("file", "height", "radius", "torus")
WAYS = ("guide", "guide_file", "guide_section", "guide_boundary", "point", "centre")


def check_surface_design(design: SurfaceDesign) -> SurfaceDesign:
    """The same design; raises InvalidDesign where its options contradict each other."""
    surface = design.surface
    _check_kind(surface)
    _check_way(surface)
    if design.strips is not None:
        check_surface_strips(design)
    else:
        (_check_guided if surface.is_guided else _check_whole)(design)
    if surface.handles is not None and surface.edited_file is not None:
        raise InvalidDesign("surface.handles and surface.edited_file are both given; edit the surface in one way")
    if surface.edited_file is not None and surface.file is None:
        raise InvalidDesign("surface.edited_file needs surface.file, the same mesh before it was edited")
    if design.solve.weights is not None and not any(design.solve.weights):
        raise InvalidDesign("solve.weights are all 0, so there is nothing to minimise; give at least one above 0")
    return design


def _check_kind(surface: Surface) -> None:
    given = [name for name in KINDS if getattr(surface, name) is not None]
    if len(given) != 1:
        found = "both " + " and ".join(f"surface.{name}" for name in given) if given else \
            "neither surface.file nor surface.height nor another kind"
        raise InvalidDesign(f"a surface is one of file, height, radius, torus, but {found} is given; give one of them")
    for name, (low, high) in (("x", surface.x), ("y", surface.y)):
        if not low < high:
            raise InvalidDesign(f"surface.{name} is [{low:g}, {high:g}]; give two rising numbers")


def _check_way(surface: Surface) -> None:
    """At most one place where creases start, with directions of its kind."""
    given = [f"surface.{name}" for name in WAYS if getattr(surface, name) is not None]
    if len(given) > 1:
        raise InvalidDesign(f"{' and '.join(given[:2])} are both given; creases start in one way")
    if surface.guide_closed and surface.guide is None and surface.guide_file is None:
        raise InvalidDesign("surface.guide_closed closes the points of surface.guide or surface.guide_file, but neither is "
                            "given; remove it")
    directions = surface.directions
    if surface.point is not None and directions is not None and not isinstance(directions, list):
        raise InvalidDesign(f"surface.directions is {directions}, but around surface.point they are a range; give "
                            "[from, to] in degrees, or leave it out for all directions")
    if surface.point is None and isinstance(directions, list):
        raise InvalidDesign(f"surface.directions is {directions}, a range, but there is no surface.point; along a guide "
                            "give \"tuned\", \"orthogonal\" or an angle")
    if isinstance(directions, list) and not 0 < directions[1] - directions[0] < 360:
        raise InvalidDesign(f"surface.directions is {directions}; give [from, to] rising by less than 360 degrees, or leave "
                            "it out for all directions")


def _check_guided(design: SurfaceDesign) -> None:
    surface, pattern = design.surface, design.pattern
    needed = ("theta", "width", "amplitude") + (() if surface.has_guide else ("creases",))
    way = next(name for name in WAYS if getattr(surface, name) is not None)
    for name in needed:
        if getattr(pattern, name) is None:
            raise InvalidDesign(f"pattern.{name} is missing; a layout along surface.{way} needs it")
    assert pattern.theta is not None
    if pattern.initial == "normal":
        raise InvalidDesign("pattern.initial = \"normal\" shows the failure of whole surfaces; remove it or "
                            f"surface.{way}")
    for name in ("handles", "edited_file"):
        if getattr(surface, name) is not None:
            raise InvalidDesign(f"surface.{name} edits a whole surface that was laid out, not a family along "
                                f"surface.{way}; edit the file itself, or remove one of them")
    if surface.seams is not None:
        raise InvalidDesign(f"surface.seams cut a whole surface apart, not a family along surface.{way}; remove one of them")
    if surface.overhang is False:
        _check_upright(pattern)
    if surface.boundary and surface.beyond:
        raise InvalidDesign("surface.boundary keeps creases inside the boundary, surface.beyond lets them leave it; give "
                            "one of them")
    if surface.crop == "outline":
        _check_outline(design)


def _check_upright(pattern: SurfacePattern) -> None:
    assert pattern.theta is not None
    assert pattern.width is not None
    assert pattern.amplitude is not None
    limit = upright_amplitude(math.radians(pattern.theta), pattern.width)
    if pattern.amplitude >= limit:
        least = f"at this width and theta amplitudes from {limit:.3g} on overhang" if limit > 0 else \
            f"pattern.theta is {pattern.theta:g}, and pleats overhang from 45 degrees on"
        raise InvalidDesign(f"surface.overhang = false, but {least}; give a smaller theta or amplitude, or allow it")


def _check_outline(design: SurfaceDesign) -> None:
    surface, solve = design.surface, design.solve
    if surface.guide_closed or surface.guide_boundary is not None or (surface.point is not None and not surface.directions):
        raise InvalidDesign("surface.crop = \"outline\" is for open families, and this one closes around the surface; "
                            "remove it")
    if solve.principal or solve.method == "paper":
        name = "solve.principal" if solve.principal else "solve.method = \"paper\""
        raise InvalidDesign(f"{name} needs a whole grid, and surface.crop = \"outline\" leaves a part of one; remove one of "
                            "them")


def _check_whole(design: SurfaceDesign) -> None:
    surface, pattern, solve = design.surface, design.pattern, design.solve
    for name in ("directions", "reach", "beyond"):
        if getattr(surface, name):
            raise InvalidDesign(f"surface.{name} belongs to creases that start from a guide or a point; give one, or "
                                "remove it")
    if surface.crop == "rectangle":
        raise InvalidDesign("surface.crop = \"rectangle\" belongs to creases that start from a guide or a point; a whole "
                            "surface is always cropped to its outline, so remove it")
    if pattern.creases is not None:
        raise InvalidDesign("pattern.creases is for creases from a guide or a point; over a whole surface give "
                            "pattern.width")
    if pattern.samples is not None and (surface.handles is not None or surface.edited_file is not None
                                        or pattern.initial == "normal"):
        raise InvalidDesign("pattern.samples refines a surface as it was laid out, not one that was edited or badly "
                            "started; remove it")
    if pattern.initial == "normal" and None in (surface.centre, pattern.width, pattern.amplitude):
        raise InvalidDesign("pattern.initial = \"normal\" needs surface.centre, pattern.width and pattern.amplitude")
    if pattern.initial == "normal" and surface.seams:
        raise InvalidDesign("pattern.initial = \"normal\" shows a failure in one piece; remove it or surface.seams")
    if solve.principal and (pattern.samples is not None or pattern.initial == "normal"):
        name = "pattern.samples" if pattern.samples is not None else "pattern.initial = \"normal\""
        raise InvalidDesign(f"solve.principal does not go with {name} over a whole surface; remove one of them")
    if solve.method == "paper":
        raise InvalidDesign("solve.method = \"paper\" is for creases from a guide or a point; over a whole surface the "
                            "parts that cannot become exact have to be left out, which it cannot do")
    if solve.cut is not None:
        raise InvalidDesign("solve.cut is for closed creases from a guide; remove it")
