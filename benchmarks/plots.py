"""The look of the pictures: colours that colour-blind readers can tell apart, markers that differ too."""

from pathlib import Path

__all__ = ["COLOURS", "MARKERS", "logarithmic", "panels", "saved"]

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#555555")  # Okabe and Ito
MARKERS = ("o", "s", "^", "D", "v", "P", "X")


def panels(count: int, *, height: float = 3.6):
    """A figure with `count` panels, up to three in a row or else two, and the panels; `height` of a row in inches."""
    from matplotlib.figure import Figure

    columns = count if count <= 3 else 2
    rows = -(-count // columns)
    figure = Figure(figsize=({1: 7.5, 2: 9.5, 3: 11.5}[columns], height * rows), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for panel in axes[count:]:
        panel.remove()
    for panel in axes[:count]:
        panel.grid(True, which="major", color="#dddddd", linewidth=0.7)
        panel.set_axisbelow(True)
        panel.spines[["top", "right"]].set_visible(False)
    return figure, axes[:count]


def logarithmic(panel, axes: str = "x") -> None:
    """Make axes of a panel ("x", "y", "xy") logarithmic, with labels at powers of ten only."""
    from matplotlib.ticker import NullFormatter

    for name in axes:
        panel.set(**{f"{name}scale": "log"})
        getattr(panel, f"{name}axis").set_minor_formatter(NullFormatter())


def saved(figure, path: Path) -> None:
    """Write the picture as PNG."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110, facecolor="white", metadata={"Software": None})
