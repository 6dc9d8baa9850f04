"""Traced curves: circles on spheres, pseudo-geodesics of cylinders, great circles; named ends; both tracers agree."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.formulas import Cone, Cylinder, HeightField, Sphere, Torus
from plisse.geometry.graph import GraphSurface
from plisse.geometry.jets import JetSurface
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.polyline import distance_to_polyline
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.geodesic import geodesic, mesh_path
from plisse.layout.stops import Stop
from plisse.layout.trace import trace
from plisse.layout.trace_literal import LiteralTracer, trace_literal

HILLS = HeightField("0.2*sin(2*x)*cos(y) + 0.1*x**2*y", (-1.5, 1.5), (-1, 1))
START, AHEAD = np.array([[0.3, 0.5, 0.7]]), np.array([[1.0, -0.2, 0.1]])


def circle(radius, theta, side, start, ahead):
    """Distance function to the pseudo-geodesic circle of a sphere: its plane is inclined by θ about the tangent."""
    normal = unit(start[0][None])[0]
    tangent = unit((ahead[0] - (ahead[0] @ normal) * normal)[None])[0]
    axis = unit(np.cross(tangent, np.sin(theta) * normal + side * np.cos(theta) * np.cross(normal, tangent))[None])[0]
    at = radius * normal @ axis
    return lambda points: np.abs(points @ axis - at) + np.abs(norm(points) - radius)


@pytest.mark.parametrize("degrees", [20, 45, 60, 90])
@pytest.mark.parametrize("side", [1, -1])
def test_sphere_curves_are_circles_of_radius_r_sin_theta(degrees, side):
    theta = np.radians(degrees)
    curve = trace(Sphere(2.0), START, AHEAD, theta, side)[0]
    assert curve.stop is Stop.CLOSED
    assert circle(2.0, theta, side, START, AHEAD)(curve.points).max() < 1e-6
    assert curve.length == pytest.approx(4 * np.pi * np.sin(theta), rel=2e-3)


def test_the_smooth_tracer_is_of_fourth_order():
    exact = circle(1.0, 0.7, 1, START, AHEAD)
    steps = np.array([0.2, 0.1, 0.05, 0.025])
    curves = [trace(Sphere(1.0), START, AHEAD, 0.7, step=step, length=2.4, both=False)[0] for step in steps]
    misses = [exact(curve.points).max() for curve in curves]
    assert np.polyfit(np.log(steps), np.log(misses), 1)[0] > 3.7


@pytest.mark.parametrize("side", [1, -1])
def test_cylinder_curves_solve_the_equation_of_their_angle(side):
    """On an unrolled cylinder the direction turns by κ_g = −σ cot θ cos² α / R, α its angle with the circles."""
    theta, radius, slope = np.radians(60), 1.5, 0.9
    ahead = [[0, np.cos(slope), np.sin(slope)]]
    curve = trace(Cylinder(radius, 100.0), [[radius, 0, 0]], ahead, theta, side, length=4.0, both=False, step=0.02)[0]

    def derivative(_, state):
        return [np.cos(state[2]), np.sin(state[2]), -side / np.tan(theta) * np.cos(state[2]) ** 2 / radius]

    at = np.linspace(0, 4, len(curve.points))
    solution = solve_ivp(derivative, (0, 4), [0, 0, slope], t_eval=at, rtol=1e-11, atol=1e-12)
    unrolled = radius * np.unwrap(np.arctan2(curve.points[:, 1], curve.points[:, 0]))
    np.testing.assert_allclose(unrolled, solution.y[0], atol=1e-7)
    np.testing.assert_allclose(curve.points[:, 2], solution.y[1], atol=1e-7)


def test_cylinder_geodesics_are_helices_and_rulings_stay_straight():
    helix = trace(Cylinder(2.0, 40.0), [[2, 0, 0]], [[0, 3, 4]], np.pi / 2, length=10, step=0.04)[0].points
    angle = np.unwrap(np.arctan2(helix[:, 1], helix[:, 0]))
    np.testing.assert_allclose(helix[:, 2], 2 * angle * 4 / 3 - 2 * angle[0] * 4 / 3 + helix[0, 2], atol=1e-8)
    ruling = trace(Cylinder(2.0, 40.0), [[2, 0, 0]], [[0, 0, 1]], np.radians(30))[0]
    np.testing.assert_allclose(ruling.points[:, :2], np.broadcast_to([2.0, 0], (len(ruling.points), 2)), atol=1e-12)
    assert np.abs(ruling.points[[0, -1], 2]) == pytest.approx([20, 20], abs=1e-4)


def test_osculating_planes_enclose_theta_on_any_surface_through_sign_changes_of_the_curvature():
    theta = np.radians(50)
    starts = np.stack([np.linspace(-1, 1, 9), 0 * np.ones(9), 0 * np.ones(9)], axis=1)
    changes = 0
    for curve in trace(HILLS, starts, [0.8, 0.6, 0], theta, -1, step=0.01):
        p = curve.points[1:-1]  # without the shorter pieces at the boundary
        at = HILLS.project(p[1:-1])
        plane = unit(np.cross(p[1:-1] - p[:-2], p[2:] - p[1:-1]))
        bent = np.einsum("ni,nij,nj->n", unit(p[2:] - p[:-2]), at.bending, unit(p[2:] - p[:-2]))
        sure = np.abs(bent) > 0.05
        np.testing.assert_allclose(np.abs(dot(plane, at.normals))[sure], np.cos(theta), atol=2e-3)
        tangent = unit(p[2:] - p[:-2])
        contained = np.sin(theta) * at.normals - np.cos(theta) * np.cross(at.normals, tangent)
        assert np.abs(dot(plane, contained))[sure].max() < 5e-3
        changes += (np.diff(np.sign(bent)) != 0).sum()
    assert changes > 3


def test_a_curve_traced_backwards_is_the_same_curve():
    curve = trace(HILLS, [[0.2, 0.1, 0]], [[1, 0.4, 0]], np.radians(60), 1, length=1.0, step=0.01)[0]
    end, ahead = curve.points[:1], curve.points[1:2] - curve.points[:1]
    tangent = ahead - 0.5 * (curve.points[2:3] - 2 * curve.points[1:2] + curve.points[:1])
    again = trace(HILLS, end, tangent, np.radians(60), 1, length=2.0, step=0.01, both=False)[0]
    assert distance_to_polyline(again.points, curve.points).max() < 1e-3
    assert (curve.stop, curve.first_stop) == (Stop.LENGTH, Stop.LENGTH)
    np.testing.assert_allclose(curve.points[curve.start], HILLS.project(np.array([[0.2, 0.1, 0]])).positions[0])


def test_many_curves_are_the_curves_one_by_one():
    starts = np.stack([np.linspace(-1, 1, 7), 0.1 * np.ones(7), 0 * np.ones(7)], axis=1)
    theta = np.radians(np.linspace(40, 90, 7))
    together = trace(HILLS, starts, [0, 1, 0], theta)
    for start, angle, curve in zip(starts, theta, together, strict=True):
        alone = trace(HILLS, start, [0, 1, 0], angle)[0]
        np.testing.assert_allclose(alone.points, curve.points, atol=1e-12)
        assert (alone.stop, alone.first_stop) == (curve.stop, curve.first_stop)


def test_boundary_points_lie_on_the_boundary():
    for curve in trace(HILLS, [[0, 0, 0], [0.5, 0, 0]], [0.1, 1, 0], np.radians(70)):
        assert (curve.stop, curve.first_stop) == (Stop.BOUNDARY, Stop.BOUNDARY)
        assert np.abs(curve.points[[0, -1], 1]) == pytest.approx([1, 1], abs=1e-4)
    beyond = trace(GraphSurface(HILLS.mesh(30)), [[0, 0, 0]], [0.1, 1, 0], np.radians(70), beyond=True, length=1.3)[0]
    assert beyond.stop is Stop.LENGTH
    assert beyond.points[-1, 1] > 1.1


def compact(vertices, faces):
    used, index = np.unique(faces, return_inverse=True)
    return vertices[used], index.reshape(-1, 3)


def stops(surface, start, ahead, degrees, **options):
    return trace(surface, [start], [ahead], np.radians(degrees), both=False, **options)[0].stop


def test_every_curve_ends_with_a_named_stop():
    assert stops(HILLS, [0, 0, 0], [0, 1, 0], 60) is Stop.BOUNDARY
    assert stops(HILLS, [0, 0, 0], [0, 1, 0], 60, length=0.3) is Stop.LENGTH
    assert stops(Sphere(1), [1, 0, 0], [0, 1, 0], 60) is Stop.CLOSED
    assert stops(Sphere(1), [1, 0, 0], [0, 1, 0], 1.2) is Stop.CURLED_UP
    assert stops(Torus(3, 1), [4, 0, 0], [0, 0.3, 1], 35, length=200) is Stop.CURLED_UP
    assert stops(Cone(0.5, 0, 3), [np.sin(0.5), 0, np.cos(0.5)], [-np.sin(0.5), 0, -np.cos(0.5)], 90) is Stop.LEFT_CHART
    assert stops(JetSurface(HILLS.mesh(20)), [0, 0, 0], [0, 1, 0], 60, beyond=True) is Stop.LEFT_CHART
    assert [str(stop) for stop in Stop] == [stop.value for stop in Stop]
    assert "boundary" in str(Stop.BOUNDARY)


def test_what_cannot_be_traced_is_refused_in_one_sentence():
    for options in ({"theta": 0.0}, {"theta": 2.0}, {"theta": np.nan}, {"directions": [[0, 0, 1]]}, {"length": -1},
                    {"length": np.inf}, {"step": 0}, {"starts": [[np.nan, 0, 0]]}):
        settings = {"starts": [[0, 0, 1.0]], "directions": [[1.0, 0, 0]], "theta": 1.0} | options
        with pytest.raises(InvalidDesign):
            trace(Sphere(1), **settings)
    for options in ({"theta": 0.0}, {"directions": [[0, 0, 1]]}):
        settings = {"starts": [[0.1, 0.05, 0]], "directions": [[1.0, 0, 0]], "theta": 1.0} | options
        with pytest.raises(InvalidDesign):
            trace_literal(HeightField("0*x").mesh(10), **settings)


@pytest.mark.parametrize(("kind", "order"), [(JetSurface, 1.8), (GraphSurface, 1.8)])
def test_curves_on_fitted_surfaces_converge_to_those_of_the_formula(kind, order):
    start, ahead, theta = HILLS.project(np.array([[-0.8, -0.3, 0]])).positions, [[1, 0.4, 0.0]], np.radians(60)
    exact = trace(HILLS, start, ahead, theta, length=1.8, step=0.01, both=False)[0].points
    cells = np.array([16, 32, 64])
    misses = []
    for count in cells:
        found = trace(kind(HILLS.mesh(count)), start, ahead, theta, length=1.8, step=0.06, both=False)[0].points
        misses.append(distance_to_polyline(found, exact).max())
    assert -np.polyfit(np.log(cells), np.log(misses), 1)[0] > order
    assert misses[-1] < 2e-3


@pytest.mark.parametrize("degrees", [30, 60, 90])
@pytest.mark.parametrize("side", [1, -1])
def test_the_literal_tracer_converges_with_the_mesh(degrees, side):
    theta = np.radians(degrees)
    exact = circle(1.0, theta, side, START, AHEAD)
    cells = np.array([16, 32, 64])
    rng = np.random.default_rng(0)
    misses = []
    for count in cells:  # the mean over some turned meshes, for one curve's errors vary
        mesh = Sphere(1.0).mesh(int(count))
        miss = []
        for turn in Rotation.random(6, random_state=rng).as_matrix():
            turned = ReferenceMesh(mesh.vertices @ turn.T, mesh.triangles)
            start = unit(START)
            found = trace_literal(turned, start, AHEAD, theta, side, length=2 * np.pi * np.sin(theta), both=False)[0]
            miss.append(exact(found.points).max())
        misses.append(np.mean(miss))
    assert -np.polyfit(np.log(cells), np.log(misses), 1)[0] > 0.9
    assert misses[-1] < 0.03


def test_literal_curves_run_from_edge_to_edge_with_planes_at_the_angle():
    """Recomputed from Fig. 13: the plane of three successive points has a normal at θ to n_f + n_f'."""
    mesh, theta = HILLS.mesh(20), np.radians(55)
    curve = trace_literal(mesh, [[0.1, 0.05, 0]], [[1, 0.3, 0]], theta, 1, both=False)[0]
    assert curve.stop is Stop.BOUNDARY
    p = curve.points
    ends = mesh.vertices[mesh.edges]
    for before, here, after in zip(p[:-2], p[1:-1], p[2:], strict=True):
        along = ends[:, 1] - ends[:, 0]
        off = norm(np.cross(here - ends[:, 0], along)) / norm(along)
        edge = mesh.edges[np.argmin(off + (dot(here - ends[:, 0], here - ends[:, 1]) > 0))]
        assert off.min() < 1e-12
        faces = np.isin(mesh.triangles, edge).sum(axis=1) == 2
        normal = unit(mesh.normals[faces].sum(axis=0)[None])[0]
        plane = unit(np.cross(here - before, after - here)[None])[0]
        plane = plane if plane @ normal > 0 else -plane
        if norm(np.cross(here - before, after - here)) > 1e-6:
            assert plane @ normal == pytest.approx(np.cos(theta), abs=1e-6)
            assert np.linalg.det([normal, here - before, plane]) < 0


