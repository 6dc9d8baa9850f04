"""From a soup of triangles to one oriented surface, or a sentence that says why not and where."""

import numpy as np
from scipy.spatial import cKDTree

from plisse.errors import InvalidMesh
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.orientation import components, counted, fans_apart, half_edges, near, oriented
from plisse.geometry.vectors import norm

__all__ = ["MAX_FACES", "MIN_FACES", "cleaned"]

MAX_FACES = 500_000
MIN_FACES = 16
FEW = 0.05  # share of zero-area faces that is repaired in silence
SMALL = 0.01  # share of the area below which a separate piece is dropped


def cleaned(vertices: np.ndarray, faces: np.ndarray) -> ReferenceMesh:
    """One connected, oriented, manifold surface from vertices (V, 3) and triangles (F, 3).

    Raises InvalidMesh in one sentence with the place.
    """
    vertices, faces = np.asarray(vertices, dtype=float), np.asarray(faces, dtype=np.int64)
    notes: list[str] = []
    _refuse_bad_numbers(vertices, faces)
    vertices, faces = _merged(vertices, faces, notes)
    faces = _without_flat_faces(vertices, faces, notes)
    faces = _without_repeated_faces(faces, notes)
    faces = _largest_piece(vertices, faces, notes)
    if len(faces) < MIN_FACES:
        raise InvalidMesh(f"the mesh has only {counted(len(faces), 'face')}; "
                          f"a surface to be pleated needs at least {MIN_FACES}")
    faces = oriented(vertices, faces, notes)
    vertices, faces = fans_apart(vertices, faces, notes)
    used, index = np.unique(faces, return_inverse=True)
    return ReferenceMesh(vertices[used], index.reshape(-1, 3), tuple(notes))


def _refuse_bad_numbers(vertices: np.ndarray, faces: np.ndarray) -> None:
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise InvalidMesh("the vertices of the mesh do not have three coordinates each")
    if len(faces) == 0:
        raise InvalidMesh("the mesh has no faces; give a surface of triangles or quads")
    if len(faces) > MAX_FACES:
        raise InvalidMesh(f"the mesh has {len(faces):,} triangles, more than the {MAX_FACES:,} that plisse takes; "
                          "decimate it first")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise InvalidMesh(f"face {int(np.argmax(((faces < 0) | (faces >= len(vertices))).any(axis=1))) + 1} refers to a "
                          f"vertex that does not exist; the mesh has {counted(len(vertices), 'vertex', 'vertices')}")
    bad = ~np.isfinite(vertices).all(axis=1)
    bad[np.setdiff1d(np.arange(len(vertices)), faces)] = False
    if bad.any():
        raise InvalidMesh(f"vertex {int(np.argmax(bad)) + 1} of the mesh has a coordinate that is not a finite number")
    used = vertices[np.unique(faces)]
    largest, diagonal = float(np.abs(used).max()), float(norm(np.ptp(used / max(np.abs(used).max(), 1e-300), axis=0)))
    diagonal *= largest
    if largest > 1e12:
        raise InvalidMesh(f"the mesh has coordinates as large as {largest:.2g}; scale it to a sensible unit")
    if diagonal < 1e-9:
        raise InvalidMesh(f"the mesh is only {diagonal:.2g} across; scale it to a sensible unit")
    if largest > 1e8 * diagonal:
        raise InvalidMesh(f"the mesh is {diagonal:.2g} across but lies {largest:.2g} from the origin, where digits are "
                          "lost; move it closer")


