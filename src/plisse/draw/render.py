"""A folded structure as an image of paper: hidden surfaces, light, and the visible parts of lines."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce

import numpy as np
from scipy.ndimage import binary_closing, binary_opening

from plisse.draw.camera import Camera
from plisse.draw.colour_maps import ColourMap
from plisse.draw.corners import corner_normals, corner_triangles
from plisse.draw.denoise import Seen
from plisse.draw.light import Fineness, light
from plisse.draw.raster import DepthBuffer, depth_planes, rasterise
from plisse.draw.shade import paper_colour
from plisse.structure.pleated import PleatedStructure

__all__ = ["Rendering", "render", "render_triangles"]

OVERSAMPLE = 2
CALM = 0.04
FAST = Fineness()
Paint = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Rendering:
    """`image` (H, W, 4) in 0…1, row 0 at the bottom, and what is needed to hide lines behind it.

    `scale` is pixels per model unit, `origin` (3,) the point of the camera's frame at the lower left corner, `triangles`
    (T, 3, 3) what is shown, in pixels.
    """

    image: np.ndarray
    buffer: DepthBuffer
    camera: Camera
    scale: float
    origin: np.ndarray
    triangles: np.ndarray

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
           fineness: Fineness = FAST) -> Rendering:
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
                     fineness: Fineness = FAST) -> Rendering:
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
    return Rendering(image, buffer, camera, scale, origin, pixels / OVERSAMPLE)


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
    """Colours and coverage (H, W, 4), each pixel the mean of its samples."""
    row, column, weight = _samples(buffer, _kinds(normals))
    owner = buffer.triangle[row, column]
    place = np.stack([column, row], axis=1).astype(np.float32) + np.float32(0.5)
    normal, front = _normals_at(owner, place, pixels, normals)
    shape = buffer.depth.shape[0] // OVERSAMPLE, buffer.depth.shape[1] // OVERSAMPLE
    points = np.concatenate([place, buffer.depth[row, column, None]], axis=1) / np.float32(OVERSAMPLE)
    seen = Seen(shape, row // OVERSAMPLE, column // OVERSAMPLE, points, normal)
    sun, sky = light(pixels / OVERSAMPLE, seen, fineness)
    colour = paper_colour(normal, front, sun, sky, None if paint is None else paint(pixels, owner, place))
    if tints is not None:
        colour = colour * tints[owner].astype(np.float32)
    pixel = seen.row * shape[1] + seen.column
    total = [np.bincount(pixel, weight * part, shape[0] * shape[1]) for part in (*colour.T, 1)]
    image = np.stack(total, axis=-1).astype(np.float32).reshape(*shape, 4)
    image[..., :3] /= np.maximum(image[..., 3:], 1e-6)
    return image


def _samples(buffer: DepthBuffer, kinds: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows, columns and weights of samples to shade: one in pixels that show one surface, all in those with an edge."""
    kind = kinds[buffer.triangle]
    parts = [kind[y::OVERSAMPLE, x::OVERSAMPLE] for y in range(OVERSAMPLE) for x in range(OVERSAMPLE)]
    low, high = reduce(np.minimum, parts), reduce(np.maximum, parts)
    calm = (low > 0) & (high - low < CALM)
    row, column = (OVERSAMPLE * index for index in np.nonzero(calm))
    busy = (buffer.triangle >= 0) & ~calm.repeat(OVERSAMPLE, axis=0).repeat(OVERSAMPLE, axis=1)
    more = np.nonzero(busy)
    weight = np.concatenate([np.ones(len(row)), np.full(len(more[0]), 1 / OVERSAMPLE**2)])
    return np.concatenate([row, more[0]]), np.concatenate([column, more[1]]), weight


def _kinds(normals: np.ndarray) -> np.ndarray:
    """A positive number per triangle that tells how it faces, and 0 at the end for none."""
    facing = normals.mean(axis=1)
    return np.append(4 + np.abs(facing @ [0.31, 0.47, 0.83]) + 2 * (facing[:, 2] > 0), 0.0).astype(np.float32)


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
