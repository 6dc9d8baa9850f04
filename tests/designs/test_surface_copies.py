"""The same surface given differently: moved, in other units, triangulated otherwise, with noise; and counted by others."""

import numpy as np
import pytest
import trimesh
from scipy.spatial import Delaunay, cKDTree
from scipy.spatial.transform import Rotation

import plisse
from plisse.geometry.polyline import distance_to_polyline

TURN = Rotation.from_euler("xyz", [40, 25, 70], degrees=True)
SCALE, SHIFT = 1e-3, np.array([3.0, -2.0, 1.0])
CREASES, SAMPLES, AMPLITUDE = 12, 30, 8.0


def height(x, y):
    return 12 * np.sin(x / 45) * np.cos(y / 60)


def triangulated(seed=None, noise=0.0):
    """The surface over a rectangle, its inner vertices moved about by a third of an edge, and off it by a share of one."""
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(np.linspace(-100, 100, 48), np.linspace(-70, 70, 34), indexing="ij")
    places, edge = np.stack([x.ravel(), y.ravel()], axis=1), 200 / 47
    if seed is not None:
        inner = (np.abs(places[:, 0]) < 99) & (np.abs(places[:, 1]) < 69)
        places[inner] += rng.uniform(-0.33, 0.33, (inner.sum(), 2)) * edge
    faces = Delaunay(places).simplices
    a, b, c = places[faces].transpose(1, 2, 0)
    faces = faces[(b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0] > 1e-3]
    vertices = np.column_stack([places, height(*places.T)])
    return vertices + noise * edge * rng.normal(size=vertices.shape), faces


def moved(points):
    return TURN.apply(points) * SCALE + SHIFT


def brought_back(points):
    return TURN.inv().apply((points - SHIFT) / SCALE)


def guided(folder, vertices, faces, motion=None, scale=1.0):
    trimesh.Trimesh(vertices, faces, process=False).export(folder / "roof.obj", digits=15)
    guide = np.array([[-95, 0, height(-95, 0)], [95, 0, height(95, 0)]])
    guide = guide if motion is None else motion(guide)
    result = plisse.design({"surface": {"file": str(folder / "roof.obj"), "guide": guide.tolist()},
                            "pattern": {"theta": 50, "width": 12 * scale, "amplitude": AMPLITUDE * scale,
                                        "creases": CREASES, "samples": SAMPLES}})
    assert result.status == "exact", result.report.reasons
    return result


def apart(result, other):
    """Largest distance of creases from the other's, in amplitudes."""
    return max(distance_to_polyline(one, two).max() for one, two in
               zip(result.reshape(CREASES, SAMPLES, 3), other.reshape(CREASES, SAMPLES, 3), strict=True)) / AMPLITUDE


@pytest.fixture(scope="module")
def base(tmp_path_factory):
    return guided(tmp_path_factory.mktemp("base"), *triangulated())


def test_moved_copies_in_other_units_give_the_same_structure(base, tmp_path):
    vertices, faces = triangulated()
    copy = guided(tmp_path, moved(vertices), faces, moved, SCALE)
    assert apart(brought_back(copy.structure.vertices), base.structure.vertices) < 0.1
    assert copy.report.coverage == pytest.approx(base.report.coverage, abs=0.02)


def test_another_triangulation_gives_the_same_structure(base, tmp_path):
    assert apart(guided(tmp_path, *triangulated(seed=1)).structure.vertices, base.structure.vertices) < 0.1


def test_noise_of_a_hundredth_of_an_edge_is_survived(base, tmp_path):
    noisy = guided(tmp_path, *triangulated(seed=2, noise=0.01))
    # pseudo-geodesics turn with the curvature, which noise changes most: the structure may drift along the surface
    assert apart(noisy.structure.vertices, base.structure.vertices) < 2
    assert noisy.report.deviation.mean_amplitudes < 0.5


def test_coverage_is_what_normals_of_the_mesh_count(base):
    """Every quad, seen along the normal of every sample: no code of plisse."""
    vertices, faces = triangulated()
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    points, index = trimesh.sample.sample_surface(mesh, 3000, seed=1)
    normals = mesh.face_normals[index]
    x = np.cross(normals, [0, 1, 0])
    frame = np.stack([x, np.cross(normals, x)], axis=1)
    hit = np.zeros(len(points), bool)
    for quad in base.structure.vertices[base.structure.topology.quads]:
        flat = np.einsum("nki,nqi->nqk", frame, quad - points[:, None])
        after = np.roll(flat, -1, axis=1)
        turn = flat[..., 0] * after[..., 1] - flat[..., 1] * after[..., 0]
        hit |= (turn > 0).all(axis=1) | (turn < 0).all(axis=1)
    assert base.report.coverage == pytest.approx(hit.mean(), abs=0.02)


def test_deviation_is_the_distance_to_densely_sampled_triangles(base):
    vertices, faces = triangulated()
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    dense = trimesh.sample.sample_surface(mesh, 200_000, seed=1)[0]
    structure = base.structure
    middles = structure.vertices[structure.topology.quads].mean(axis=1)
    inside = np.all(np.abs(middles[:, :2]) < [95, 65], axis=1)
    # points beyond the boundary are measured to the continued surface: only the others can be compared
    near = cKDTree(dense).query(middles[inside])[0]
    assert base.report.deviation.mean == pytest.approx(near.mean(), rel=0.15)
    assert base.report.deviation.max >= 0.9 * near.max()
