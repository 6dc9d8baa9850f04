"""Meshes flattened with equal angles: sheets onto a plane, tubes onto a cylinder rolled out.

Sheets follow Mullen, Tong, Alliez and Desbrun, Spectral conformal parameterization (2008): of all maps they keep angles
best and let the boundary move freely, which keeps the change of lengths small.
"""

import numpy as np
from scipy.sparse import block_array, coo_array, csc_array, eye_array
from scipy.sparse.csgraph import breadth_first_order
from scipy.sparse.linalg import SuperLU, splu

from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import cross_flat, dot, unit

__all__ = ["flattened_sheet", "flattened_tube", "stretches"]

ITERATIONS = 30
SYMMETRIC = 1e-4  # relative difference below which two directions count as alike
SHIFT = 1e-10  # of the mean diagonal: makes the matrix of angles definite


def flattened_sheet(mesh: ReferenceMesh) -> np.ndarray:
    """Places (V, 2) of the vertices of a mesh with boundary, conformal, of the same area and orientation.

    The first axis is the long one. Nothing keeps places from overlapping where the sheet winds around.
    """
    count = len(mesh.vertices)
    start, end = mesh.half_edges[mesh.boundary].T
    half = np.full(len(start), 0.5)
    ends = np.concatenate([start, end]), np.concatenate([end, start])
    area = _gathered(np.concatenate([half, -half]), *ends, count)
    stretched = _cotangents(mesh, gradients(mesh))
    factor = _factor(csc_array(block_array([[stretched, -area], [area, stretched]])))
    rim = np.unique(start)
    gap = mesh.vertices - mesh.vertices.mean(axis=0)
    places = gap @ np.linalg.eigh(gap.T @ gap)[1][:, :0:-1]
    for _ in range(ITERATIONS):  # the flattest map of those whose rim has mean 0 and moment 1
        forced = np.zeros((count, 2))
        forced[rim] = places[rim] - places[rim].mean(axis=0)
        places = factor.solve(forced.T.ravel()).reshape(2, count).T
        places -= places[rim].mean(axis=0)
        places /= np.linalg.norm(places[rim])
    places = places * np.sqrt(mesh.area / np.abs(_signed_areas(mesh, places).sum()))
    return _turned(places)


def flattened_tube(mesh: ReferenceMesh) -> tuple[np.ndarray, float]:
    """Places (V, 2) of the vertices of a tube rolled out, u from 0 to the period around it, v up from the longer rim.

    The period comes second. v is harmonic and constant along the two rims, u conjugate to it; area and orientation are
    those of the mesh, which must be an annulus.
    """
    slopes = gradients(mesh)
    matrix = _cotangents(mesh, slopes)
    low, high = mesh.boundary_loops
    v = np.zeros(len(mesh.vertices))
    v[high] = 1.0
    free = np.setdiff1d(np.arange(len(v)), np.concatenate([low, high]))
    v[free] = _factor(matrix[free][:, free]).solve(-(matrix[free] @ v))
    rise = np.einsum("fkd,fk->fd", slopes, v[mesh.triangles])
    flux = float((mesh.areas * dot(rise, rise)).sum())
    wanted = np.stack([rise[:, 1], -rise[:, 0]], axis=-1) / flux  # the gradient of u, which gains 1 in going around
    lifts = _windings(mesh, wanted)
    rest = wanted - np.einsum("fkd,fk->fd", slopes, lifts)
    u = _factor(matrix).solve(_divergence(mesh, slopes, rest))
    period = np.sqrt(mesh.area * flux)
    return np.stack([period * (u % 1.0), period / flux * v], axis=-1), float(period)


def stretches(mesh: ReferenceMesh, places: np.ndarray, period: float | None = None) -> np.ndarray:
    """Singular values (F, 2) of the map from the faces to the plane, larger ones first; negative where turned over."""
    corners = places[mesh.triangles]
    if period is not None:
        corners[..., 0] -= period * np.round((corners[..., 0] - corners[:, :1, 0]) / period)
    matrix = np.einsum("fkd,fki->fid", gradients(mesh), corners)
    turned = np.where(matrix[:, 0, 0] * matrix[:, 1, 1] < matrix[:, 0, 1] * matrix[:, 1, 0], -1.0, 1.0)
    return turned[:, None] * np.linalg.svd(matrix, compute_uv=False)