def test_literal_geodesics_of_a_cylinder_unroll_to_straight_lines():
    """On a prism a literal geodesic is the straight line of its unrolling up to the rounding of n_e."""
    mesh = Cylinder(1.0, 6.0).mesh(200)
    curve = trace_literal(mesh, [[1.0, 0, -2.5]], [[0, 1, 0.7]], np.pi / 2, both=False)[0]
    angle = np.unwrap(np.arctan2(curve.points[:, 1], curve.points[:, 0]))
    np.testing.assert_allclose(curve.points[:, 2], -2.5 + 0.7 * (angle - angle[0]), atol=2e-3)
    assert curve.stop is Stop.BOUNDARY
    assert curve.points[-1, 2] == pytest.approx(3)


def test_both_tracers_give_the_same_curves_with_the_same_sides():
    mesh = HILLS.mesh(120)
    starts = HILLS.project(np.stack([np.linspace(-1, 1, 6), 0.03 * np.ones(6), 0 * np.ones(6)], axis=1)).positions
    for side in (1, -1):
        smooth = trace(HILLS, starts, [0.2, 1, 0], np.radians(60), side)
        literal = trace_literal(mesh, starts, [0.2, 1, 0], np.radians(60), side)
        for one, two in zip(smooth, literal, strict=True):
            assert cKDTree(one.points).query(two.points)[0].max() < 0.03
            assert (one.stop, one.first_stop) == (two.stop, two.first_stop)


