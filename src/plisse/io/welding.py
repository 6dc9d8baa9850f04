"""Welding meshes whose faces came apart on export: vertices in the same place become one."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["welded"]


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


def _pieces(faces: list[list[int]], count: int) -> int:
    """Number of pieces that are connected over vertices."""
    start = np.concatenate([np.repeat(face[0], len(face)) for face in faces])
    end = np.concatenate(faces)
    graph = coo_array((np.ones(len(end), np.int8), (start, end)), shape=(count, count))
    return len(np.unique(connected_components(graph, directed=False)[1][end]))
