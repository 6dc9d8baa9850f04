"""The picture of an arrangement of strips on its surface (Fig. 6), and the drawing to cut them from."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import Camera, best_view
from plisse.draw.drawing import Drawing, Layer, crease_pattern
from plisse.draw.folded import DOTS_PER_INCH, draw_lines
from plisse.draw.render import render_triangles
from plisse.draw.shapes import Text
from plisse.draw.table import table
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import unit
from plisse.recipe import MILLIMETRES
from plisse.transform.arrangement import Arrangement
from plisse.transform.strips import RectifyingStrip

__all__ = ["cutting_drawing", "degrees_text", "write_strips_picture"]

SIZE = (2000, 1250)
MARGIN, CAPTION_BAND, RIM = 80, 125, 6
SURFACE = np.array([0.80, 0.86, 0.90])
NUMBER_HEIGHT = 0.3  # of the strip's width


def write_strips_picture(arrangement: Arrangement, path: str | Path, *, surface: ReferenceMesh | None = None,
                         title: str = "", units: str = "mm") -> None:
    """Write a PNG of all strips in place, on the reference surface where there is one."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    camera = best_view(arrangement.structure)
    triangles, normals, tints = _bodies(arrangement, surface)
    scale, corner = _fitted(camera, triangles)
    picture = render_triangles(triangles, normals, camera, scale, RIM, tints)
    inches = SIZE[0] / DOTS_PER_INCH, SIZE[1] / DOTS_PER_INCH
    figure = Figure(figsize=inches, dpi=DOTS_PER_INCH, facecolor=colours.BACKGROUND)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set(xlim=(0, SIZE[0]), ylim=(0, SIZE[1]))
    ground = table(SIZE, picture.image[..., 3], corner, [])
    axes.imshow(ground, origin="lower", interpolation="bilinear", aspect="auto", zorder=0, extent=(0, SIZE[0], 0, SIZE[1]))
    height, width = picture.image.shape[:2]
    axes.imshow(picture.image, origin="lower", interpolation="nearest", aspect="auto", zorder=2,
                extent=(corner[0], corner[0] + width, corner[1], corner[1] + height))
    rims = [part + corner for strip in arrangement.strips for across in (strip.low, strip.high)
            for part in picture.visible(strip.row(across))]
    draw_lines(axes, rims, colours.EDGE, 0.3, 0.7, 3)
    axes.text(MARGIN, 66, title, fontsize=11, color=colours.INK, va="center", parse_math=False)
    axes.text(SIZE[0] - MARGIN, 66, "   ·   ".join(_facts(arrangement, units)), fontsize=7, color=colours.CAPTION,
              va="center", ha="right")
    FigureCanvasAgg(figure).print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 4})


def cutting_drawing(arrangement: Arrangement, units: str = "mm", *, title: str = "") -> Drawing:
    """All strips laid flat at 1:1 in millimetres, each with its number: layers of a crease pattern, and text."""
    pattern = crease_pattern(arrangement.structure, units, title=title)
    flat, unit_mm = arrangement.structure.development, MILLIMETRES[units]
    assert flat is not None
    low = flat.min(axis=0)
    texts, start = [], 0
    for number, strip in zip(arrangement.numbers, arrangement.strips, strict=True):
        count = strip.structure.topology.vertex_count
        sheet = (flat[start:start + count] - low) * unit_mm + 5.0
        height = NUMBER_HEIGHT * strip.width * unit_mm
        place = sheet[:, 0].min() + 0.5 * np.ptp(sheet[:, 0]), sheet[:, 1].min() + 0.1 * strip.width * unit_mm
        texts.append(Text(str(number), (float(place[0]), float(place[1])), float(height), anchor="middle"))
        start += count
    return replace(pattern, layers=(*pattern.layers, Layer("text", (), tuple(texts))))


def degrees_text(low: float, high: float, digits: int) -> str:
    """A range of angles in degrees as text, one number where both ends read the same."""
    ends = dict.fromkeys(f"{value:.{digits}f}°" for value in (low, high))
    return " to ".join(ends)


def _facts(arrangement: Arrangement, units: str) -> list[str]:
    angles = np.degrees(np.concatenate([part for part in arrangement.inclinations if part is not None] or [np.empty(0)]))
    facts = [f"{len(arrangement.strips)} strips that unfold straight",
             f"{max(strip.width for strip in arrangement.strips):.3g} {units} wide"]
    if len(angles):
        facts.append(f"at {degrees_text(float(angles.min()), float(angles.max()), 1)} to the surface")
    return facts


def _bodies(arrangement: Arrangement, surface: ReferenceMesh | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles (T, 3, 3), normals at their corners, and tints (T, 3) of strips and surface."""
    parts = [_strip_triangles(strip) for strip in arrangement.strips]
    triangles, normals = ([part[k] for part in parts] for k in (0, 1))
    tints = [np.ones((sum(len(part) for part in triangles), 3))]
    if surface is not None:
        triangles.append(surface.corners)
        normals.append(_vertex_normals(surface)[surface.triangles])
        tints.append(np.broadcast_to(SURFACE, (len(surface.triangles), 3)))
    return np.concatenate(triangles), np.concatenate(normals), np.concatenate(tints)


def _strip_triangles(strip: RectifyingStrip) -> tuple[np.ndarray, np.ndarray]:
    low, high = strip.row(strip.low), strip.row(strip.high)
    normal = unit(np.concatenate([strip.normals[:1], strip.normals]) + np.concatenate([strip.normals, strip.normals[-1:]]))
    quads = np.stack([low[:-1], low[1:], high[1:], high[:-1]], axis=1)
    smooth = np.stack([normal[:-1], normal[1:], normal[1:], normal[:-1]], axis=1)
    return tuple(array[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3) for array in (quads, smooth))  # type: ignore[return-value]


def _vertex_normals(surface: ReferenceMesh) -> np.ndarray:
    total = np.zeros_like(surface.vertices)
    for k in range(3):
        np.add.at(total, surface.triangles[:, k], surface.normals)
    return unit(total)


def _fitted(camera: Camera, triangles: np.ndarray) -> tuple[float, np.ndarray]:
    """Pixels per model unit, and the lower left corner (2,) of the picture on the page."""
    size = np.ptp(camera.project(triangles.reshape(-1, 3))[:, :2], axis=0)
    room = np.array([SIZE[0] - 2 * MARGIN, SIZE[1] - CAPTION_BAND - MARGIN])
    scale = float((room / np.maximum(size, 1e-12 * size.max())).min())
    return scale, np.round([MARGIN, CAPTION_BAND] + (room - scale * size) / 2 - RIM)
