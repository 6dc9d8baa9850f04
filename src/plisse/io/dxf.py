"""DXF R2010 at 1:1 in millimetres: drawings side by side, one layer per tool, for CAD programs and cutters."""

from pathlib import Path

import numpy as np

from plisse.draw.colours import rgb
from plisse.draw.drawing import Drawing, Layer
from plisse.draw.shapes import Bulged, Line, Shape, Spline, Text
from plisse.draw.strokes import Stroke
from plisse.extras import optional
from plisse.geometry.vectors import norm
from plisse.io.atomic import written

__all__ = ["write_dxf"]

NAMES = {"boundary": "CUT"}
GAP = 20.0
INDEXED = {1: "#ff0000", 2: "#ffff00", 3: "#00ff00", 4: "#00ffff", 5: "#0000ff", 6: "#ff00ff", 7: "#000000", 8: "#808080"}
WEIGHTS = np.array([0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100])


def write_dxf(drawings: list[Drawing], path: str | Path) -> None:
    """Write the drawings from left to right, 20 mm apart; layers are called MOUNTAIN, VALLEY, CUT, RULING, TEXT, ….

    Boundaries are on the layer CUT. Splines, arcs and texts stay what they are. Raises MissingExtra without ezdxf,
    PlisseError where the file cannot be written.
    """
    ezdxf = optional("ezdxf", extra="cad", purpose="DXF files")
    document = ezdxf.new("R2010", units=4)  # millimetres
    document.header["$MEASUREMENT"] = 1
    document.header["$LTSCALE"] = 1.0
    space, shift = document.modelspace(), np.zeros(2)
    for drawing in drawings:
        for layer in drawing.layers:
            name = _layer(document, layer)
            for shape in layer.lines:
                _add(space, shape, name, shift)
            for text in layer.texts:
                _add_text(space, text, name, shift)
        shift = np.add(shift, (drawing.size[0] + GAP, 0.0))
    with written(path) as aside:
        document.saveas(aside)


def _layer(document, layer: Layer) -> str:
    """The DXF layer of that name, made if there is none yet."""
    name = NAMES.get(layer.name, layer.name.upper())
    if not document.layers.has_entry(name):
        stroke = layer.stroke
        index = _nearest_index(stroke.colour)
        # number 7 is black on white and white on black
        document.layers.add(name, color=index, true_color=None if index == 7 else int(stroke.colour[1:], 16),
                            linetype=_linetype(document, name, stroke),
                            lineweight=int(WEIGHTS[np.abs(WEIGHTS - 100 * stroke.width).argmin()]))
    return name


def _nearest_index(colour: str) -> int:
    """Number of the nearest of the colours that every program knows by a number."""
    return min(INDEXED, key=lambda index: float(norm(rgb(INDEXED[index]) - rgb(colour))))


def _linetype(document, name: str, stroke: Stroke) -> str:
    if not stroke.dash:
        return "CONTINUOUS"
    pieces = [length if k % 2 == 0 else -length for k, length in enumerate(stroke.dash)]
    document.linetypes.add(name, pattern=[sum(stroke.dash), *pieces], description=f"plisse {name.lower()}")
    return name


def _add(space, shape: Shape, layer: str, shift: np.ndarray) -> None:
    attributes = {"layer": layer}
    if isinstance(shape, Line):
        space.add_lwpolyline((shape.points + shift).tolist(), close=shape.closed, dxfattribs=attributes)
    elif isinstance(shape, Bulged):
        corners = np.column_stack([shape.points + shift, shape.bulges]).tolist()
        space.add_lwpolyline(corners, format="xyb", close=True, dxfattribs=attributes)
    elif isinstance(shape, Spline):
        controls, pieces = shape.controls + shift, (len(shape.controls) - 1) // 3
        knots = np.concatenate([[0], np.repeat(np.arange(pieces + 1), 3), [pieces]]).astype(float)
        flat = np.column_stack([controls, np.zeros(len(controls))])
        spline = space.add_open_spline(flat.tolist(), degree=3, knots=knots.tolist(), dxfattribs=attributes)
        spline.closed = shape.closed
    elif shape.is_circle:
        space.add_circle((shape.centre + shift).tolist(), shape.radius, dxfattribs=attributes)
    else:
        space.add_arc((shape.centre + shift).tolist(), shape.radius, float(np.degrees(shape.start)),
                      float(np.degrees(shape.end)), dxfattribs=attributes)


def _add_text(space, text: Text, layer: str, shift: np.ndarray) -> None:
    from ezdxf.enums import TextEntityAlignment

    alignment = {"start": TextEntityAlignment.LEFT, "middle": TextEntityAlignment.CENTER, "end": TextEntityAlignment.RIGHT}
    entity = space.add_text(text.words, height=text.height, rotation=float(np.degrees(text.angle)),
                            dxfattribs={"layer": layer})
    entity.set_placement((text.at + shift).tolist(), align=alignment[text.anchor])
