"""Pictures of a report page as SVG within it: the flat sheet and the convergence history."""

import numpy as np

from plisse.draw import colours
from plisse.draw.drawing import crease_pattern
from plisse.draw.shapes import Line
from plisse.structure.pleated import PleatedStructure

__all__ = ["history_svg", "key_svg", "measured", "sheet_svg"]

STYLES = {"ruling": (colours.RULING, 0.35, ""), "boundary": (colours.INK, 1.0, ""), "flat": (colours.CAPTION, 0.8, "2 3"),
          "valley": (colours.VALLEY, 1.1, "7 4"), "mountain": (colours.MOUNTAIN, 1.1, "12 3 2 3")}
WIDTH, HEIGHT, LEFT, BELOW = 460, 300, 56, 44


def sheet_svg(structure: PleatedStructure, units: str) -> str:
    """The development with its layers; lines keep their width however large it is shown. Empty without development."""
    if structure.development is None:
        return ""
    drawing = crease_pattern(structure, units)
    width, height = drawing.size
    digits = int(np.clip(4 - np.log10(max(width, height)), 0, 4))
    parts = []
    for layer in drawing.layers:
        path = "".join(_path(line, height, digits) for line in layer.lines if isinstance(line, Line))
        if path:
            colour, thick, dash = STYLES[layer.name]
            fill = colours.PAPER if layer.name == "boundary" else "none"
            parts.append((layer.name != "boundary", f'<path class="{layer.name}" d="{path}" fill="{fill}" '
                          'fill-rule="evenodd" '
                          f'stroke="{colour}" stroke-width="{thick}" vector-effect="non-scaling-stroke"'
                          + (f' stroke-dasharray="{dash}"' if dash else "") + "/>"))
    inside = "\n".join(part for _, part in sorted(parts, key=lambda part: part[0]))
    return (f'<svg viewBox="0 0 {width:.{digits}f} {height:.{digits}f}" role="img" '
            f'aria-label="The flat sheet with its creases">\n{inside}\n</svg>')


def key_svg(layer: str) -> str:
    """A short line as the sheet draws that layer."""
    colour, _, dash = STYLES[layer]
    return (f'<svg class="key" viewBox="0 0 44 4" aria-hidden="true"><path class="{layer}" d="M0,2 44,2" stroke="{colour}" '
            f'stroke-width="2" stroke-dasharray="{dash}"/></svg>')


def measured(history: list[float]) -> np.ndarray:
    """The values of a history that have a place on a chart by powers of ten."""
    return np.array([value for value in history if np.isfinite(value) and value > 0])


def history_svg(history: list[float]) -> str:
    """The values of a history one after the other, by powers of ten; empty where there are not two."""
    values = measured(history)
    if len(values) < 2:
        return ""
    powers = np.log10(values)
    low, high = int(np.floor(powers.min())), int(np.ceil(powers.max()))
    high = max(high, low + 1)
    x = LEFT + (WIDTH - LEFT - 16) * np.arange(len(values)) / (len(values) - 1)
    y = 12 + (HEIGHT - 12 - BELOW) * (high - powers) / (high - low)
    step = max(1, -(-(high - low) // 7))
    parts = []
    for power in range(high, low - 1, -step):
        level = 12 + (HEIGHT - 12 - BELOW) * (high - power) / (high - low)
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - 16}" y1="{level:.1f}" y2="{level:.1f}" stroke="#d9d1c3"/>'
                     f'<text x="{LEFT - 8}" y="{level + 4:.1f}" text-anchor="end">1e{power}</text>')
    for k in range(0, len(values), -(-len(values) // 12)):
        parts.append(f'<text x="{x[k]:.1f}" y="{HEIGHT - BELOW + 18}" text-anchor="middle">{k + 1}</text>')
    dots = "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.2" fill="{colours.VALLEY}"/>' for a, b in zip(x, y, strict=True))
    line = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
    parts.append(f'<polyline points="{line}" fill="none" stroke="{colours.VALLEY}" stroke-width="1.6"/>{dots}'
                 f'<text x="{(LEFT + WIDTH) / 2:.0f}" y="{HEIGHT - 6}" text-anchor="middle">measurement</text>')
    return (f'<svg class="chart" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="How the residual fell">'
            + "\n".join(parts) + "</svg>")


def _path(line: Line, height: float, digits: int) -> str:
    points = np.round(line.points * [1, -1] + [0, height], digits) + 0.0
    return "M" + " ".join(f"{x:g},{y:g}" if digits == 0 else f"{x:.{digits}f},{y:.{digits}f}" for x, y in points.tolist()) \
        + ("Z" if line.closed else "")
