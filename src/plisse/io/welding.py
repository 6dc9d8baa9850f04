"""Welding what came apart on export: faces to faces where vertices are the same, polylines to the mesh they run along."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

__all__ = ["attached", "used_only", "welded"]

NEAR = 1e-6


def welded(vertices: np.ndarray, faces: list[list[int]],
           *others: list[list[int]]) -> tuple[np.ndarray, list[list[list[int]]]]:
    """Vertices (V, 3) with equal ones merged, and [faces, *others] renumbered, if the mesh hangs together better for it.

    Meshes in one piece stay as they are: sheets that touch themselves are not glued.
    """
    pieces = _pieces(faces, len(vertices))
    _, first, merged = np.unique(vertices + 0.0, axis=0, return_index=True, return_inverse=True)
    if pieces == 1 or len(first) == len(vertices):
        return vertices, [faces, *others]
    number = np.argsort(np.argsort(first))[merged.reshape(-1)].tolist()
    places = vertices[np.sort(first)]
    renumbered = [[[number[v] for v in path] for path in paths] for paths in (faces, *others)]
    return (places, renumbered) if _pieces(renumbered[0], len(places)) < pieces else (vertices, [faces, *others])


def attached(vertices: np.ndarray, faces: list[list[int]], lines: list[list[int]]) -> list[list[int]]:
    """The polylines with vertices of their own replaced by those of faces in the same place, to 1e-6 of the whole size."""
    used = np.unique(np.concatenate(faces))
    loose = np.setdiff1d(np.concatenate(lines), used) if lines else used[:0]
    if len(loose) == 0:
        return lines
    limit = NEAR * float(np.linalg.norm(np.ptp(vertices[used], axis=0)))
    distance, nearest = cKDTree(vertices[used]).query(vertices[loose])
    met = distance <= limit
    stands_for = dict(zip(loose[met].tolist(), used[nearest[met]].tolist(), strict=True))
    return [[stands_for.get(vertex, vertex) for vertex in line] for line in lines]


def used_only(vertices: np.ndarray, faces: list[list[int]],
              *others: list[list[int]]) -> tuple[np.ndarray, list[list[list[int]]]]:
    """Vertices (V', 3) that faces use, in their order, and [faces, *others] renumbered; others run along faces."""
    used = np.unique(np.concatenate(faces))
    if len(used) == len(vertices):
        return vertices, [faces, *others]
    number = np.zeros(len(vertices), np.int64)
    number[used] = np.arange(len(used))
    return vertices[used], [[number[path].tolist() for path in paths] for paths in (faces, *others)]


def _pieces(faces: list[list[int]], count: int) -> int:
    """Number of pieces that are connected over vertices."""
    start = np.concatenate([np.repeat(face[0], len(face)) for face in faces])
    end = np.concatenate(faces)
    graph = coo_array((np.ones(len(end), np.int8), (start, end)), shape=(count, count))
    return len(np.unique(connected_components(graph, directed=False)[1][end]))
