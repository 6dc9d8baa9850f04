"""From a soup of triangles to one oriented surface, or a sentence that says why not and where."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from plisse.errors import InvalidMesh
from plisse.geometry.mesh import ReferenceMesh
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
        raise InvalidMesh(f"the mesh has only {_count(len(faces), 'face')}; "
                          f"a surface to be pleated needs at least {MIN_FACES}")
    faces = _oriented(vertices, faces, notes)
    vertices, faces = _fans_apart(vertices, faces, notes)
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
        raise InvalidMesh(f"face {int(np.argmax(((faces < 0) | (faces >= len(vertices))).any(axis=1)))} refers to a "
                          f"vertex that does not exist; the mesh has {_count(len(vertices), 'vertex', 'vertices')}")
    bad = ~np.isfinite(vertices).all(axis=1)
    bad[np.setdiff1d(np.arange(len(vertices)), faces)] = False
    if bad.any():
        raise InvalidMesh(f"vertex {int(np.argmax(bad))} of the mesh has a coordinate that is not a finite number")
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
        label = _components(len(points), close[:, 0], close[:, 1])
        first = np.unique(label, return_index=True)[1]
        points, group = points[first], label[group.ravel()]
    if len(points) < len(used):
        notes.append(f"{_count(len(used) - len(points), 'duplicate vertex was', 'duplicate vertices were')} merged")
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
                          f"{_at(vertices[before[where]].mean(axis=0))}; repair the mesh first")
    for _ in range(10):
        if not flat.any():
            break
        faces = _flipped(vertices, faces, int(np.argmax(flat)))
        flat = _flat(vertices, faces)
    faces = faces[~flat]
    if removed:
        notes.append(f"{_count(removed, 'face')} of zero area {'was' if removed == 1 else 'were'} removed")
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
        notes.append(f"{_count(len(faces) - len(first), 'repeated face was', 'repeated faces were')} removed")
    return faces[np.sort(first)]


def _largest_piece(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> np.ndarray:
    """Faces that hang together over edges; other pieces are dropped when they are small."""
    edge = np.unique(np.sort(_half_edges(faces), axis=1), axis=0, return_inverse=True)[1].ravel()
    owner = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(edge, kind="stable")
    same = edge[order][1:] == edge[order][:-1]
    label = _components(len(faces), owner[order][1:][same], owner[order][:-1][same])
    area = np.bincount(label, ReferenceMesh(vertices, faces).areas)
    if len(area) == 1:
        return faces
    by_size = np.argsort(-area)
    second = by_size[1]
    share, place = area[second] / area.sum(), _at(vertices[faces[int(np.argmax(label == second))]].mean(axis=0))
    if share >= SMALL:
        raise InvalidMesh(f"the mesh falls into {len(area)} pieces, the second one {place} with "
                          f"{100 * share:.0f} % of the area; give one connected surface")
    others = len(area) - 1
    notes.append(f"{_count(others, 'separate piece')} of {100 * (1 - area.max() / area.sum()):.2g} % of the area "
                 f"{'was' if others == 1 else 'were'} dropped, the largest {place}")
    return faces[label == by_size[0]]


def _oriented(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> np.ndarray:
    """Faces turned so that neighbours run through their common edge in opposite directions.

    Every face is two nodes, as given and turned; a surface can be oriented when they fall into two components.
    """
    half = _half_edges(faces)
    edges, edge, uses = np.unique(np.sort(half, axis=1), axis=0, return_inverse=True, return_counts=True)
    if uses.max() > 2:
        worst = int(np.argmax(uses > 2))
        p, q = vertices[edges[worst]]
        raise InvalidMesh(f"{uses[worst]} faces meet in the edge from {_point(p)} to {_point(q)} "
                          f"({_count(int((uses > 2).sum()), 'such edge')}); a surface has at most 2 there")
    order = np.argsort(edge.ravel(), kind="stable")
    pair = np.flatnonzero(np.diff(edge.ravel()[order]) == 0)
    one, two = order[pair], order[pair + 1]
    same = half[one, 0] == half[two, 0]
    count = len(faces)
    f, g = one // 3, two // 3
    label = _components(2 * count, np.concatenate([f, f + count]),
                        np.concatenate([g + count * same, g + count * ~same]))
    if label[0] == label[count]:
        clash = int(np.argmax(same)) if same.any() else 0
        raise InvalidMesh(f"the surface is one-sided like a Möbius strip (for instance "
                          f"{_at(vertices[half[one[clash]]].mean(axis=0))}); cut it so that it has two sides")
    turned = label[:count] != label[0]
    if turned.sum() > count / 2:
        turned = ~turned
    if turned.any():
        notes.append(f"{_count(int(turned.sum()), 'face was', 'faces were')} turned over to agree with the others")
    return np.where(turned[:, None], faces[:, ::-1], faces)


def _fans_apart(vertices: np.ndarray, faces: np.ndarray, notes: list[str]) -> tuple[np.ndarray, np.ndarray]:
    """Where fans of faces touch in a single vertex only, each fan gets its own copy of it."""
    twins = ReferenceMesh(vertices, faces).twins
    inner = np.flatnonzero(twins >= 0)
    following = 3 * (twins // 3) + (twins + 1) % 3
    label = _components(faces.size, inner, following[inner])
    copies, first = np.unique(label, return_index=True)
    used = len(np.unique(faces))
    if len(copies) > used:
        notes.append(f"{_count(len(copies) - used, 'vertex', 'vertices')} in which parts of the surface only touch "
                     f"{'was' if len(copies) == used + 1 else 'were'} split")
    return vertices[faces.ravel()[first]], label.reshape(-1, 3)


def _half_edges(faces: np.ndarray) -> np.ndarray:
    return np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)


def _components(count: int, one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Component label (count,) of every node of the graph with the edges one–two."""
    graph = coo_array((np.ones(len(one), bool), (one, two)), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _count(number: int, one: str, many: str | None = None) -> str:
    return f"{number} {one if number == 1 else many or one + 's'}"


def _point(place: np.ndarray) -> str:
    return f"({place[0]:.5g}, {place[1]:.5g}, {place[2]:.5g})"


def _at(place: np.ndarray) -> str:
    return f"near {_point(place)}"