def test_literal_curves_through_vertices_and_around_them_do_not_break():
    mesh = HeightField("0.1*x*y").mesh(10)
    curves = trace_literal(mesh, mesh.vertices[[60, 61, 62]], [[1, 0, 0], [0, 1, 0], [1, 1, 0]], np.pi / 2)
    assert all(np.isfinite(curve.points).all() for curve in curves)
    assert {stop for curve in curves for stop in (curve.stop, curve.first_stop)} == {Stop.BOUNDARY}
    assert np.abs(curves[2].points[[0, -1]]).max() == pytest.approx(1, abs=1e-6)
    on_edges = mesh.vertices[mesh.edges].mean(axis=1)
    along = np.diff(mesh.vertices[mesh.edges], axis=1)[:, 0]
    curves = trace_literal(mesh, on_edges, along + 1e-3 * np.eye(3)[0], np.radians(70))
    assert all(np.isfinite(curve.points).all() for curve in curves)
    assert {stop for curve in curves for stop in (curve.stop, curve.first_stop)} == {Stop.BOUNDARY}
    tight = trace_literal(Sphere(1).mesh(16), unit(START), AHEAD, np.radians(3), both=False)[0]
    assert tight.stop in (Stop.CURLED_UP, Stop.CLOSED, Stop.LENGTH)
    assert np.isfinite(tight.points).all()


