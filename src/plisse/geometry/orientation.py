"""Triangles turned to agree with their neighbours, and vertices split where parts of a surface only touch."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from plisse.errors import InvalidMesh
from plisse.geometry.mesh import ReferenceMesh

__all__ = ["components", "counted", "fans_apart", "half_edges", "near", "oriented"]


def oriented(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> np.ndarray:
    """Faces turned so that neighbours run through their common edge in opposite directions.

    Every face is two nodes, as given and turned; a surface can be oriented when they fall into two components.
    """
    half = half_edges(faces)
    edges, edge, uses = np.unique(np.sort(half, axis=1), axis=0, return_inverse=True, return_counts=True)
    if uses.max() > 2:
        worst = int(np.argmax(uses > 2))
        p, q = vertices[edges[worst]]
        raise InvalidMesh(f"{uses[worst]} faces meet in the edge from {_point(p)} to {_point(q)} "
                          f"({counted(int((uses > 2).sum()), 'such edge')}); a surface has at most 2 there")
    order = np.argsort(edge.ravel(), kind="stable")
    pair = np.flatnonzero(np.diff(edge.ravel()[order]) == 0)
    one, two = order[pair], order[pair + 1]
    same = half[one, 0] == half[two, 0]
    total = len(faces)
    f, g = one // 3, two // 3
    label = components(2 * total, np.concatenate([f, f + total]),
                       np.concatenate([g + total * same, g + total * ~same]))
    if label[0] == label[total]:
        clash = int(np.argmax(same)) if same.any() else 0
        raise InvalidMesh(f"the surface is one-sided like a Möbius strip (for instance "
                          f"{near(vertices[half[one[clash]]].mean(axis=0))}); cut it so that it has two sides")
    turned = label[:total] != label[0]
    if turned.sum() > total / 2:
        turned = ~turned
    if turned.any():
        notes.append(f"{counted(int(turned.sum()), 'face was', 'faces were')} turned over to agree with the others")
    return np.where(turned[:, None], faces[:, ::-1], faces)


def fans_apart(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> tuple[np.ndarray, np.ndarray]:
    """Where fans of faces touch in a single vertex only, each fan gets its own copy of it."""
    twins = ReferenceMesh(vertices, faces).twins
    inner = np.flatnonzero(twins >= 0)
    following = 3 * (twins // 3) + (twins + 1) % 3
    label = components(faces.size, inner, following[inner])
    copies, first = np.unique(label, return_index=True)
    used = len(np.unique(faces))
    if len(copies) > used:
        notes.append(f"{counted(len(copies) - used, 'vertex', 'vertices')} in which parts of the surface only touch "
                     f"{'was' if len(copies) == used + 1 else 'were'} split")
    return vertices[faces.ravel()[first]], label.reshape(-1, 3)


def half_edges(faces: np.ndarray) -> np.ndarray:
    """Start and end (3F, 2) of the edges of all faces."""
    return np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)


def components(count: int, one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Component label (count,) of every node of the graph with the edges one–two."""
    graph = coo_array((np.ones(len(one), bool), (one, two)), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def counted(number: int, one: str, many: str | None = None) -> str:
    """“1 face”, “3 faces”."""
    return f"{number} {one if number == 1 else many or one + 's'}"


def _point(place: np.ndarray) -> str:
    return f"({place[0]:.5g}, {place[1]:.5g}, {place[2]:.5g})"


def near(place: np.ndarray) -> str:
    """“near (x, y, z)”."""
    return f"near {_point(place)}"
