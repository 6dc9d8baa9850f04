"""A folded structure as an image of paper: hidden surfaces, light, and the visible parts of lines."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_closing, binary_opening

from plisse.draw.camera import Camera
from plisse.draw.colour_maps import ColourMap
from plisse.draw.corners import corner_normals, corner_triangles
from plisse.draw.raster import DepthBuffer, depth_planes, rasterise
from plisse.draw.light import Fineness, light
from plisse.draw.shade import paper_colour
from plisse.structure.pleated import PleatedStructure

__all__ = ["Rendering", "render", "render_triangles"]

OVERSAMPLE = 2
Paint = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Rendering:
    """`image` (H, W, 4) in 0…1, row 0 at the bottom, and what is needed to hide lines behind it.

    `scale` is pixels per model unit and `origin` (3,) the point of the camera's frame at the lower left
    corner.
    """

    image: np.ndarray
    buffer: DepthBuffer
    camera: Camera
    scale: float
    origin: np.ndarray

    def pixels(self, points: np.ndarray) -> np.ndarray:
        """Points (N, 3) of the structure in pixels: x right, y up, z towards the viewer."""
        return (self.camera.project(points) - self.origin) * self.scale

    def visible(self, path: np.ndarray, slack: float = 2.5) -> list[np.ndarray]:
        """The parts (N, 2) in pixels of a polyline (N, 3) in space that nothing hides."""
        fine = _densified(self.pixels(path), 0.7)
        height, width = self.buffer.depth.shape
        column = np.clip((fine[:, 0] * OVERSAMPLE).astype(int), 0, width - 1)
        row = np.clip((fine[:, 1] * OVERSAMPLE).astype(int), 0, height - 1)
        seen = fine[:, 2] * OVERSAMPLE > self.buffer.depth[row, column] - slack * OVERSAMPLE
        return _runs(fine[:, :2], _without_specks(seen, 7))


def render(structure: PleatedStructure, camera: Camera, scale: float, margin: int = 8, colour: ColourMap | None = None,
           fineness: Fineness = Fineness()) -> Rendering:
    """The structure on transparent ground, `scale` pixels per model unit, with `margin` pixels around it.

    A `colour` map stands for the colour of the paper.
    """
    corners = corner_triangles(structure.topology)
    triangles = structure.vertices[structure.topology.corners.vertex[corners]]
    normals = corner_normals(structure.topology, structure.vertices)[corners]
    paint = None if colour is None else _painter(colour, colour.values[corners])
    return render_triangles(triangles, normals, camera, scale, margin, paint=paint, fineness=fineness)


def render_triangles(triangles: np.ndarray, normals: np.ndarray, camera: Camera, scale: float, margin: int = 8,
                     tints: np.ndarray | None = None, paint: Paint | None = None,
                     fineness: Fineness = Fineness()) -> Rendering:
    """Any triangles (T, 3, 3) as if made of paper, normals (T, 3, 3) at their corners.

    `tints` (T, 3) darken the paper; `paint` gives colours (N, 3) for triangles in pixels, which of
    them are seen (N,) and where (N, 2).
    """
    seen = camera.project(triangles)
    low, high = seen.reshape(-1, 3).min(axis=0), seen.reshape(-1, 3).max(axis=0)
    origin = low - margin / scale
    width, height = np.ceil((high - low)[:2] * scale + 2 * margin).astype(int)
    pixels = (seen - origin) * scale * OVERSAMPLE
    buffer = rasterise(pixels, width * OVERSAMPLE, height * OVERSAMPLE)
    image = _image(buffer, pixels, camera.project(normals), tints, paint, fineness)
    return Rendering(image, buffer, camera, scale, origin)


def _painter(colour: ColourMap, values: np.ndarray) -> Paint:
    """Colours of a map whose values (T, 3) at corners vary linearly over triangles."""
    def paint(pixels: np.ndarray, owner: np.ndarray, place: np.ndarray) -> np.ndarray:
        constant, along_x, along_y = depth_planes(pixels, values).T
        found = constant[owner] + along_x[owner] * place[:, 0] + along_y[owner] * place[:, 1]
        # at rims the centre of a pixel may lie outside of its sliver
        return colour.colours(np.clip(found, values.min(axis=1)[owner], values.max(axis=1)[owner]))

    return paint


def _image(buffer: DepthBuffer, pixels: np.ndarray, normals: np.ndarray, tints: np.ndarray | None, paint: Paint | None,
           fineness: Fineness) -> np.ndarray:
    height, width = buffer.depth.shape
    row, column = np.nonzero(buffer.triangle >= 0)
    place = np.stack([column, row], axis=1).astype(np.float32) + np.float32(0.5)
    owner = buffer.triangle[row, column]
    normal, front = _normals_at(owner, place, pixels, normals)
    field = np.zeros((height, width, 3), np.float32)
    field[row, column] = normal
    some = slice(None, None, OVERSAMPLE)
    sun, sky = light(pixels, buffer.depth[some, some], field[some, some], OVERSAMPLE, fineness)
    image = np.zeros((height, width, 4), np.float32)
    coarse = row // OVERSAMPLE, column // OVERSAMPLE
    own = None if paint is None else paint(pixels, owner, place)
    image[row, column, :3] = paper_colour(normal, front, sun[coarse], sky[coarse], own)
    if tints is not None:
        image[row, column, :3] *= tints[owner].astype(np.float32)
    image[row, column, 3] = 1
    return _reduced(image)


def _normals_at(owner: np.ndarray, place: np.ndarray, pixels: np.ndarray,
                normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Smooth unit normals (N, 3) towards the viewer, and whether the front of the paper is seen."""
    planes = np.stack([depth_planes(pixels, normals[..., k]) for k in range(3)], axis=-1).astype(np.float32)
    constant, along_x, along_y = planes[:, 0], planes[:, 1], planes[:, 2]
    normal = constant[owner] + along_x[owner] * place[:, :1] + along_y[owner] * place[:, 1:]
    normal /= np.sqrt(np.einsum("ij,ij->i", normal, normal))[:, None]
    a, b, c = pixels[:, 0], pixels[:, 1], pixels[:, 2]
    front = (np.cross(b - a, c - a)[:, 2] > 0)[owner]
    return np.where(front[:, None], normal, -normal), front


