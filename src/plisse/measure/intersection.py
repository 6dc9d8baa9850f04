"""Self-intersection of the folded shape: edges that pierce faces they do not touch."""

import numpy as np
import shapely

from plisse.geometry.vectors import dot
from plisse.measure.planarity import face_normals
from plisse.structure.topology import Topology
from plisse.structure.triangles import triangulated

__all__ = ["intersecting_faces"]

CHUNK = 400_000
BLOCK = 4
TOUCH = 1e-7


def intersecting_faces(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Pairs of faces (N, 2) without common vertex that cut through each other in space.

    Candidate pairs come from a tree of bounding boxes; each is decided by edges of one face against the triangles
    of the other. Faces that only touch do not count.
    """
    triangles, face = triangulated(topology)
    candidates = _straddling(_box_pairs(topology, vertices), topology, vertices)
    found = []
    for start in range(0, len(candidates), CHUNK):
        pairs = candidates[start:start + CHUNK]
        found.append(pairs[_pierce(pairs, triangles, face, vertices)])
    return np.concatenate(found) if found else np.empty((0, 2), np.int64)


def _box_pairs(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Pairs of faces whose bounding boxes meet and that have no common vertex."""
    faces, points = _padded_faces(topology), np.ascontiguousarray(vertices.T)
    corners = [points.take(column, axis=1) for column in faces.T]
    low, high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    a, b = _near_pairs(low, high)
    for axis_low, axis_high in zip(low, high, strict=True):
        meet = np.flatnonzero((axis_low.take(a) <= axis_high.take(b)) & (axis_low.take(b) <= axis_high.take(a)))
        a, b = a.take(meet), b.take(meet)
    one, other = faces.take(a, axis=0), faces.take(b, axis=0)
    touching = np.logical_or.reduce([one[:, i] == other[:, j] for i, j in np.ndindex(faces.shape[1], faces.shape[1])])
    apart = np.flatnonzero(~touching)
    return np.stack([a.take(apart), b.take(apart)], axis=1)


def _near_pairs(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs a < b of faces in blocks whose boxes meet: successive faces lie together, and a tree of few boxes is fast."""
    count = low.shape[1]
    starts = np.arange(0, count, BLOCK)
    low, high = np.minimum.reduceat(low, starts, axis=1), np.maximum.reduceat(high, starts, axis=1)
    flat = np.argsort(low.min(axis=1) - high.max(axis=1), kind="stable")[:2]
    boxes = shapely.box(*low[flat], *high[flat])
    one, other = shapely.STRtree(boxes).query(boxes)
    once = np.flatnonzero(one <= other)
    i, j = np.divmod(np.arange(BLOCK * BLOCK)[:, None], BLOCK)
    a, b = (BLOCK * one.take(once) + i).ravel(), (BLOCK * other.take(once) + j).ravel()
    pairs = np.flatnonzero((a < b) & (b < count))
    return a.take(pairs), b.take(pairs)


def _straddling(pairs: np.ndarray, topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """The pairs in which each face has vertices on both sides of the other's plane."""
    normals, faces = face_normals(topology, vertices), _padded_faces(topology)
    for one, other in ((0, 1), (1, 0)):
        plane, points = pairs[:, one], faces.take(pairs[:, other], axis=0)
        normal, origin = normals.take(plane, axis=0), vertices.take(faces[:, 0].take(plane), axis=0)
        heights = [dot(vertices.take(column, axis=0) - origin, normal) for column in points.T]
        pairs = pairs[(np.minimum.reduce(heights) < 0) & (np.maximum.reduce(heights) > 0)]
    return pairs


def _padded_faces(topology: Topology) -> np.ndarray:
    """Faces (F, k) padded by repeating their first vertex."""
    size = max([4] + [len(hub) for hub in topology.hubs])
    rows = [np.concatenate([hub, np.full(size - len(hub), hub[0])]) for hub in topology.hubs]
    quads = np.concatenate([topology.quads, np.repeat(topology.quads[:, :1], size - 4, axis=1)], axis=1)
    return np.concatenate([quads, np.reshape(rows, (-1, size))]).astype(np.int64)


def _pierce(pairs: np.ndarray, triangles: np.ndarray, face: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Mask of pairs in which an edge of one face pierces a triangle of the other."""
    first = np.searchsorted(face, np.arange(face[-1] + 1))
    count = np.diff(np.append(first, len(face)))
    hit = np.zeros(len(pairs), bool)
    for one, other in (pairs.T, pairs.T[::-1]):
        for i in range(int(count.max())):
            for j in range(int(count.max())):
                live = (count[one] > i) & (count[other] > j)
                target = vertices[triangles[first[one[live]] + i]]
                source = vertices[triangles[first[other[live]] + j]]
                for k in range(3):
                    hit[live] |= _segment_pierces(source[:, k], source[:, (k + 1) % 3], target)
    return hit


def _segment_pierces(p: np.ndarray, q: np.ndarray, triangle: np.ndarray) -> np.ndarray:
    """Whether segments pq cross the inside of triangles (N, 3, 3), by signs of volumes."""
    a, b, c = triangle[:, 0], triangle[:, 1], triangle[:, 2]
    normal = np.cross(b - a, c - a)
    scale = np.sqrt(dot(normal, normal))
    size = np.sqrt(scale)
    above, below = dot(p - a, normal), dot(q - a, normal)
    margin = TOUCH * scale * size
    along = q - p
    sides = [dot(np.cross(along, u - p), v - p) for u, v in ((a, b), (b, c), (c, a))]
    tolerance = TOUCH * scale * np.sqrt(dot(along, along))
    inside = np.minimum.reduce(sides) > tolerance
    inside |= np.maximum.reduce(sides) < -tolerance
    return (above * below < 0) & (np.abs(above) > margin) & (np.abs(below) > margin) & inside
