"""SVG at 1:1 in millimetres, in layers for Inkscape and in the colours of Origami Simulator.

Origami Simulator tells lines by their stroke: mountains #ff0000, valleys #0000ff, boundary #000000. Rulings
are #ffff00, its "triangulation": lines along which a facet may bend, with no fold angle of their own; it uses
the same colour in its own examples of curved pleats. Creases that do not fold are #ff00ff, its undriven
hinges.
"""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from plisse.draw.drawing import Drawing, Layer, Line
from plisse.io.atomic import written

__all__ = ["STROKES", "write_svg"]

STROKES = {"mountain": "#ff0000", "valley": "#0000ff", "boundary": "#000000", "ruling": "#ffff00",
           "flat": "#ff00ff"}
SVG = "http://www.w3.org/2000/svg"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"


def write_svg(drawing: Drawing, path: str | Path) -> None:
    """Write the drawing; equal drawings give equal bytes, and lengths are exact to a nanometre.

    Raises PlisseError where the file cannot be written.
    """
    ET.register_namespace("", SVG)
    ET.register_namespace("inkscape", INKSCAPE)
    width, height = drawing.size
    root = ET.Element(f"{{{SVG}}}svg", {
        "version": "1.1", "width": f"{_number(width)}mm", "height": f"{_number(height)}mm",
        "viewBox": f"0 0 {_number(width)} {_number(height)}"})
    if drawing.title:
        ET.SubElement(root, f"{{{SVG}}}title").text = drawing.title
    for layer in drawing.layers:
        root.append(_group(layer, height, stroke_width=max(0.1, np.hypot(width, height) / 4000)))
    ET.indent(root, " ")
    with written(path) as aside:
        aside.write_bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def _group(layer: Layer, height: float, stroke_width: float) -> ET.Element:
    """A layer; the stroke stands on every path too, because Origami Simulator looks for it there."""
    group = ET.Element(f"{{{SVG}}}g", {
        f"{{{INKSCAPE}}}groupmode": "layer", f"{{{INKSCAPE}}}label": layer.name, "id": layer.name,
        "fill": "none", "stroke-linejoin": "round", "stroke-width": _number(stroke_width)})
    stroke = STROKES.get(layer.name, "#808080")
    for line in layer.lines:
        ET.SubElement(group, f"{{{SVG}}}path", {"fill": "none", "stroke": stroke, "d": _path(line, height)})
    return group


def _path(line: Line, height: float) -> str:
    points = np.column_stack([line.points[:, 0], height - line.points[:, 1]])
    pairs = " ".join(f"{_number(x)},{_number(y)}" for x, y in points.tolist())
    return f"M{pairs}" + (" Z" if line.closed else "")


def _number(value: float) -> str:
    """Six decimals without idle zeros: a nanometre, where values are millimetres."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