def test_the_literal_tracer_is_fast_enough_for_many_curves():
    """A fifth of the benchmark's demand, for busy machines: benchmarks/tracing.py asks for a million per second."""
    import time

    mesh = Sphere(1.0).mesh(64)
    tracer, rng = LiteralTracer(mesh), np.random.default_rng(0)
    faces = rng.integers(0, len(mesh.triangles), 1500)
    arguments = (mesh.corners[faces].mean(axis=1), faces, rng.normal(size=(1500, 3)), np.full(1500, 1.0), np.ones(1500),
                 np.inf, 60)
    rates = []
    for _ in range(3):
        begin = time.perf_counter()
        rows, _, _ = tracer.march(*arguments)
        rates.append(sum(row.shape[1] for row in rows) / (time.perf_counter() - begin))
    assert max(rates) > 2e5


def test_geodesics_of_a_sphere_are_great_circles():
    a, b = np.array([2.0, 0, 0]), np.array([-0.5, 1.5, 1.0])
    points = geodesic(Sphere(2.0), a, b, 30)
    normal = unit(np.cross(a, b)[None])[0]
    assert np.abs(points @ normal).max() < 1e-9
    steps = norm(np.diff(points, axis=0))
    assert np.ptp(steps) < 1e-9
    np.testing.assert_allclose(points[[0, -1]], [a, 2 * b / norm(b)], atol=1e-9)


