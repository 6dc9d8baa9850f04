"""SVG at 1:1 in millimetres, in layers for Inkscape and in the colours of Origami Simulator.

Origami Simulator tells lines by their stroke: mountains #ff0000, valleys #0000ff, boundary #000000. Rulings
are #ffff00, its "triangulation": lines along which a facet may bend, with no fold angle of their own; it uses
the same colour in its own examples of curved pleats. Creases that do not fold are #ff00ff, its undriven
hinges.
"""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from plisse.draw.drawing import Drawing, Layer
from plisse.draw.shapes import Arc, Bulged, Line, Shape, Spline, Text
from plisse.io.atomic import written

__all__ = ["SVG", "write_svg"]

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
        root.append(_group(layer, height))
    ET.indent(root, " ")
    with written(path) as aside:
        aside.write_bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def _group(layer: Layer, height: float) -> ET.Element:
    """A layer; the stroke stands on every path too, because Origami Simulator looks for it there."""
    stroke = layer.stroke
    dash = {"stroke-dasharray": " ".join(map(_number, stroke.dash))} if stroke.dash else {}
    group = ET.Element(f"{{{SVG}}}g", {
        f"{{{INKSCAPE}}}groupmode": "layer", f"{{{INKSCAPE}}}label": layer.name, "id": layer.name,
        "fill": "none", "stroke-linejoin": "round", "stroke-width": _number(stroke.width)} | dash)
    for line in layer.lines:
        ET.SubElement(group, f"{{{SVG}}}path", {"fill": "none", "stroke": stroke.colour, "d": _path(line, height)})
    for text in layer.texts:
        group.append(_text(text, height, stroke.colour))
    return group


def _path(shape: Shape, height: float) -> str:
    if isinstance(shape, Line):
        return "M" + _pairs(shape.points, height) + (" Z" if shape.closed else "")
    if isinstance(shape, Spline):
        first, rest = shape.controls[:1], shape.controls[1:]
        return f"M{_pairs(first, height)} C{_pairs(rest, height)}" + (" Z" if shape.closed else "")
    return _bulged(shape, height) if isinstance(shape, Bulged) else _arc(shape, height)


def _arc(arc: Arc, height: float) -> str:
    """Two halves, so that a full circle has ends too; counterclockwise is sweep 0 where y points down."""
    angle = np.linspace(arc.start, arc.end, 3)
    joints = np.array(arc.centre) + arc.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    start, *ends = (_pairs(joint[None], height) for joint in joints)
    radius = _number(arc.radius)
    return f"M{start}" + "".join(f" A{radius},{radius} 0 0 0 {end}" for end in ends) + (" Z" if arc.is_circle else "")


def _bulged(shape: Bulged, height: float) -> str:
    """Lines and arcs in one path, which ends where it began."""
    ends, steps = np.roll(shape.points, -1, axis=0), []
    for end, bulge, radius in zip(ends, shape.bulges.tolist(), shape.radii.tolist(), strict=True):
        size = _number(radius)
        by = f"A{size},{size} 0 {int(abs(bulge) > 1)} {int(bulge < 0)} " if bulge else "L"
        steps.append(by + _pairs(end[None], height))
    return f"M{_pairs(shape.points[:1], height)} {' '.join(steps)} Z"


def _text(text: Text, height: float, colour: str) -> ET.Element:
    x, y = _number(text.at[0]), _number(height - text.at[1])
    attributes = {"x": x, "y": y, "font-size": _number(text.font_size), "font-family": "Helvetica, Arial, sans-serif",
                  "text-anchor": text.anchor, "fill": colour, "stroke": "none"}
    if text.angle:
        attributes["transform"] = f"rotate({_number(-np.degrees(text.angle))} {x} {y})"
    element = ET.Element(f"{{{SVG}}}text", attributes)
    element.text = text.words
    return element


def _pairs(points: np.ndarray, height: float) -> str:
    return " ".join(f"{_number(x)},{_number(height - y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    """Six decimals without idle zeros: a nanometre, where values are millimetres."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