def _reduced(image: np.ndarray) -> np.ndarray:
    """Blocks of pixels averaged, colours weighted by coverage."""
    height, width = image.shape[0] // OVERSAMPLE, image.shape[1] // OVERSAMPLE
    blocks = image.reshape(height, OVERSAMPLE, width, OVERSAMPLE, 4)
    total = blocks.sum(axis=(1, 3))
    colour = total[..., :3] / np.maximum(total[..., 3:], 1)
    return np.concatenate([colour, total[..., 3:] / OVERSAMPLE**2], axis=-1)


def _densified(path: np.ndarray, step: float) -> np.ndarray:
    length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(path[:, :2], axis=0).T))])
    count = int(length[-1] / step) + 2
    at = np.union1d(np.linspace(0, length[-1], count), length)
    return np.stack([np.interp(at, length, path[:, k]) for k in range(3)], axis=1)


def _without_specks(seen: np.ndarray, size: int) -> np.ndarray:
    """The mask with gaps and then islands shorter than `size` removed."""
    padded = np.pad(seen, size, mode="edge")
    return binary_opening(binary_closing(padded, np.ones(size)), np.ones(size))[size:-size]


def _runs(points: np.ndarray, seen: np.ndarray) -> list[np.ndarray]:
    cuts = np.flatnonzero(np.diff(seen)) + 1
    parts = zip(np.split(points, cuts), np.split(seen, cuts), strict=True)
    return [part for part, mask in parts if mask[0] and len(part) > 2]
