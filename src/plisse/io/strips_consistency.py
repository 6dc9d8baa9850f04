"""What the numbers of a strips section must be to the rest of its design."""

from plisse.errors import InvalidDesign
from plisse.recipe import Design, Strips, SurfaceDesign

__all__ = ["check_strips", "check_surface_strips", "check_thickness"]

THICKEST = 0.5  # of the width


def check_surface_strips(design: SurfaceDesign) -> None:
    """Nothing; raises InvalidDesign where strips over a surface miss something or contradict each other."""
    strips, surface = design.strips, design.surface
    assert strips is not None
    if not surface.has_guide:
        raise InvalidDesign("strips over a surface are shot from a guide, and there is none; give surface.guide, "
                            "surface.guide_section or surface.guide_boundary")
    for name in ("theta", "spacing"):
        if getattr(strips, name) is None:
            raise InvalidDesign(f"strips.{name} is missing; strips over a surface need it")
    for name in ("theta", "width", "amplitude", "creases"):
        if getattr(design.pattern, name) is not None:
            raise InvalidDesign(f"pattern.{name} belongs to pleats, but this design has a strips section; give "
                                "strips.theta, strips.spacing and strips.width instead")
    check_thickness(strips)


def check_strips(design: Design) -> None:
    """Nothing; raises InvalidDesign where strips along curves contradict the design that has the curves."""
    strips = design.strips
    if strips is None:
        return
    for name in ("theta", "spacing"):
        if getattr(strips, name) is not None:
            raise InvalidDesign(f"strips.{name} belongs to strips over a surface, but this design has none; its curves come "
                                "from the pattern, so remove it")
    if design.parallel is not None:
        raise InvalidDesign("a design has either a parallel section or a strips section; remove one")
    check_thickness(strips)


def check_thickness(strips: Strips) -> None:
    """Nothing; raises InvalidDesign where strips are bars."""
    if strips.thickness is not None and strips.thickness > THICKEST * strips.width:
        raise InvalidDesign(f"the thickness of strips is {strips.thickness:g}, more than half of their width "
                            f"{strips.width:g}; give less")
