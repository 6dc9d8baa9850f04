"""preview.png: the folded structure and its flat sheet side by side, at one scale."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plisse.design import MILLIMETRES
from plisse.draw import colours
from plisse.draw.camera import Camera, best_view
from plisse.draw.drawing import crease_pattern
from plisse.draw.render import Rendering, render
from plisse.measure.folds import assignments
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect
from plisse.result import Result
from plisse.structure.pleated import PleatedStructure

__all__ = ["write_preview"]

SIZE = (2400, 1350)
MARGIN, GAP, CAPTION_BAND = 130, 130, 150


@dataclass(frozen=True, eq=False)
class Layout:
    """Pixels per model unit, and the lower left corners in pixels of the folded and the flat picture."""

    scale: float
    folded: np.ndarray
    flat: np.ndarray


def write_preview(subject: Result | PleatedStructure, path: str | Path, *, title: str | None = None,
                  units: str = "mm") -> None:
    """Write a PNG of the folded structure and, where there is one, its development; equal subjects, equal bytes.

    `units` matters for the size in the caption when the subject is a structure; a result knows its own. Raises
    ValueError for a result without a structure.
    """
    structure = subject if isinstance(subject, PleatedStructure) else subject.structure
    if structure is None:
        raise ValueError("the result has no structure to draw")
    units = units if isinstance(subject, PleatedStructure) else subject.report.units
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(SIZE[0] / 200, SIZE[1] / 200), dpi=200, facecolor=colours.BACKGROUND)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(0, SIZE[0])
    axes.set_ylim(0, SIZE[1])
    _compose(axes, structure, units)
    _caption(axes, structure, units, title)
    canvas.print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 4})


def _compose(axes, structure: PleatedStructure, units: str) -> None:
    camera = best_view(structure)
    sheet = _Sheet.of(structure, units) if structure.development is not None else None
    layout, sheet = _layout(structure, camera, sheet)
    picture = render(structure, camera, layout.scale)
    _draw_ground(axes, picture, sheet, layout)
    _draw_folded(axes, picture, structure, layout.folded)
    if sheet is not None:
        _draw_sheet(axes, sheet, layout)


@dataclass(frozen=True, eq=False)
class _Sheet:
    """The flat pattern in model units with its lower left corner at 0: layer name → polylines (N, 2)."""

    layers: dict[str, list[np.ndarray]]

    @classmethod
    def of(cls, structure: PleatedStructure, units: str) -> "_Sheet":
        drawing = crease_pattern(structure, units, margin=0)
        layers = {layer.name: [np.concatenate([line.points, line.points[:1]]) if line.closed else line.points
                               for line in layer.lines] for layer in drawing.layers}
        return cls({name: [line / MILLIMETRES[units] for line in lines] for name, lines in layers.items()})

    @property
    def size(self) -> np.ndarray:
        return np.concatenate(self.layers["boundary"]).max(axis=0)

    def turned(self, angle: float) -> "_Sheet":
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        low = (np.concatenate(self.layers["boundary"]) @ turn).min(axis=0)
        return _Sheet({name: [line @ turn - low for line in lines] for name, lines in self.layers.items()})


def _layout(structure: PleatedStructure, camera: Camera, sheet: _Sheet | None) -> tuple[Layout, _Sheet | None]:
    """The largest common scale over a few turns of the sheet, both pictures centred."""
    folded = np.ptp(camera.project(structure.vertices)[:, :2], axis=0)
    room = np.array([SIZE[0] - 2 * MARGIN, SIZE[1] - MARGIN - CAPTION_BAND])
    if sheet is None:
        scale = (room / folded).min()
        corner = np.array([MARGIN, CAPTION_BAND]) + (room - folded * scale) / 2
        return Layout(scale, corner, corner), None

    def fit(candidate: _Sheet) -> float:
        flat = candidate.size
        return min((room[0] - GAP) / (folded[0] + flat[0]), room[1] / max(folded[1], flat[1]))

    sheet = max((sheet.turned(angle) for angle in np.radians(np.arange(0, 360, 15))), key=lambda s: round(fit(s), 9))
    scale = fit(sheet)
    free = room[0] - (folded[0] + sheet.size[0]) * scale
    middle = CAPTION_BAND + room[1] / 2
    left = MARGIN + free / 3.2
    right = SIZE[0] - MARGIN - free / 3.2 - sheet.size[0] * scale
    return Layout(scale, np.array([left, middle - folded[1] * scale / 2]),
                  np.array([right, middle - sheet.size[1] * scale / 2])), sheet


def _draw_ground(axes, picture: Rendering, sheet: _Sheet | None, layout: Layout) -> None:
    """The table: a soft fall of light and the shadows of both pieces of paper."""
    from matplotlib.path import Path as Outline
    from scipy.ndimage import gaussian_filter

    small = 6
    width, height = SIZE[0] // small, SIZE[1] // small
    y, x = np.mgrid[0:height, 0:width]
    glow = np.exp(-(((x / width - 0.36) / 0.62) ** 2 + ((y / height - 0.72) / 0.75) ** 2))
    ground = colours.rgb(colours.BACKGROUND) * (0.93 + 0.08 * glow[..., None])
    mask = np.zeros((height, width))
    _stamp(mask, picture.image[::small, ::small, 3], layout.folded / small)
    shadow = 0.34 * gaussian_filter(np.roll(mask, (-7, 6), (0, 1)), 7)
    if sheet is not None:
        centres = (np.column_stack([x.ravel(), y.ravel()]) + 0.5) * small
        lies = np.zeros(len(centres), bool)
        for loop in sheet.layers["boundary"]:
            lies ^= Outline(loop * layout.scale + layout.flat).contains_points(centres)
        shadow += 0.24 * gaussian_filter(np.roll(lies.reshape(height, width).astype(float), (-1, 1), (0, 1)), 2.2)
    ground = ground * (1 - np.clip(shadow, 0, 1)[..., None] * (1 - colours.rgb(colours.SHADE) * 0.6))
    axes.imshow(np.clip(ground, 0, 1), extent=(0, SIZE[0], 0, SIZE[1]), origin="lower", interpolation="bicubic",
                aspect="auto", zorder=0)


def _stamp(target: np.ndarray, image: np.ndarray, corner: np.ndarray) -> None:
    column, row = np.round(corner).astype(int)
    height, width = (min(a, b) for a, b in zip(image.shape, (target.shape[0] - row, target.shape[1] - column), strict=True))
    target[row:row + height, column:column + width] = np.maximum(target[row:row + height, column:column + width],
                                                                 image[:height, :width])


def _draw_folded(axes, picture: Rendering, structure: PleatedStructure, corner: np.ndarray) -> None:
    height, width = picture.image.shape[:2]
    corner = np.round(corner) - 8
    axes.imshow(np.clip(picture.image, 0, 1), origin="lower", interpolation="nearest", aspect="auto", zorder=2,
                extent=(corner[0], corner[0] + width, corner[1], corner[1] + height))
    edges = structure.topology.edges
    letters = assignments(structure.topology, structure.vertices)
    letters = np.where(edges.is_boundary, "B", np.where(edges.is_crease, letters, "R"))
    looks = {"B": (colours.EDGE, 0.5, 0.8), "M": (colours.MOUNTAIN, 0.75, 0.9), "V": (colours.VALLEY, 0.75, 0.9)}
    for letter, (colour, width_, alpha) in looks.items():
        lines = []
        for a, b in _paths(edges.vertices[letters == letter]):
            lines += [part + corner for part in picture.visible(structure.vertices[np.array([a, b])])]
        _lines(axes, lines, colour, width_, alpha, 3)


def _paths(ends):
    return ends.tolist()


def _draw_sheet(axes, sheet: _Sheet, layout: Layout) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    placed = {name: [line * layout.scale + layout.flat for line in lines] for name, lines in sheet.layers.items()}
    outline = Outline.make_compound_path(*[Outline(loop, closed=True) for loop in placed["boundary"]])
    axes.add_patch(PathPatch(outline, facecolor=colours.PAPER, edgecolor=colours.EDGE, linewidth=0.6, zorder=1))
    _lines(axes, placed["ruling"], colours.RULING, 0.2, 0.4, 2)
    _lines(axes, placed["mountain"], colours.MOUNTAIN, 0.8, 1.0, 3)
    _lines(axes, placed["valley"], colours.VALLEY, 0.8, 1.0, 3)


def _lines(axes, lines: list[np.ndarray], colour: str, width: float, alpha: float, zorder: int) -> None:
    from matplotlib.collections import LineCollection

    axes.add_collection(LineCollection(lines, colors=colour, linewidths=width, alpha=alpha, zorder=zorder,
                                       capstyle="round", joinstyle="round"))


def _caption(axes, structure: PleatedStructure, units: str, title: str | None) -> None:
    topology, vertices = structure.topology, structure.vertices
    facts = [f"{topology.vertex_count:,} vertices", f"planarity {planarity_defect(topology, vertices).max():.0e}",
             f"angle defect {np.abs(angle_defect(topology, vertices)).max():.0e}"]
    if structure.development is not None:
        width, height = np.ptp(structure.development, axis=0)
        facts.append(f"sheet {width:.0f} × {height:.0f} {units}")
    axes.text(MARGIN, 78, title or "", fontsize=13, color=colours.INK, va="center")
    axes.text(SIZE[0] - MARGIN, 78, "   ·   ".join(facts), fontsize=8, color=colours.CAPTION, va="center", ha="right")