def test_geodesics_between_points_converge_and_agree_with_shooting():
    ends = [-1.4, -0.8, 0], [1.3, 0.9, 0]
    fine = geodesic(HILLS, *ends, 40, nodes=900)
    nodes = np.array([60, 120, 240])
    misses = [norm(geodesic(HILLS, *ends, 40, nodes=int(n)) - fine).max() for n in nodes]
    assert -np.polyfit(np.log(nodes), np.log(misses), 1)[0] > 3.3
    dense = geodesic(HILLS, *ends, 2000, nodes=2000)
    ahead = 2 * dense[1] - 0.5 * dense[2] - 1.5 * dense[0]
    shot = trace(HILLS, [dense[0]], [ahead], np.pi / 2, both=False, step=0.01)[0]
    assert distance_to_polyline(dense, shot.points).max() < 1e-4


def test_geodesics_on_fitted_surfaces_start_from_the_mesh():
    mesh = Cylinder(1.0, 4.0).mesh(60)
    a, b = np.array([1.0, 0, -1.5]), np.array([np.cos(2.5), np.sin(2.5), 1.5])
    path = mesh_path(mesh, a, b)
    np.testing.assert_array_equal(path[[0, -1]], [a, b])
    points = geodesic(JetSurface(mesh), a, b, 25)
    angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    np.testing.assert_allclose(points[:, 2], -1.5 + 3 * angle / 2.5, atol=2e-3)


def test_geodesics_that_make_no_sense_are_refused():
    with pytest.raises(InvalidDesign, match="same point"):
        geodesic(Sphere(1), [1, 0, 0], [2, 0, 0], 10)
    with pytest.raises(InvalidDesign, match="two points"):
        geodesic(Sphere(1), [1, 0, np.nan], [2, 0, 0], 10)
    mesh = HILLS.mesh(40)
    x, y, _ = mesh.corners.mean(axis=1).T
    horseshoe = mesh.triangles[(np.abs(x) > 1) | (y < -0.6)]
    with pytest.raises(Infeasible, match="leaves the surface"):
        geodesic(JetSurface(ReferenceMesh(*compact(mesh.vertices, horseshoe))), [-1.3, 0.8, 0], [1.3, 0.8, 0], 10)
    with pytest.raises((Infeasible, InvalidDesign)):
        geodesic(Cone(0.5, 0.1, 3), [0, 0, -1], [1, 0, 2], 10)