def _merged(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> tuple[np.ndarray, np.ndarray]:
    """Vertices at one place become one vertex: equal ones, and those closer than 1e-7 of the diagonal."""
    used, faces = np.unique(faces, return_inverse=True)
    points, group = np.unique(vertices[used] + 0.0, axis=0, return_inverse=True)
    close = cKDTree(points).query_pairs(1e-7 * float(norm(np.ptp(points, axis=0))), output_type="ndarray")
    if len(close):
        label = components(len(points), close[:, 0], close[:, 1])
        first = np.unique(label, return_index=True)[1]
        points, group = points[first], label[group.ravel()]
    if len(points) < len(used):
        notes.append(f"{counted(len(used) - len(points), 'duplicate vertex was', 'duplicate vertices were')} merged")
    return points, group.ravel()[faces.ravel()].reshape(-1, 3)


def _without_flat_faces(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> np.ndarray:
    """Faces with equal corners go; of needles with three corners on a line the long edge is flipped."""
    total, before = len(faces), faces
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    flat = _flat(vertices, faces)
    removed = total - len(faces) + int(flat.sum())
    if removed == total:
        raise InvalidMesh("all faces of the mesh have zero area")
    if removed > max(FEW * total, 2):
        where = np.flatnonzero(_flat(vertices, before))[0]
        raise InvalidMesh(f"{removed} of {total} faces of the mesh have zero area, the first one "
                          f"{near(vertices[before[where]].mean(axis=0))}; repair the mesh first")
    for _ in range(10):
        if not flat.any():
            break
        faces = _flipped(vertices, faces, int(np.argmax(flat)))
        flat = _flat(vertices, faces)
    faces = faces[~flat]
    if removed:
        notes.append(f"{counted(removed, 'face')} of zero area {'was' if removed == 1 else 'were'} removed")
    return faces


def _flat(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Faces (F,) thinner than 1e-7 of their longest edge."""
    p, q, r = vertices[faces].transpose(1, 0, 2)
    longest = np.maximum.reduce([norm(q - p), norm(r - q), norm(p - r)])
    return norm(np.cross(q - p, r - p)) <= 1e-7 * longest**2


def _flipped(vertices: np.ndarray, faces: np.ndarray, flat: int) -> np.ndarray:
    """Replace a needle and its neighbour across the long edge by two proper faces; without neighbour it goes."""
    corners = vertices[faces[flat]]
    longest = int(np.argmax(norm(np.roll(corners, -1, axis=0) - corners)))
    start, end, middle = np.roll(faces[flat], -longest)
    there = ((faces == start).any(axis=1) & (faces == end).any(axis=1))
    there[flat] = False
    if there.sum() != 1:
        return np.delete(faces, flat, axis=0)
    other = int(np.argmax(there))
    (apex,) = set(faces[other].tolist()) - {int(start), int(end)}
    out = faces.copy()
    out[flat], out[other] = [start, apex, middle], [apex, end, middle]
    return out


def _without_repeated_faces(faces: np.ndarray, notes: list[str]) -> np.ndarray:
    first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)[1]
    if len(first) < len(faces):
        notes.append(f"{counted(len(faces) - len(first), 'repeated face was', 'repeated faces were')} removed")
    return faces[np.sort(first)]


def _largest_piece(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> np.ndarray:
    """Faces that hang together over edges; other pieces are dropped when they are small."""
    edge = np.unique(np.sort(half_edges(faces), axis=1), axis=0, return_inverse=True)[1].ravel()
    owner = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(edge, kind="stable")
    same = edge[order][1:] == edge[order][:-1]
    label = components(len(faces), owner[order][1:][same], owner[order][:-1][same])
    area = np.bincount(label, ReferenceMesh(vertices, faces).areas)
    if len(area) == 1:
        return faces
    by_size = np.argsort(-area)
    second = by_size[1]
    share, place = area[second] / area.sum(), near(vertices[faces[int(np.argmax(label == second))]].mean(axis=0))
    if share >= SMALL:
        raise InvalidMesh(f"the mesh falls into {len(area)} pieces, the second one {place} with "
                          f"{100 * share:.0f} % of the area; give one connected surface")
    others = len(area) - 1
    notes.append(f"{counted(others, 'separate piece')} of {100 * (1 - area.max() / area.sum()):.2g} % of the area "
                 f"{'was' if others == 1 else 'were'} dropped, the largest {place}")
    return faces[label == by_size[0]]
