"""A folded structure as an image of paper: hidden surfaces, light, and the visible parts of lines."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_closing, binary_opening

from plisse.draw.camera import Camera
from plisse.draw.raster import DepthBuffer, depth_planes, rasterise
from plisse.draw.shade import occlusion, paper_colour, soft, sunlight
from plisse.geometry.vectors import unit
from plisse.measure.planarity import face_normals
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["Rendering", "render", "render_triangles"]

OVERSAMPLE = 2


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


def render(structure: PleatedStructure, camera: Camera, scale: float, margin: int = 8) -> Rendering:
    """The structure on transparent ground, `scale` pixels per model unit, with `margin` pixels around it."""
    return render_triangles(*_triangles(structure), camera, scale, margin)


def render_triangles(triangles: np.ndarray, normals: np.ndarray, camera: Camera, scale: float, margin: int = 8,
                     tints: np.ndarray | None = None) -> Rendering:
    """Any triangles (T, 3, 3) as if made of paper, normals (T, 3, 3) at their corners; `tints` (T, 3) colour the paper."""
    seen = camera.project(triangles)
    low, high = seen.reshape(-1, 3).min(axis=0), seen.reshape(-1, 3).max(axis=0)
    origin = low - margin / scale
    width, height = np.ceil((high - low)[:2] * scale + 2 * margin).astype(int)
    pixels = (seen - origin) * scale * OVERSAMPLE
    buffer = rasterise(pixels, width * OVERSAMPLE, height * OVERSAMPLE)
    return Rendering(_image(buffer, pixels, camera.project(normals), tints), buffer, camera, scale, origin)


def _image(buffer: DepthBuffer, pixels: np.ndarray, normals: np.ndarray, tints: np.ndarray | None) -> np.ndarray:
    height, width = buffer.depth.shape
    row, column = np.nonzero(buffer.triangle >= 0)
    place = np.stack([column, row], axis=1).astype(np.float32) + np.float32(0.5)
    normal, front = _normals_at(buffer.triangle[row, column], place, pixels, normals)
    field = np.zeros((height, width, 3), np.float32)
    field[row, column] = normal
    sun, sky = _light(buffer, pixels, field)
    image = np.zeros((height, width, 4), np.float32)
    coarse = row // OVERSAMPLE, column // OVERSAMPLE
    image[row, column, :3] = paper_colour(normal, front, sun[coarse], sky[coarse])
    if tints is not None:
        image[row, column, :3] *= tints[buffer.triangle[row, column]].astype(np.float32)
    image[row, column, 3] = 1
    return _reduced(image)


def _light(buffer: DepthBuffer, pixels: np.ndarray, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How much sun and sky reach the paper in 0…1, one value per block of pixels, softened a little."""
    depth, owner = _coarse(buffer)
    row, column = np.nonzero(owner >= 0)
    points = np.stack([column * OVERSAMPLE + 0.5, row * OVERSAMPLE + 0.5, depth[row, column]])
    sun = np.zeros(depth.shape, np.float32)
    sun[row, column] = sunlight(pixels, points.astype(np.float32))
    mask = owner >= 0
    towards = np.where(mask[..., None], normals[::OVERSAMPLE, ::OVERSAMPLE], np.array([0, 0, 1], np.float32))
    # the sky varies slowly: every second block is enough
    sky = occlusion(depth[::2, ::2] / (2 * OVERSAMPLE), towards[::2, ::2], radius=0.045 * max(depth.shape))
    sky = sky.repeat(2, axis=0).repeat(2, axis=1)[:depth.shape[0], :depth.shape[1]]
    return soft(sun, mask, 1.2), soft(sky, mask, 1.8)


def _coarse(buffer: DepthBuffer) -> tuple[np.ndarray, np.ndarray]:
    """Depth and triangle of one pixel in every block."""
    return buffer.depth[::OVERSAMPLE, ::OVERSAMPLE], buffer.triangle[::OVERSAMPLE, ::OVERSAMPLE]


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


def _triangles(structure: PleatedStructure) -> tuple[np.ndarray, np.ndarray]:
    """Corners (T, 3, 3) of all faces cut into triangles, and smooth normals (T, 3, 3) there."""
    topology, vertices = structure.topology, structure.vertices
    normals = _corner_normals(topology, vertices)
    corners = np.arange(topology.quads.size).reshape(-1, 4)
    parts = [corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]
    start = topology.quads.size
    for hub in topology.hubs:
        fan = np.arange(1, len(hub) - 1)
        parts.append(start + np.stack([np.zeros_like(fan), fan, fan + 1], axis=1))
        start += len(hub)
    picked = np.concatenate(parts)
    return vertices[topology.corners.vertex[picked]], normals[picked]


def _corner_normals(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Unit normals (C, 3) that are continuous over rulings and break at creases, as paper does."""
    edges, faces = topology.edges, face_normals(topology, vertices)
    meets = ~edges.is_crease & ~edges.is_boundary
    second = np.where(meets, edges.faces[:, 1], edges.faces[:, 0])
    across = unit(faces[edges.faces[:, 0]] + faces[second])
    corners = topology.corners
    key = np.sort(edges.vertices, axis=1) @ [topology.vertex_count, 1]
    order = np.argsort(key)
    other = np.where(corners.next_is_crease, corners.previous, corners.next)
    wanted = np.minimum(corners.vertex, other) * topology.vertex_count + np.maximum(corners.vertex, other)
    normals = across[order[np.searchsorted(key[order], wanted)]]
    in_hub = corners.face >= len(topology.quads)
    return np.where(in_hub[:, None], faces[corners.face], normals)


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
