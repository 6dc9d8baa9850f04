"""A small picture of a folded structure in some ten milliseconds, to tell many designs apart."""

from io import BytesIO

import numpy as np

from plisse.draw.camera import Camera
from plisse.draw.raster import averaged, rasterise
from plisse.draw.shade import occlusion, paper_colour
from plisse.measure.planarity import face_normals
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["THUMBNAIL", "thumbnail"]

THUMBNAIL = (240, 180)  # pixels
OVERSAMPLE, MARGIN = 2, 6
VIEW = np.array([0.35, -0.62, 0.7])  # in the principal axes: long, middle, short


def thumbnail(structure: PleatedStructure) -> bytes:
    """A PNG with transparent ground, every face in the tone of its normal; the view follows the principal axes."""
    from PIL import Image

    camera = _view(structure.vertices)
    faces, face_of = triangulated(structure.topology)
    corners = camera.project(structure.vertices[faces])
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    scale = float(((np.array(THUMBNAIL) - 2 * MARGIN) / np.maximum((high - low)[:2], 1e-12)).min())
    offset = np.array([*np.array(THUMBNAIL) / 2, 0]) / scale - np.array([*(low + high)[:2] / 2, low[2]])
    width, height = (OVERSAMPLE * side for side in THUMBNAIL)
    buffer = rasterise((corners + offset) * scale * OVERSAMPLE, width, height)
    normals = camera.project(face_normals(structure.topology, structure.vertices))[face_of]
    front = normals[:, 2] > 0
    towards = (normals * np.where(front, 1.0, -1.0)[:, None]).astype(np.float32)
    owner = buffer.triangle
    coarse = owner[::OVERSAMPLE, ::OVERSAMPLE]
    seen = np.where(coarse[..., None] >= 0, towards[coarse], np.array([0, 0, 1], np.float32))
    depth = buffer.depth[::OVERSAMPLE, ::OVERSAMPLE] / OVERSAMPLE
    sky = occlusion(depth, seen, 0.05 * THUMBNAIL[0], directions=6, steps=3).astype(np.float32)
    row, column = np.nonzero(owner >= 0)
    which, light = owner[row, column], sky[row // OVERSAMPLE, column // OVERSAMPLE]
    image = np.zeros((height, width, 4), np.float32)
    image[row, column, :3] = paper_colour(towards[which], front[which], light, light)
    image[row, column, 3] = 1
    stream = BytesIO()
    pixels = np.round(255 * np.clip(averaged(image, OVERSAMPLE), 0, 1)).astype(np.uint8)[::-1]
    Image.fromarray(pixels).save(stream, "PNG")
    return stream.getvalue()


def _view(vertices: np.ndarray) -> Camera:
    """A camera in the principal axes, turned the same way for shapes that are alike."""
    _, axes = np.linalg.eigh(np.cov((vertices - vertices.mean(axis=0)).T))
    long, middle, short = (axis * np.sign(axis[np.argmax(np.abs(axis))]) for axis in axes.T[::-1])
    direction = VIEW @ np.stack([long, middle, short])
    return Camera.looking_from(direction, short)
