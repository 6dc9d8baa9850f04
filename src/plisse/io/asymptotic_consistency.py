"""What the options of a pattern along asymptotic curves must be to each other: one sentence for every contradiction."""

from plisse.errors import InvalidDesign
from plisse.memory import peak_bytes, refuse_too_large
from plisse.recipe import AsymptoticDesign

__all__ = ["check_asymptotic_design"]

MAX_FACES = 250_000
WIDEST = 4  # creases side by side, for each crease of a sector
SLIMMEST = 100  # times as long as wide
KINDS = ("file", "formula", "weierstrass")


def check_asymptotic_design(design: AsymptoticDesign) -> AsymptoticDesign:
    """The same design; raises InvalidDesign where its options contradict each other."""
    surface, pattern = design.surface, design.pattern
    given = [f"surface.{name}" for name in KINDS if getattr(surface, name) is not None]
    if len(given) != 1:
        found = " and ".join(given) + " are" if given else "none is"
        raise InvalidDesign("asymptotic curves need one surface, a file, a formula or weierstrass data, but "
                            f"{found} given; give one of them")
    for name, (low, high) in (("x", surface.x), ("y", surface.y)):
        if not low < high:
            raise InvalidDesign(f"surface.{name} is [{low:g}, {high:g}]; give two rising numbers")
    sides = sorted((surface.x[1] - surface.x[0], surface.y[1] - surface.y[0]))
    if surface.file is None and sides[1] > SLIMMEST * sides[0]:
        raise InvalidDesign(f"the range of surface.x and surface.y is a strip {sides[0]:.3g} wide and {sides[1]:.3g} long "
                            f"(limit 1 : {SLIMMEST}); give ranges more alike")
    if surface.smoothing is not None and surface.file is None:
        raise InvalidDesign(f"surface.smoothing is for a mesh file, and {given[0]} is exact; remove it")
    if pattern.creases * pattern.columns * 6 > MAX_FACES:
        raise InvalidDesign(f"pattern.creases × pattern.columns = {pattern.creases * pattern.columns} per sector are more "
                            "than plisse solves; lower one of them")
    refuse_too_large(peak_bytes(6 * pattern.creases * pattern.columns, WIDEST * pattern.creases),
                     f"pattern.creases × pattern.columns = {pattern.creases * pattern.columns} per sector",
                     "lower one of them")
    if pattern.amplitude is not None and pattern.width is not None and not 0.02 < pattern.amplitude / pattern.width < 10:
        raise InvalidDesign(f"pattern.amplitude is {pattern.amplitude:g} and pattern.width {pattern.width:g}; give an "
                            "amplitude of about half the width")
    if pattern.hub_size is not None and pattern.reach is not None and pattern.hub_size >= pattern.reach:
        raise InvalidDesign(f"pattern.hub_size is {pattern.hub_size:g} and pattern.reach {pattern.reach:g}, so that no "
                            "columns have room between them; give a smaller hub_size")
    return design
