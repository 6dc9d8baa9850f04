"""preview.png: the folded structure and its flat sheet side by side, at one scale."""

from pathlib import Path

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import Camera, best_view
from plisse.draw.drawing import crease_pattern
from plisse.draw.folded import DOTS_PER_INCH, draw_folded, draw_lines, line_width
from plisse.draw.layout import Layout, arrange, dense, turned
from plisse.draw.render import render
from plisse.draw.table import table
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect
from plisse.recipe import MILLIMETRES
from plisse.result import Result
from plisse.structure.pleated import PleatedStructure

__all__ = ["write_preview"]

SIZE = (2000, 1125)
MARGIN, CAPTION_BAND, RIM = 80, 125, 6


def write_preview(subject: Result | PleatedStructure, path: str | Path, *, title: str | None = None,
                  units: str = "mm") -> None:
    """Write a PNG of the folded structure and its development, if any; equal subjects give equal bytes.

    `units` matters for the size in the caption when the subject is a structure; a result knows its own.
    Raises ValueError for a result without a structure.
    """
    structure = subject if isinstance(subject, PleatedStructure) else subject.structure
    if structure is None:
        raise ValueError("the result has no structure to draw")
    units = units if isinstance(subject, PleatedStructure) else subject.report.units
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    inches = SIZE[0] / DOTS_PER_INCH, SIZE[1] / DOTS_PER_INCH
    figure = Figure(figsize=inches, dpi=DOTS_PER_INCH, facecolor=colours.BACKGROUND)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(0, SIZE[0])
    axes.set_ylim(0, SIZE[1])
    layout = _compose(axes, structure, units)
    facts = _facts(structure, units, layout.reduction)
    if isinstance(subject, Result) and subject.status != "exact":
        facts.append(subject.status)
    axes.text(MARGIN, 66, title or "", fontsize=11, color=colours.INK, va="center", parse_math=False)
    axes.text(SIZE[0] - MARGIN, 66, "   ·   ".join(facts), fontsize=7, color=colours.CAPTION, va="center",
              ha="right")
    canvas.print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 4})


def _compose(axes, structure: PleatedStructure, units: str) -> Layout:
    camera = best_view(structure)
    sheet = None if structure.development is None else _sheet(structure, units)
    loops = [] if sheet is None else [dense(line, max(1, 4000 // len(line))) for line in sheet["boundary"]]
    layout = arrange(_cloud(structure, camera), np.concatenate(loops) if loops else None,
                     np.array([MARGIN, CAPTION_BAND]), np.array(SIZE) - MARGIN)
    picture = render(structure, camera, layout.scale, RIM)
    placed = {} if sheet is None else _placed(sheet, layout)
    ground = table(SIZE, picture.image[..., 3], layout.folded - RIM, placed.get("boundary", []))
    axes.imshow(ground, origin="lower", interpolation="bilinear", aspect="auto", zorder=0,
                extent=(0, SIZE[0], 0, SIZE[1]))
    draw_folded(axes, picture, structure, layout.folded - RIM, line_width(structure, layout.scale))
    if placed:
        _draw_sheet(axes, placed, line_width(structure, layout.scale / layout.reduction, 0.35))
    return layout


def _cloud(structure: PleatedStructure, camera: Camera) -> np.ndarray:
    """Enough points (N, 2) to know where the folded shape is, in the camera's plane."""
    seen = camera.project(structure.vertices)[:, :2]
    if len(seen) > 500:
        return seen[::max(1, len(seen) // 20_000)]
    return np.concatenate([dense(seen[edge]) for edge in structure.topology.edges.vertices])


def _sheet(structure: PleatedStructure, units: str) -> dict[str, list[np.ndarray]]:
    """Polylines (N, 2) of the flat pattern in model units by layer."""
    drawing = crease_pattern(structure, units)
    unit = MILLIMETRES[units]
    return {layer.name: [line.path / unit for line in layer.lines] for layer in drawing.layers}


def _placed(sheet: dict[str, list[np.ndarray]], layout: Layout) -> dict[str, list[np.ndarray]]:
    """The same polylines in pixels of the picture."""
    on_page = {name: [turned(line, layout.turn) for line in lines] for name, lines in sheet.items()}
    low = np.concatenate(on_page["boundary"]).min(axis=0)
    scale = layout.scale / layout.reduction
    return {name: [(line - low) * scale + layout.flat for line in lines] for name, lines in on_page.items()}


def _draw_sheet(axes, placed: dict[str, list[np.ndarray]], width: float) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    outline = Outline.make_compound_path(*[Outline(loop, closed=True) for loop in placed["boundary"]])
    paper = PathPatch(outline, facecolor=colours.PAPER, edgecolor=colours.EDGE, linewidth=0.45, zorder=1)
    axes.add_patch(paper)
    draw_lines(axes, _sparse(placed["ruling"]), colours.RULING, 0.2, 0.35, 2)
    draw_lines(axes, placed["valley"], colours.VALLEY, width, 1.0, 3)
    draw_lines(axes, placed["mountain"], colours.MOUNTAIN, width, 1.0, 3)


def _sparse(rulings: list[np.ndarray], apart: float = 7.0) -> list[np.ndarray]:
    """Every so-many-th ruling, so that they lie some pixels apart and do not darken the sheet."""
    if len(rulings) < 3:
        return rulings
    middles = np.array([line[len(line) // 2] for line in rulings])
    gap = np.median(np.hypot(*np.diff(middles, axis=0).T))
    return rulings[::max(1, int(np.ceil(apart / max(gap, 1e-3))))]


def _facts(structure: PleatedStructure, units: str, reduction: int) -> list[str]:
    """What the caption says: size, exactness, sheet."""
    topology, vertices = structure.topology, structure.vertices
    facts = [f"{topology.vertex_count:,} vertices",
             f"planarity {planarity_defect(topology, vertices).max():.0e}",
             f"angle defect {np.abs(angle_defect(topology, vertices)).max():.0e}"]
    if structure.development is not None:
        size = np.ptp(structure.development, axis=0)
        width, height = (f"{x:.0f}" if x >= 100 else f"{x:.3g}" for x in size)
        drawn = f", drawn 1 : {reduction} to the fold" if reduction > 1 else ""
        facts.append(f"sheet {width} × {height} {units}{drawn}")
    return facts
