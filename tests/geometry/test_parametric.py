"""Surfaces flattened: angles kept, nothing folded over, the geometry of the formula, a smooth continuation."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from shapely import Polygon

from plisse.errors import Infeasible
from plisse.geometry.closest import closest_on_mesh
from plisse.geometry.conformal import flattened_sheet, flattened_tube, stretches
from plisse.geometry.formulas import Cone, Cylinder, Sphere, Torus
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.geometry.parametric import ParametricSurface

R, r = 3.0, 1.0


def net(point, across, along, cells, closed=False):
    """Mesh of point(u, v) over a net of cells, its inner vertices shaken."""
    rng = np.random.default_rng(4)
    counts = cells + (not closed), max(4, round(cells * (along[1] - along[0]) / (across[1] - across[0]))) + 1
    u = np.linspace(*across, counts[0], endpoint=not closed)[:, None] + np.zeros(counts)
    v = np.linspace(*along, counts[1]) + np.zeros(counts)
    shake = 0.25 * (across[1] - across[0]) / cells * rng.uniform(-1, 1, (2, *counts))
    shake[1][:, [0, -1]] = 0
    if not closed:
        shake[0][[0, -1]] = 0
    return grid_mesh(np.stack(point(u + shake[0], v + shake[1]), axis=-1), (closed, False))


def vault(cells=40):
    """240° of a cylinder of radius 1 about the z axis."""
    return net(lambda u, v: (np.cos(u), np.sin(u), v), (0, np.radians(240)), (-2, 2), cells)


def cap(cells=40):
    """110° of a sphere, far more than a graph."""
    return Sphere(1.0, cap=np.radians(110)).mesh(cells)


def elbow(cells=40):
    """A quarter of a torus, open at both ends."""
    return net(lambda u, v: ((R + r * np.cos(u)) * np.cos(v / R), (R + r * np.cos(u)) * np.sin(v / R), r * np.sin(u)),
               (0, 2 * np.pi), (0, R * np.pi / 2), cells, closed=True)


KINDS = {"vault": (vault, Cylinder(1.0, 4.0)), "cap": (cap, Sphere(1.0)), "elbow": (elbow, Torus(R, r))}


@pytest.mark.parametrize("mesh", [vault(), cap()], ids=["vault", "cap"])
def test_sheets_are_laid_flat_without_a_fold_or_overlap_and_keep_their_area(mesh):
    places = flattened_sheet(mesh)
    assert (stretches(mesh, places) > 0).all()
    outline = Polygon(places[mesh.boundary_loops[0]])
    assert outline.is_valid
    assert outline.area == pytest.approx(mesh.area, rel=1e-9)


def test_a_cylinder_is_unrolled_without_stretching():
    # an inscribed polyhedron differs from the cylinder by squares of its edges
    assert np.abs(stretches(vault(), flattened_sheet(vault())) - 1).max() < 0.01


def test_flattening_is_conformal_in_the_limit():
    def skew(cells):
        found = stretches(mesh := cap(cells), flattened_sheet(mesh))
        return np.quantile(found[:, 0] / found[:, 1], 0.95) - 1

    coarse, fine = skew(20), skew(40)
    assert fine < 0.6 * coarse  # constant on triangles: of first order
    assert fine < 0.08


def test_the_period_of_a_cone_is_its_conformal_modulus():
    mesh = Cone(np.radians(30), 1.0, 2.0).mesh(96)
    places, period = flattened_tube(mesh)
    # z ↦ log z: width ln 2, circumference 2π sin 30°
    assert places[:, 1].max() / period == pytest.approx(np.log(2) / np.pi, rel=5e-3)
    assert period * places[:, 1].max() == pytest.approx(mesh.area, rel=1e-9)
    slant = np.linalg.norm(mesh.vertices, axis=1)
    np.testing.assert_allclose(places[:, 1] / places[:, 1].max(), np.log2(2 / slant), atol=5e-3)  # from the longer rim


def test_tubes_are_rolled_out_once_around_and_facing_up():
    mesh = elbow()
    places, period = flattened_tube(mesh)
    corners = places[mesh.triangles]
    corners[..., 0] -= period * np.round((corners[..., 0] - corners[:, :1, 0]) / period)
    (x, y), (z, w) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    areas = 0.5 * (x * w - y * z)
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(mesh.area, rel=1e-9)
    for loop, level in zip(mesh.boundary_loops, (places[:, 1].min(), places[:, 1].max()), strict=True):
        np.testing.assert_allclose(places[loop, 1], level, atol=1e-9)


def errors(kind, cells):
    """Largest errors of positions, normals and bending at the vertices, bending away from the rim."""
    make, exact = KINDS[kind]
    surface = ParametricSurface(mesh := make(cells))
    found = surface.at(surface.places)
    truth = exact.project(found.positions)
    side = np.sign(np.sum(found.normals * truth.normals))
    rim = mesh.vertices[np.concatenate(mesh.boundary_loops)]
    inner = np.linalg.norm(mesh.vertices[:, None] - rim, axis=-1).min(axis=1) > 0.25
    return (np.abs(found.positions - truth.positions).max(), np.abs(found.normals - side * truth.normals)[inner].max(),
            np.abs(found.bending - side * truth.bending)[inner].max())


@pytest.mark.parametrize("kind", KINDS)
def test_normals_and_bending_converge_to_those_of_the_formula(kind):
    coarse, fine = errors(kind, 24), errors(kind, 48)
    assert fine[0] < 1e-3
    assert fine[1] < max(coarse[1] / 2**1.5, 1e-4)  # below that the map from triangle to triangle is what is seen
    assert fine[2] < max(coarse[2] / 2**1.0, 5e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_projections_are_closest_points_and_chart_coordinates_come_back(kind):
    mesh = KINDS[kind][0](48)
    surface = ParametricSurface(mesh)
    points = mesh.vertices + 0.1 * np.sin(7 * mesh.vertices[:, :1]) * mesh.vertex_normals
    found = surface.project(points)
    gap = points - found.positions
    assert np.abs(gap - np.sum(gap * found.normals, axis=1)[:, None] * found.normals)[found.known].max() < 1e-9
    distance = np.linalg.norm(points - closest_on_mesh(mesh, points)[0], axis=1)
    sagitta = mesh.edge_lengths.max() ** 2 / 4  # of triangles inscribed in curvature 1
    np.testing.assert_allclose(np.linalg.norm(gap, axis=1)[found.known], distance[found.known], atol=sagitta)
    np.testing.assert_allclose(surface.to_space(surface.to_plane(points)), points, atol=1e-9)


def test_the_continuation_is_smooth_and_ends_straight():
    surface = ParametricSurface(vault())
    low, high = surface.places.min(axis=0), surface.places.max(axis=0)
    line = np.stack([np.linspace(low[0] - 3, high[0] + 3, 2000), np.full(2000, 0.3)], axis=1)
    points = surface.at(line)
    assert np.abs(np.diff(points.bending, axis=0)).max() < 0.05
    outside = (line[:, 0] < surface.domain[0][0]) | (line[:, 0] > surface.domain[1][0])
    assert not points.known[outside].any()
    straight = np.diff(points.positions[line[:, 0] > surface.domain[1][0]], n=2, axis=0)
    assert np.abs(straight).max() < 1e-12


def test_a_tube_comes_back_after_its_period():
    surface = ParametricSurface(elbow())
    v = surface.places[::7, 1]
    before, after = (surface.at(np.stack([np.full_like(v, u), v], axis=1)) for u in (1e-12, surface.period - 1e-12))
    np.testing.assert_allclose(after.positions, before.positions, atol=1e-10)
    np.testing.assert_allclose(after.bending, before.bending, atol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_a_moved_and_scaled_copy_has_the_same_chart(kind):
    mesh, turn, scale, shift = KINDS[kind][0](), Rotation.from_euler("xyz", [20, 50, 110], degrees=True), 25.4, [5, -3, 90]
    one, other = ParametricSurface(mesh), ParametricSurface(ReferenceMesh(scale * turn.apply(mesh.vertices) + shift,
                                                                         mesh.triangles))
    np.testing.assert_allclose(other.places, scale * one.places, atol=1e-7 * scale)
    middle = one.at(one.places).positions
    np.testing.assert_allclose(other.at(other.places).positions, scale * turn.apply(middle) + shift,
                               atol=1e-7 * scale)


@pytest.mark.parametrize("mesh", [Sphere(1.0).mesh(), Torus(R, r).mesh(20)], ids=["sphere", "torus"])
def test_surfaces_without_boundary_are_told_to_be_cut_open(mesh):
    with pytest.raises(Infeasible, match="no boundary"):
        ParametricSurface(mesh)


def test_handles_are_told_apart_from_rims():
    torus = Torus(R, r).mesh(20)
    with pytest.raises(Infeasible, match="handles"):
        ParametricSurface(ReferenceMesh(torus.vertices, torus.triangles[1:]))


def test_a_ramp_that_winds_around_twice_cannot_be_laid_flat():
    ramp = net(lambda u, v: ((3 + v) * np.cos(u), (3 + v) * np.sin(u), 0.3 * u), (0, 4.5 * np.pi), (-1, 1), 120)
    with pytest.raises(Infeasible, match="laid flat"):
        ParametricSurface(ramp)


def test_a_sheet_with_a_hole_is_no_tube():
    whole = vault()
    hole = np.linalg.norm(whole.corners.mean(axis=1) - [np.cos(2), np.sin(2), 0], axis=1) < 0.4
    kept = whole.triangles[~hole]
    used, numbers = np.unique(kept, return_inverse=True)
    surface = ParametricSurface(ReferenceMesh(whole.vertices[used], numbers.reshape(-1, 3)))
    assert surface.period is None
    assert not surface.project(np.array([[np.cos(2), np.sin(2), 0]])).known.any()
