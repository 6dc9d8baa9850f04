"""The development: an exact structure laid flat, accurate to round-off everywhere (§2.3).

Chains of positions lose digits. Here directions are summed as angles along a short tree of faces that starts in the
middle, positions follow from directions, and isometry steps on all vertices at once remove what is left.
"""

from dataclasses import replace

import numpy as np

from plisse.geometry import components
from plisse.geometry.vectors import dot, norm, unit
from plisse.leastsquares.kernel import Rows, Term
from plisse.leastsquares.problem import Problem
from plisse.measure.isometry import isometry_defect
from plisse.measure.planarity import face_normals
from plisse.solve.energies import given_length
from plisse.solve.workspace import Workspace
from plisse.structure.cut import Cut
from plisse.structure.face_tree import face_tree
from plisse.structure.incidence import corner_means
from plisse.structure.parts import parts
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["flatten", "laid_out", "refine_isometry", "smallest_box", "unfold"]

GOOD_ENOUGH = 3e-14


def flatten(structure: PleatedStructure, cut: Cut | None = None, workspace: Workspace | None = None) -> PleatedStructure:
    """The structure with its development, faces counterclockwise, lying in the first quadrant along the x axis.

    A closed structure must bring its cut; what a cut takes apart lies one piece above the other, a mean edge apart.
    Where the structure is not exactly developable the development is the least-squares one. Sheets that share a
    `workspace` and a topology share their sparsity patterns.
    """
    workspace = workspace or Workspace()
    cut = structure.cut if cut is None else cut
    development, above = np.zeros((len(cut.source), 2)), 0.0
    for part in parts(cut.topology):
        vertices = structure.vertices[cut.source[part.vertices]]
        flat = refine_isometry(part.topology, vertices, unfold(part.topology, vertices, workspace),
                               workspace=workspace)
        development[part.vertices] = laid_out(part.topology, flat) + np.array([0.0, above])
        above = float(development[part.vertices, 1].max()) + structure.mean_edge
    return replace(structure, cut=cut, development=development)


def unfold(topology: Topology, vertices: np.ndarray, workspace: Workspace | None = None) -> np.ndarray:
    """Development (V, 2) by turning face after face into the plane of the middle one."""
    tree = (workspace or Workspace()).held(("face tree", topology), lambda: face_tree(topology))
    local, following = _local_coordinates(topology, vertices), _following(topology)
    direction = np.angle(local[following] - local)
    child, parent, at_child, at_parent = tree.every
    # the two faces run through their common edge in opposite directions
    spin = np.exp(1j * tree.summed(direction[at_parent] - direction[at_child] + np.pi))
    translation = tree.summed(spin[parent] * local[at_parent] - spin[child] * local[following[at_child]])
    corners = topology.corners
    placed = translation[corners.face] + spin[corners.face] * local
    return corner_means(topology, np.stack([placed.real, placed.imag], axis=1))


def refine_isometry(topology: Topology, vertices: np.ndarray, flat: np.ndarray, steps: int = 4,
                    workspace: Workspace | None = None) -> np.ndarray:
    """Development (V, 2) after Gauss–Newton steps on all edge and diagonal lengths."""
    i, j = topology.rods.T
    scale = norm(vertices[i] - vertices[j]).mean()
    square = dot(d := (vertices[i] - vertices[j]) / scale, d)
    key = np.arange(topology.vertex_count) if topology.ordering is None else topology.ordering
    term = Term("isometry", given_length, (Rows("flat", i), Rows("flat", j)), 1.0, {"square": square})
    problem = (workspace or Workspace()).held(
        ("isometry", topology), lambda: Problem([term], {"flat": (2, key)}).prepare()).with_terms([term])
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
    sides = smallest_box(flat[topology.edges.vertices[topology.edges.is_boundary, 0]])
    x = unit(sides[np.argmax(norm(sides))])
    if (x[0], x[1]) < (0, 0):
        x = -x
    turned = flat @ np.array([[x[0], -x[1]], [x[1], x[0]]])
    return turned - turned[topology.corners.vertex].min(axis=0)


def smallest_box(points: np.ndarray) -> np.ndarray:
    """Two sides (2, 2) of the smallest rectangle around points (N, 2), in any direction."""
    from shapely import get_coordinates, linestrings, oriented_envelope

    box = get_coordinates(oriented_envelope(linestrings(points)))
    sides = np.diff(box, axis=0)[:2]
    return sides if len(sides) == 2 else np.array([[1.0, 0.0], [0.0, 0.0]])


def _local_coordinates(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Every corner (C,) in a complex coordinate of its face's plane, faces seen counterclockwise."""
    corners, points = topology.corners, np.ascontiguousarray(vertices.T)
    normal = np.ascontiguousarray(face_normals(topology, vertices).T)
    first = np.concatenate([[0], np.flatnonzero(np.diff(corners.face)) + 1])
    origin = points[:, corners.vertex[first]]
    x = points[:, corners.next[first]] - origin
    x -= components.dot(x, normal) * normal
    x /= np.maximum(components.norm(x), np.finfo(float).tiny)
    y = components.cross(normal, x)
    offset = points[:, corners.vertex] - origin[:, corners.face]
    return components.dot(offset, x[:, corners.face]) + 1j * components.dot(offset, y[:, corners.face])


def _following(topology: Topology) -> np.ndarray:
    """Corner that follows each corner in its face."""
    face = topology.corners.face
    first = np.concatenate([[0], np.flatnonzero(np.diff(face)) + 1])
    following = np.arange(len(face)) + 1
    following[np.append(first[1:], len(face)) - 1] = first
    return following