def gradients(mesh: ReferenceMesh) -> np.ndarray:
    """Gradients (F, 3, 2) of the hat functions of the corners, in a frame of each face."""
    local = _local(mesh)
    opposite = np.roll(local, -2, axis=1) - np.roll(local, -1, axis=1)
    return np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1) / (2 * mesh.areas)[:, None, None]


def _local(mesh: ReferenceMesh) -> np.ndarray:
    """Corners (F, 3, 2) in the plane of each face."""
    gap = mesh.corners - mesh.corners[:, :1]
    x = unit(gap[:, 1])
    return np.stack([dot(gap, x[:, None]), dot(gap, np.cross(mesh.normals, x)[:, None])], axis=-1)


def _windings(mesh: ReferenceMesh, wanted: np.ndarray) -> np.ndarray:
    """Whole numbers (F, 3) by which a function of period 1 with given face gradients (F, 2) rises over each face.

    The function is integrated along a tree of edges; what other edges disagree by is whole.
    """
    count, (start, end) = len(mesh.vertices), mesh.half_edges.T
    local = _local(mesh)
    step = np.einsum("fkd,fd->fk", np.roll(local, -1, axis=1) - local, wanted).ravel()
    step = np.where(mesh.twins >= 0, 0.5 * (step - step[mesh.twins]), step)
    both = _gathered(np.concatenate([step, -step]), np.concatenate([start, end]), np.concatenate([end, start]), count)
    sides = _gathered(np.ones(2 * len(step)), np.concatenate([start, end]), np.concatenate([end, start]), count)
    parent = breadth_first_order(sides, 0, directed=False)[1]
    parent[0] = 0
    value = np.asarray(both[parent, np.arange(count)]).ravel() / np.maximum(
        np.asarray(sides[parent, np.arange(count)]).ravel(), 1)
    while (parent > 0).any():  # every vertex adds what its ancestors have gathered, twice as far each time
        value, parent = value + value[parent], parent[parent]
    whole = np.round(step - value[end] + value[start]).reshape(-1, 3)
    return np.stack([np.zeros(len(whole)), whole[:, 0], whole[:, 0] + whole[:, 1]], axis=-1)


def _divergence(mesh: ReferenceMesh, slopes: np.ndarray, field: np.ndarray) -> np.ndarray:
    """Right-hand side (V,) of the Poisson equation for face gradients (F, 2)."""
    part = np.einsum("fkd,fd,f->fk", slopes, field, mesh.areas)
    return np.bincount(mesh.triangles.ravel(), part.ravel(), len(mesh.vertices))


def _cotangents(mesh: ReferenceMesh, slopes: np.ndarray) -> csc_array:
    """∫ ∇φ_i · ∇φ_j (V, V)."""
    entries = np.einsum("fid,fjd,f->fij", slopes, slopes, mesh.areas)
    rows, columns = np.repeat(mesh.triangles, 3, axis=1), np.tile(mesh.triangles, (1, 3))
    return _gathered(entries.ravel(), rows.ravel(), columns.ravel(), len(mesh.vertices))


def _gathered(entries: np.ndarray, rows: np.ndarray, columns: np.ndarray, size: int) -> csc_array:
    return csc_array(coo_array((entries, (rows, columns)), shape=(size, size)))


def _factor(matrix: csc_array) -> SuperLU:
    shifted = csc_array(matrix + SHIFT * matrix.diagonal().mean() * eye_array(matrix.shape[0]))
    return splu(shifted, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def _signed_areas(mesh: ReferenceMesh, places: np.ndarray) -> np.ndarray:
    p, q, r = places[mesh.triangles].transpose(1, 0, 2)
    return 0.5 * cross_flat(q - p, r - p)


def _turned(places: np.ndarray) -> np.ndarray:
    """The places about their centre, the first axis along the longer extent and towards its longer tail.

    Where symmetry leaves that open the first vertex decides, so that moved copies are laid out alike.
    """
    gap = places - places.mean(axis=0)
    (short, long), axes = np.linalg.eigh(gap.T @ gap)
    x = axes[:, 1] if long - short > SYMMETRIC * long else unit(gap[:1])[0]
    cubes = (gap @ x) ** 3
    tail = cubes.sum() if abs(cubes.sum()) > SYMMETRIC * np.abs(cubes).sum() else gap[0] @ x
    if tail < 0:
        x = -x
    return gap @ np.stack([x, [-x[1], x[0]]], axis=-1)
