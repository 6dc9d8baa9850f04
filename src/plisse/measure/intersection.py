"""Self-intersection of the folded shape: edges that pierce faces they do not touch."""

import numpy as np
import shapely

from plisse.geometry.vectors import dot
from plisse.measure.planarity import face_normals
from plisse.structure.topology import Topology
from plisse.structure.triangles import triangulated

__all__ = ["intersecting_faces"]

CHUNK = 400_000
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
    faces = _padded_faces(topology)
    columns = [vertices[column] for column in faces.T]
    low, high = np.minimum.reduce(columns), np.maximum.reduce(columns)
    flat, third = _flattest_axis(vertices)
    boxes = shapely.box(low[:, flat[0]], low[:, flat[1]], high[:, flat[0]], high[:, flat[1]])
    a, b = shapely.STRtree(boxes).query(boxes)
    keep = (a < b) & (low[a, third] <= high[b, third]) & (low[b, third] <= high[a, third])
    a, b = a[keep], b[keep]
    one, other = faces[a], faces[b]
    touching = np.logical_or.reduce([one[:, i] == other[:, j] for i, j in np.ndindex(faces.shape[1], faces.shape[1])])
    return np.stack([a[~touching], b[~touching]], axis=1)


def _straddling(pairs: np.ndarray, topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """The pairs in which each face has vertices on both sides of the other's plane."""
    normals, faces = face_normals(topology, vertices), _padded_faces(topology)
    for one, other in ((0, 1), (1, 0)):
        plane, points = pairs[:, one], faces[pairs[:, other]]
        origin = vertices[faces[plane, 0]]
        heights = np.stack([dot(vertices[column] - origin, normals[plane]) for column in points.T])
        pairs = pairs[(heights.min(axis=0) < 0) & (heights.max(axis=0) > 0)]
    return pairs


def _flattest_axis(vertices: np.ndarray) -> tuple[list[int], int]:
    order = np.argsort(-np.ptp(vertices, axis=0), kind="stable")
    return [int(order[0]), int(order[1])], int(order[2])


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
