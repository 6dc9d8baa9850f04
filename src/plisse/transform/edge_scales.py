"""The linear space of all meshes parallel to a structure (§2.3).

A parallel mesh has the same faces, and its edges are the edges of the structure times edge scales λ. The scales of the
edges around a face must bring them back to where they begin: two linear conditions per planar face. Where a structure is
not simply connected every loop that faces do not fill adds three. An open grid of m creases with n vertices keeps
(m − 1) + (n − 1) freedoms: one per edge of two transverse polylines.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array, vstack
from scipy.sparse.linalg import splu

from plisse.errors import InvalidStructure
from plisse.geometry.vectors import dot, norm, unit
from plisse.measure.planarity import face_normals
from plisse.structure.incidence import edges_of_corners, loop_edges, tree_edges
from plisse.structure.pleated import PleatedStructure

__all__ = ["ParallelSpace"]


@dataclass(frozen=True, eq=False)
class ParallelSpace:
    """All meshes parallel to `structure`, as edge scales (E,) in the order of its edges.

    Raises InvalidStructure for meshes that fall into pieces or have an edge of length 0.
    """

    structure: PleatedStructure

    def __post_init__(self):
        topology = self.structure.topology
        if len(self._tree[0]) < topology.vertex_count:
            raise InvalidStructure(f"only {len(self._tree[0])} of {topology.vertex_count} vertices hang together; parallel "
                                   "meshes are made of one connected piece")
        lengths = norm(self.directions)
        if not lengths.min() > 1e-12 * lengths.max():
            a, b = topology.edges.vertices[int(np.argmin(lengths))]
            raise InvalidStructure(f"the edge between vertices {a} and {b} has no length, so nothing is parallel to it")

    @cached_property
    def directions(self) -> np.ndarray:
        """Edges of the structure as vectors (E, 3), in model units."""
        start, end = self.structure.topology.edges.vertices.T
        return self.structure.vertices[end] - self.structure.vertices[start]

    @cached_property
    def conditions(self) -> csr_array:
        """Matrix (K, E) whose kernel are the scales of all parallel meshes; its entries have no unit."""
        return csr_array(vstack([self._closed_faces, self._closed_loops]))

    @property
    def dimension(self) -> int:
        """Freedoms of the edge scales, translations not counted; a dense rank where loops may repeat what faces say."""
        rows, edges = self.conditions.shape
        if not len(self.loops):
            return edges - rows
        return edges - int(np.linalg.matrix_rank(self.conditions.toarray(), tol=1e-9))

    def positions(self, scales: np.ndarray) -> np.ndarray:
        """Vertices (V, 3) of the parallel mesh with these scales (E,); the first vertex stays where it is.

        Edges are summed along a tree; what rounding leaves at the others is spread by least squares.
        """
        edges, start = self.structure.topology.edges.vertices, self.structure.vertices
        leading = self._tree[1]
        wanted = scales[:, None] * self.directions
        placed = start.copy()
        for level in self._levels:
            edge = leading[level]
            forward = edges[edge, 1] == level
            parent = np.where(forward, edges[edge, 0], edges[edge, 1])
            placed[level] = placed[parent] + np.where(forward, 1.0, -1.0)[:, None] * wanted[edge]
        missing = wanted - (placed[edges[:, 1]] - placed[edges[:, 0]])
        correction = np.zeros_like(placed)
        correction[1:] = self._laplacian.solve((self._incidence.T @ missing)[1:])
        return placed + correction

    def scales(self, vertices: np.ndarray) -> np.ndarray:
        """Edge scales (E,) of a mesh with the same topology: its edges measured along the structure's."""
        start, end = self.structure.topology.edges.vertices.T
        return dot(vertices[end] - vertices[start], self.directions) / dot(self.directions, self.directions)

    @cached_property
    def spanning(self) -> np.ndarray:
        """Edges that join all vertices without a loop."""
        return np.sort(self._tree[1][self._tree[1] >= 0])

    @cached_property
    def loops(self) -> np.ndarray:
        """Edges that close one loop each which faces do not fill."""
        return loop_edges(self.structure.topology, self._tree[1])

    @cached_property
    def _closed_faces(self) -> csr_array:
        """Two rows per face: its scaled edges, in two directions of its plane, sum to zero."""
        topology = self.structure.topology
        corners, (edge, sign) = topology.corners, edges_of_corners(topology)
        around = sign[:, None] * self.directions[edge]
        first = np.flatnonzero(np.diff(corners.face, prepend=-1))
        normal = face_normals(topology, self.structure.vertices)
        along = unit(around[first] - dot(around[first], normal)[:, None] * normal)
        across = np.cross(normal, along)
        size = np.sqrt(np.bincount(corners.face, dot(around, around)))[corners.face]
        rows = np.concatenate([2 * corners.face, 2 * corners.face + 1])
        values = np.concatenate([dot(around, axis[corners.face]) / size for axis in (along, across)])
        shape = (2 * topology.face_count, len(self.directions))
        return csr_array(coo_array((values, (rows, np.tile(edge, 2))), shape=shape))

    @cached_property
    def _closed_loops(self) -> csr_array:
        """Three rows per loop that faces do not fill."""
        edges, leading = self.structure.topology.edges.vertices, self._tree[1]
        rows, columns, values = [], [], []
        for number, edge in enumerate(self.loops.tolist()):
            path = [(edge, 1.0)]
            for vertex, sign in zip(edges[edge].tolist(), (1.0, -1.0), strict=True):
                while (step := leading[vertex]) >= 0:
                    forward = edges[step, 1] == vertex
                    path.append((int(step), sign if forward else -sign))
                    vertex = int(edges[step, 0] if forward else edges[step, 1])
            used = np.array([entry[0] for entry in path])
            part = np.array([entry[1] for entry in path])[:, None] * self.directions[used]
            size = np.sqrt(dot(part, part).sum())
            for axis in range(3):
                rows.append(np.full(len(used), 3 * number + axis))
                columns.append(used)
                values.append(part[:, axis] / size)
        shape = (3 * len(self.loops), len(self.directions))
        if not rows:
            return csr_array(shape)
        return csr_array(coo_array((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=shape))

    @cached_property
    def _tree(self) -> tuple[np.ndarray, np.ndarray]:
        return tree_edges(self.structure.topology, 0)

    @cached_property
    def _levels(self) -> list[np.ndarray]:
        """Vertices beyond the first by their distance from it in the tree."""
        edges, (sequence, leading) = self.structure.topology.edges.vertices, self._tree
        depth = np.zeros(len(leading), np.int64)
        for vertex in sequence[1:].tolist():
            a, b = edges[leading[vertex]]
            depth[vertex] = 1 + depth[a if b == vertex else b]
        order = np.argsort(depth[sequence[1:]], kind="stable")
        sorted_ = sequence[1:][order]
        return np.split(sorted_, np.flatnonzero(np.diff(depth[sorted_])) + 1)

    @cached_property
    def _incidence(self) -> csr_array:
        edges = self.structure.topology.edges.vertices
        rows = np.repeat(np.arange(len(edges)), 2)
        values = np.tile([-1.0, 1.0], len(edges))
        shape = (len(edges), self.structure.topology.vertex_count)
        return csr_array(coo_array((values, (rows, edges.ravel())), shape=shape))

    @cached_property
    def _laplacian(self):
        """Factor of the graph's Laplacian with the first vertex held."""
        matrix = csc_array(self._incidence.T @ self._incidence)
        return splu(csc_array(matrix[1:, 1:]))
