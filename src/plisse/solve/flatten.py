"""The development: an exact structure laid flat, accurate to round-off everywhere (§2.3).

Chains of positions lose digits. Here directions are summed as angles along a short tree of faces that starts in the
middle, positions follow from directions, and isometry steps on all vertices at once remove what is left.
"""

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from plisse.geometry.vectors import dot, norm, unit
from plisse.leastsquares.kernel import Rows, Term
from plisse.leastsquares.problem import Problem
from plisse.measure.isometry import isometry_defect
from plisse.measure.planarity import face_normals
from plisse.solve.energies import given_length
from plisse.structure.cut import Cut
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["flatten", "laid_out", "refine_isometry", "unfold"]

GOOD_ENOUGH = 3e-14


def flatten(structure: PleatedStructure, cut: Cut | None = None) -> PleatedStructure:
    """The structure with its development, faces counterclockwise, lying in the first quadrant along the x axis.

    A closed structure must bring its cut. Where the structure is not exactly developable the development is the
    least-squares one.
    """
    cut = structure.cut if cut is None else cut
    vertices = structure.vertices[cut.source]
    flat = refine_isometry(cut.topology, vertices, unfold(cut.topology, vertices))
    return replace(structure, cut=cut, development=laid_out(cut.topology, flat))


def unfold(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Development (V, 2) by turning face after face into the plane of the middle one."""
    local, following = _local_coordinates(topology, vertices), _following(topology)
    direction = np.angle(local[following] - local)
    rotation, translation = np.zeros(topology.face_count), np.zeros(topology.face_count, complex)
    for child, parent, at_child, at_parent in _face_tree(topology):
        # the two faces run through their common edge in opposite directions
        rotation[child] = rotation[parent] + direction[at_parent] - direction[at_child] + np.pi
        joint = local[at_parent], local[following[at_child]]
        translation[child] = (translation[parent] + np.exp(1j * rotation[parent]) * joint[0]
                              - np.exp(1j * rotation[child]) * joint[1])
    corners = topology.corners
    placed = translation[corners.face] + np.exp(1j * rotation[corners.face]) * local
    count = np.bincount(corners.vertex, minlength=topology.vertex_count).clip(1)
    return np.stack([np.bincount(corners.vertex, part, topology.vertex_count) / count
                     for part in (placed.real, placed.imag)], axis=1)


def refine_isometry(topology: Topology, vertices: np.ndarray, flat: np.ndarray, steps: int = 4) -> np.ndarray:
    """Development (V, 2) after Gauss–Newton steps on all edge and diagonal lengths."""
    i, j = topology.rods.T
    scale = norm(vertices[i] - vertices[j]).mean()
    square = dot(d := (vertices[i] - vertices[j]) / scale, d)
    key = np.arange(topology.vertex_count) if topology.ordering is None else topology.ordering
    term = Term("isometry", given_length, (Rows("flat", i), Rows("flat", j)), 1.0, {"square": square})
    problem = Problem([term], {"flat": (2, key)})
    blocks = {"flat": flat.T / scale}
    best, least = flat, isometry_defect(topology, vertices, flat)
    for _ in range(steps):
        if least < GOOD_ENOUGH:
            break
        at = problem.linearise(blocks)
        blocks = problem.moved(blocks, -problem.factor(at, 1e-10).solve(problem.gradient(at)))
        error = isometry_defect(topology, vertices, scale * blocks["flat"].T)
        if not error < 0.7 * least:
            break
        best, least = scale * blocks["flat"].T, error
    return best


def laid_out(topology: Topology, flat: np.ndarray) -> np.ndarray:
    """The same development turned so that its smallest rectangle lies along the x axis, with its corner at 0."""
    from shapely import MultiPoint, get_coordinates, oriented_envelope

    used = flat[np.unique(topology.corners.vertex)]
    box = get_coordinates(oriented_envelope(MultiPoint(used)))
    sides = np.diff(box, axis=0)
    x = unit(sides[np.argmax(norm(sides[:2]))]) if len(sides) > 1 else np.array([1.0, 0.0])
    if (x[0], x[1]) < (0, 0):
        x = -x
    turned = flat @ np.array([[x[0], -x[1]], [x[1], x[0]]])
    return turned - turned[np.unique(topology.corners.vertex)].min(axis=0)


def _local_coordinates(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Every corner (C,) in a complex coordinate of its face's plane, faces seen counterclockwise."""
    corners = topology.corners
    normal = face_normals(topology, vertices)
    first = np.concatenate([[0], np.flatnonzero(np.diff(corners.face)) + 1])
    origin = vertices[corners.vertex[first]]
    x = vertices[corners.next[first]] - origin
    x = unit(x - dot(x, normal)[:, None] * normal)
    y = np.cross(normal, x)
    offset = vertices[corners.vertex] - origin[corners.face]
    return dot(offset, x[corners.face]) + 1j * dot(offset, y[corners.face])


def _following(topology: Topology) -> np.ndarray:
    """Corner that follows each corner in its face."""
    face = topology.corners.face
    first = np.concatenate([[0], np.flatnonzero(np.diff(face)) + 1])
    following = np.arange(len(face)) + 1
    following[np.append(first[1:], len(face)) - 1] = first
    return following


def _face_tree(topology: Topology) -> list[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]:
    """Breadth-first levels from a middle face: children, parents and their corners at the common edge."""
    corners = topology.corners
    low, high = np.minimum(corners.vertex, corners.next), np.maximum(corners.vertex, corners.next)
    order = np.argsort(low * np.int64(topology.vertex_count) + high, kind="stable")
    twin = np.flatnonzero((np.diff(low[order]) == 0) & (np.diff(high[order]) == 0))
    a, b = order[twin], order[twin + 1]
    start, end = np.concatenate([a, b]), np.concatenate([b, a])
    # corner + 1, because a stored zero is no entry
    link = coo_array((start + 1.0, (corners.face[start], corners.face[end])), shape=(topology.face_count,) * 2).tocsr()
    root = _middle(link)
    sequence, parent = breadth_first_order(link, root, directed=False)
    depth = np.zeros(topology.face_count, np.int64)
    for face, above in zip(sequence[1:].tolist(), parent[sequence[1:]].tolist(), strict=True):
        depth[face] = depth[above] + 1
    children = sequence[1:]
    at_parent = np.asarray(link[parent[children], children]).ravel().astype(np.int64) - 1
    at_child = np.asarray(link[children, parent[children]]).ravel().astype(np.int64) - 1
    cuts = np.flatnonzero(np.diff(depth[children])) + 1
    split = [np.split(column, cuts) for column in (children, parent[children], at_child, at_parent)]
    return list(zip(*split, strict=True))


def _middle(link) -> int:
    """A face half way along a longest path: far from a far face's far face."""
    end = breadth_first_order(link, 0, directed=False)[0][-1]
    sequence, parent = breadth_first_order(link, end, directed=False)
    path = [int(sequence[-1])]
    while path[-1] != end:
        path.append(int(parent[path[-1]]))
    return path[len(path) // 2]
