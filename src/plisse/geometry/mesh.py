"""Triangle meshes that serve as reference surfaces: one connected, oriented piece, with or without boundary."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.vectors import norm, unit

__all__ = ["ReferenceMesh", "grid_mesh"]


@dataclass(frozen=True, eq=False)
class ReferenceMesh:
    """`vertices` (V, 3) and consistently oriented `triangles` (F, 3); `notes` say what had to be repaired.

    Half-edge 3f + k runs from corner k to corner k + 1 of face f.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    notes: tuple[str, ...] = ()

    def __post_init__(self):
        object.__setattr__(self, "vertices", np.ascontiguousarray(self.vertices, dtype=float))
        object.__setattr__(self, "triangles", np.ascontiguousarray(self.triangles, dtype=np.int64))
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 3:
            raise ValueError(f"vertices have shape {self.vertices.shape}; expected (V, 3)")
        if self.triangles.ndim != 2 or self.triangles.shape[1] != 3:
            raise ValueError(f"triangles have shape {self.triangles.shape}; expected (F, 3)")

    @cached_property
    def corners(self) -> np.ndarray:
        """Corner points (F, 3, 3) of the faces."""
        return self.vertices[self.triangles]

    @cached_property
    def face_vectors(self) -> np.ndarray:
        """Area vectors (F, 3): normal times area."""
        p, q, r = self.corners.transpose(1, 0, 2)
        return 0.5 * np.cross(q - p, r - p)

    @cached_property
    def areas(self) -> np.ndarray:
        """Face areas (F,)."""
        return norm(self.face_vectors)

    @cached_property
    def normals(self) -> np.ndarray:
        """Unit face normals (F, 3)."""
        return unit(self.face_vectors)

    @cached_property
    def vertex_normals(self) -> np.ndarray:
        """Unit vertex normals (V, 3): face normals weighted by the angles at the vertex."""
        p = self.corners
        after, before = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
        angle = np.arctan2(norm(np.cross(after, before)), np.einsum("fki,fki->fk", after, before))
        weighted = angle[:, :, None] * self.normals[:, None, :]
        return unit(_scattered(self.triangles.ravel(), weighted.reshape(-1, 3), len(self.vertices)))

    @cached_property
    def half_edges(self) -> np.ndarray:
        """Start and end vertex (3F, 2) of every half-edge."""
        return np.stack([self.triangles, np.roll(self.triangles, -1, axis=1)], axis=-1).reshape(-1, 2)

    @cached_property
    def twins(self) -> np.ndarray:
        """The opposite half-edge (3F,) of every half-edge, −1 along the boundary."""
        count = len(self.vertices)
        key = self.half_edges[:, 0] * count + self.half_edges[:, 1]
        opposite = self.half_edges[:, 1] * count + self.half_edges[:, 0]
        order = np.argsort(key)
        place = np.minimum(np.searchsorted(key[order], opposite), len(key) - 1)
        return np.where(key[order][place] == opposite, order[place], -1)

    @cached_property
    def edges(self) -> np.ndarray:
        """Undirected edges (E, 2)."""
        return np.unique(np.sort(self.half_edges, axis=1), axis=0)

    @cached_property
    def edge_lengths(self) -> np.ndarray:
        """Lengths (E,) of the edges."""
        return norm(self.vertices[self.edges[:, 1]] - self.vertices[self.edges[:, 0]])

    @cached_property
    def edge_length(self) -> float:
        """Mean edge length."""
        return float(self.edge_lengths.mean())

    @cached_property
    def area(self) -> float:
        """Total area."""
        return float(self.areas.sum())

    @cached_property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return float(norm(np.ptp(self.vertices, axis=0)))

    @cached_property
    def boundary(self) -> np.ndarray:
        """Half-edges without a twin."""
        return np.flatnonzero(self.twins < 0)

    @cached_property
    def boundary_loops(self) -> tuple[np.ndarray, ...]:
        """Vertices of every boundary loop, longest loop first; the surface lies on the left."""
        start, end = self.half_edges[self.boundary].T
        following = dict(zip(start.tolist(), end.tolist(), strict=True))
        loops = []
        while following:
            first, vertex = next(iter(following.items()))
            loop = [first]
            del following[first]
            while vertex != first:
                loop.append(vertex)
                vertex = following.pop(vertex)
            loops.append(np.array(loop))
        return tuple(sorted(loops, key=self._loop_length, reverse=True))

    def _loop_length(self, loop: np.ndarray) -> float:
        points = self.vertices[loop]
        return float(norm(np.roll(points, -1, axis=0) - points).sum())


def grid_lines(x: tuple[float, float], y: tuple[float, float], cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of a grid of nearly square cells over a rectangle, `cells` along its longer side and at least four."""
    width, depth = x[1] - x[0], y[1] - y[0]
    size = max(width, depth) / cells
    return np.linspace(*x, max(4, round(width / size)) + 1), np.linspace(*y, max(4, round(depth / size)) + 1)


def grid_mesh(points: np.ndarray, closed: tuple[bool, bool] = (False, False)) -> ReferenceMesh:
    """Triangulated grid (m, n, 3), `closed` in its first or second direction; normals along ∂₁ × ∂₂.

    Diagonals alternate, so that no direction is preferred.
    """
    rows, columns = points.shape[:2]
    i, j = np.meshgrid(np.arange(rows - (not closed[0])), np.arange(columns - (not closed[1])), indexing="ij")
    index = np.arange(rows * columns).reshape(rows, columns)
    p, q = index[i, j].ravel(), index[(i + 1) % rows, j].ravel()
    r, s = index[(i + 1) % rows, (j + 1) % columns].ravel(), index[i, (j + 1) % columns].ravel()
    even = ((i + j) % 2 == 0).ravel()[:, None]
    first = np.where(even, np.stack([p, q, r], axis=1), np.stack([p, q, s], axis=1))
    second = np.where(even, np.stack([p, r, s], axis=1), np.stack([q, r, s], axis=1))
    return ReferenceMesh(points.reshape(-1, 3), np.concatenate([first, second]))


def _scattered(index: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Sums (count, 3) of the rows of `values` by index."""
    return np.stack([np.bincount(index, column, count) for column in values.T], axis=1)
