"""How lines of a flat drawing look: in the colours that machines tell apart, or printed for people."""

from dataclasses import dataclass

from plisse.draw import colours

__all__ = ["MACHINE", "PRINT", "Stroke"]


@dataclass(frozen=True)
class Stroke:
    """Colour #rrggbb, width in millimetres, and dash: lengths on, off, on, off in millimetres (empty: drawn through)."""

    colour: str
    width: float = 0.1
    dash: tuple[float, ...] = ()


# Origami Simulator tells lines by these colours, laser software sorts operations by any; dashes would become cuts
MACHINE = {
    "mountain": Stroke("#ff0000"),
    "valley": Stroke("#0000ff"),
    "boundary": Stroke("#000000"),
    "cut": Stroke("#000000"),
    "ruling": Stroke("#ffff00"),
    "flat": Stroke("#ff00ff"),
    "text": Stroke("#008000"),
}

# mountains dash-dotted and valleys dashed, as in origami diagrams: told apart without colour too
PRINT = {
    "mountain": Stroke(colours.MOUNTAIN, 0.25, (4.0, 1.0, 0.5, 1.0)),
    "valley": Stroke(colours.VALLEY, 0.25, (2.2, 1.1)),
    "boundary": Stroke(colours.INK, 0.3),
    "cut": Stroke(colours.INK, 0.3),
    "ruling": Stroke(colours.RULING, 0.08),
    "flat": Stroke(colours.CAPTION, 0.15, (0.5, 1.0)),
    "text": Stroke(colours.INK, 0.2),
}
