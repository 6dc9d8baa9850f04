"""The overlay picture of a reconstruction: the reference like glass over the pleats, coloured by their deviation."""

from pathlib import Path

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import best_view
from plisse.draw.raster import DepthBuffer, averaged, rasterise
from plisse.draw.render import OVERSAMPLE, Rendering
from plisse.draw.shade import occlusion
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import norm, unit
from plisse.measure.planarity import face_normals
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["write_overlay"]

SIZE = (1800, 1200)
DOTS_PER_INCH = 200
MARGIN, FOOT = 60, 130  # pixels around the picture, and below it for the colour bar
TOP_OF_SCALE = (0.5, 1.0, 2.0, 4.0)  # amplitudes, the first that 98 % stay below
SUN = unit(np.array([-0.5, 0.6, 0.62]))
GLASS = colours.rgb("#7f9bb0")
IN_FRONT, ALONE = 0.22, 0.45  # opacity of the reference over the structure, and where there is none
UNKNOWN = colours.rgb(colours.UNKNOWN)


def write_overlay(structure: PleatedStructure, mesh: ReferenceMesh, distances: np.ndarray, path: str | Path, *,
                  amplitude: float, title: str = "") -> None:
    """Write a PNG of a structure and the reference mesh that it was made for.

    `distances` (F,) of the faces from the reference colour them, in units of the amplitude; those that are nan, beyond
    the reference, stay grey. Equal subjects give equal bytes.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    values = np.abs(np.asarray(distances, float)) / amplitude
    top = _top(values)
    figure = Figure(figsize=(SIZE[0] / DOTS_PER_INCH, SIZE[1] / DOTS_PER_INCH), dpi=DOTS_PER_INCH,
                    facecolor=colours.BACKGROUND)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set(xlim=(0, SIZE[0]), ylim=(0, SIZE[1]))
    picture = _rendered(structure, mesh, values / top)
    height, width = picture.image.shape[:2]
    left, bottom = (SIZE[0] - width) // 2, FOOT + (SIZE[1] - FOOT - height) // 2
    axes.imshow(picture.image, origin="lower", interpolation="nearest", aspect="auto",
                extent=(left, left + width, bottom, bottom + height), zorder=1)
    _draw_creases(axes, picture, structure, np.array([left, bottom]))
    _draw_scale(figure, values, top)
    axes.text(MARGIN, 66, title, fontsize=10, color=colours.INK, va="center")
    canvas.print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 4})


def _top(values: np.ndarray) -> float:
    known = values[np.isfinite(values)]
    most = float(np.quantile(known, 0.98)) if len(known) else 0.0
    return next((top for top in TOP_OF_SCALE if most <= top), float(np.ceil(most)))


def _rendered(structure: PleatedStructure, mesh: ReferenceMesh, shares: np.ndarray) -> Rendering:
    """The picture as large as fits; lines are hidden by the structure only, for the reference is transparent."""
    camera = best_view(structure)
    faces, face_of = triangulated(structure.topology)
    pleats, glass = camera.project(structure.vertices[faces]), camera.project(mesh.corners)
    both = np.concatenate([pleats, glass]).reshape(-1, 3)
    low, high = both.min(axis=0), both.max(axis=0)
    room = np.array([SIZE[0] - 2 * MARGIN, SIZE[1] - MARGIN - FOOT - 8])
    scale = float((room / np.maximum((high - low)[:2], 1e-12 * norm(high - low))).min())
    width, height = np.maximum(np.ceil((high - low)[:2] * scale).astype(int), 1)
    size = int(width) * OVERSAMPLE, int(height) * OVERSAMPLE
    paper, pane = (rasterise((part - low) * scale * OVERSAMPLE, *size) for part in (pleats, glass))
    normals = camera.project(face_normals(structure.topology, structure.vertices))
    tint = colours.quality(np.nan_to_num(np.clip(shares, 0, 1)))
    tint[~np.isfinite(shares)] = UNKNOWN
    image = _painted(paper, normals, tint, face_of)
    _glaze(image, paper, pane, camera.project(mesh.normals))
    return Rendering(averaged(image, OVERSAMPLE), paper, camera, scale, low, (pleats - low) * scale)


def _painted(paper: DepthBuffer, normals: np.ndarray, tint: np.ndarray, face_of: np.ndarray) -> np.ndarray:
    """Pixels (H, W, 4) of faces with unit normals (F, 3) towards any side and colours (F, 3)."""
    facing = (normals * np.sign(normals[:, 2:])).astype(np.float32)
    colour = (tint * (0.62 + 0.42 * np.clip(facing @ SUN, 0, 1))[:, None]).astype(np.float32)
    step = 2 * OVERSAMPLE
    coarse = paper.triangle[::step, ::step]
    towards = np.where(coarse[..., None] >= 0, facing[face_of[coarse]], np.array([0, 0, 1], np.float32))
    sky = occlusion(paper.depth[::step, ::step] / step, towards, 0.03 * max(coarse.shape))
    row, column = np.nonzero(paper.triangle >= 0)
    open_ = (0.7 + 0.3 * sky).astype(np.float32)[row // step, column // step]
    image = np.zeros((*paper.triangle.shape, 4), np.float32)
    image[row, column, :3] = np.minimum(colour[face_of[paper.triangle[row, column]]] * open_[:, None], 1)
    image[row, column, 3] = 1
    return image


def _glaze(image: np.ndarray, paper: DepthBuffer, pane: DepthBuffer, normals: np.ndarray) -> None:
    """Lay the reference over the pixels that it is in front of."""
    row, column = np.nonzero((pane.triangle >= 0) & (pane.depth > paper.depth))
    facing = normals * np.sign(normals[:, 2:])
    tones = np.clip(GLASS * (0.72 + 0.45 * np.clip(facing @ SUN, 0, 1))[:, None], 0, 1).astype(np.float32)
    colour = tones[pane.triangle[row, column]]
    below = image[row, column]
    share = np.where(below[:, 3] > 0, IN_FRONT, ALONE)[:, None]
    image[row, column, :3] = np.where(below[:, 3:] > 0, (1 - share) * below[:, :3] + share * colour, colour)
    image[row, column, 3] = np.where(below[:, 3] > 0, 1, ALONE)


def _draw_creases(axes, picture: Rendering, structure: PleatedStructure, corner: np.ndarray) -> None:
    from matplotlib.collections import LineCollection

    lines = []
    for crease in structure.topology.creases:
        chain = crease.path
        lines += [part + corner for part in picture.visible(structure.vertices[chain])]
    edges = structure.topology.edges
    strip = structure.vertices[edges.vertices[~edges.is_crease]]
    apart = float(np.median(norm(strip[:, 1] - strip[:, 0]))) * picture.scale * 72 / DOTS_PER_INCH
    axes.add_collection(LineCollection(lines, colors=colours.INK, linewidths=float(np.clip(apart / 16, 0.16, 0.7)),
                                       capstyle="round", joinstyle="round", zorder=2))


def _draw_scale(figure, values: np.ndarray, top: float) -> None:
    """The colour bar with the mean and the largest deviation below it."""
    bar = figure.add_axes((0.5, 72 / SIZE[1], 0.5 - MARGIN / SIZE[0], 18 / SIZE[1]))
    bar.imshow(colours.quality(np.linspace(0, 1, 256))[None], aspect="auto", extent=(0, top, 0, 1))
    bar.set(yticks=[], xlim=(0, top), xticks=np.linspace(0, top, 5))
    bar.tick_params(labelsize=6, colors=colours.CAPTION, length=2, width=0.4, pad=2)
    bar.spines[:].set(linewidth=0.3, color=colours.CAPTION)
    known = values[np.isfinite(values)]
    numbers = f", mean {known.mean():.2f}, largest {known.max():.2f}" if len(known) else ""
    bar.set_title(f"deviation from the reference in amplitudes{numbers}", fontsize=7, color=colours.INK, pad=4, loc="left")
