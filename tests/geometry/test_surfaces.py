"""Reference surfaces: formulas against differences, fits against formulas with their orders, and a safe parser."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.closest import closest_on_mesh, closest_on_surface
from plisse.geometry.expression import height_expression
from plisse.geometry.formulas import Cone, Cylinder, HeightField, Sphere, Torus
from plisse.geometry.graph import GraphSurface, facing_up
from plisse.geometry.jets import JetSurface
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.geometry.outline import Outline
from plisse.geometry.vectors import dot, norm, unit

HILLS = HeightField("0.2*sin(2*x)*cos(y) + 0.1*x**2*y - 0.05*exp(-x*x)", (-1.5, 1.5), (-1, 1))
FORMULAS = {"sphere": Sphere(2.0), "cap": Sphere(2.0, 1.0), "cylinder": Cylinder(1.5, 3.0), "cone": Cone(0.5, 1.0, 3.0),
            "torus": Torus(3.0, 1.0), "height field": HILLS}
FITTED = {"jets on a sphere": (JetSurface, "sphere"), "jets on a cylinder": (JetSurface, "cylinder"),
          "jets on a torus": (JetSurface, "torus"), "jets on hills": (JetSurface, "height field"),
          "graph on hills": (GraphSurface, "height field"), "graph on a cap": (GraphSurface, "cap")}


def scattered(surface, count=200, cells=24):
    """Points near the surface, away from its mesh's vertices."""
    mesh = surface.mesh(cells)
    rng = np.random.default_rng(0)
    face = rng.integers(0, len(mesh.triangles), count)
    return np.einsum("nk,nki->ni", rng.dirichlet([2, 2, 2], count), mesh.corners[face])


@pytest.mark.parametrize("name", FORMULAS)
def test_projection_is_idempotent_and_normals_are_unit(name):
    surface = FORMULAS[name]
    once = surface.project(scattered(surface))
    twice = surface.project(once.positions)
    np.testing.assert_allclose(twice.positions, once.positions, atol=1e-13)
    np.testing.assert_allclose(norm(once.normals), 1, atol=1e-14)
    assert once.known.all()


@pytest.mark.parametrize("name", FORMULAS)
def test_bending_is_minus_the_derivative_of_the_normal(name):
    surface = FORMULAS[name]
    at = surface.project(scattered(surface))
    np.testing.assert_allclose(np.einsum("nij,nj->ni", at.bending, at.normals), 0, atol=1e-13)
    np.testing.assert_allclose(at.bending, at.bending.swapaxes(1, 2), atol=1e-13)
    tangent = unit(np.cross(at.normals, [0.3, -0.5, 0.8]))
    step = 1e-5
    ahead, behind = (surface.project(at.positions + sign * step * tangent) for sign in (1, -1))
    slope = (ahead.normals - behind.normals) / norm(ahead.positions - behind.positions)[:, None]
    along = unit(ahead.positions - behind.positions)
    np.testing.assert_allclose(np.einsum("nij,nj->ni", at.bending, along), -slope, atol=1e-8)


def test_a_sphere_with_outward_normals_bends_by_minus_one_over_its_radius():
    at = Sphere(4.0).project(np.random.default_rng(1).normal(size=(20, 3)))
    values = np.linalg.eigvalsh(at.bending)
    np.testing.assert_allclose(values, np.broadcast_to([-0.25, -0.25, 0], (20, 3)), atol=1e-14)


def test_the_known_part_ends_at_rims_and_caps():
    assert Cylinder(1, 2).project(np.array([[1, 0, 0.99], [1, 0, 1.01]])).known.tolist() == [True, False]
    around = np.array([[np.sin(angle), 0, np.cos(angle)] for angle in (0.99, 1.01)])
    assert Sphere(1, 1).project(around).known.tolist() == [True, False]
    assert Cone(0.5, 1, 2).project(np.array([[0.2, 0, 0.5], [0.7, 0, 1.3]])).known.tolist() == [False, True]
    assert HILLS.project(np.array([[1.4, 0, 9], [1.6, 0, 9]])).known.tolist() == [True, False]


@pytest.mark.parametrize("name", FORMULAS)
def test_meshes_of_formulas_lie_on_them_and_turn_the_same_way(name):
    surface = FORMULAS[name]
    mesh = surface.mesh(24)
    at = surface.project(mesh.vertices)
    np.testing.assert_allclose(at.positions, mesh.vertices, atol=1e-12)
    assert (dot(at.normals, mesh.vertex_normals) > 0.9).all()
    assert surface.diagonal == pytest.approx(mesh.diagonal, rel=0.05)
    euler = len(mesh.vertices) - len(mesh.edges) + len(mesh.triangles)
    assert euler == {"sphere": 2, "cap": 1, "height field": 1}.get(name, 0)


def errors(kind, name, cells):
    """Largest distance and mean error of the bending of a fitted surface, away from the boundary."""
    exact = FORMULAS[name]
    mesh = exact.mesh(cells)
    surface = kind(mesh)
    points = scattered(exact, 400)
    points = points[Outline(mesh).beyond(points) < -0.1 * mesh.diagonal]
    found = surface.project(points)
    assert found.known.all()
    truth = exact.project(found.positions)
    assert (dot(found.normals, truth.normals) > 0.99).all()
    return norm(found.positions - truth.positions).max(), norm((found.bending - truth.bending).reshape(-1, 9)).mean()


@pytest.mark.parametrize("name", FITTED)
def test_fits_converge_in_fourth_order_and_their_bending_in_second(name):
    kind, surface = FITTED[name]
    sizes = np.array([16, 32, 64])
    distance, bending = np.array([errors(kind, surface, cells) for cells in sizes]).T
    order = -np.polyfit(np.log(sizes), np.log(np.stack([distance, bending], axis=1)), 1)[0]
    assert order[0] > 3.3
    assert order[1] > 1.7
    assert bending[-1] < 0.03


@pytest.mark.parametrize("kind", [JetSurface, GraphSurface])
def test_fitted_surfaces_project_idempotently_and_know_their_outline(kind):
    surface = kind(HILLS.mesh(24))
    points = scattered(HILLS) + 0.03 * np.random.default_rng(3).normal(size=(200, 3)) * [0, 0, 1]
    once = surface.project(points)
    np.testing.assert_allclose(surface.project(once.positions).positions, once.positions, atol=1e-13)
    np.testing.assert_allclose(norm(once.normals), 1, atol=1e-14)
    assert once.known.all()
    assert not surface.project(np.array([[1.53, 0, 0], [0, 1.03, 0], [1.53, 1.03, 0]])).known.any()
    assert surface.project(surface.mesh.vertices * 0.999).known.all()


@pytest.mark.parametrize("kind", [JetSurface, GraphSurface])
def test_fits_move_with_the_mesh_and_scale_with_it(kind):
    mesh, points = HILLS.mesh(20), scattered(HILLS, 50)
    turn = Rotation.from_rotvec([1.0, 0.4, -0.7]).as_matrix()
    there = kind(mesh).project(points)
    moved = kind(ReferenceMesh(1000 * mesh.vertices @ turn.T + [300, -70, 2000], mesh.triangles))
    here = moved.project(1000 * points @ turn.T + [300, -70, 2000])
    tolerance = 1e-5 if kind is JetSurface else 2e-2  # the grid of the spline turns only with the mean plane
    np.testing.assert_allclose(here.bending, turn @ there.bending @ turn.T / 1000, atol=tolerance / 1000)


def test_jets_survive_noise_and_uneven_vertices():
    rng = np.random.default_rng(0)
    mesh = HILLS.mesh(40)
    u = np.linspace(0, 1, 41) ** 1.5  # cells seven times smaller at one end
    x, y = np.meshgrid(3 * u - 1.5, np.linspace(-1, 1, 27), indexing="ij")
    uneven = grid_mesh(HILLS.project(np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)).positions.reshape(41, 27, 3))
    noise = 0.01 * mesh.edge_length * rng.normal(size=mesh.vertices.shape)
    noisy = ReferenceMesh(mesh.vertices + noise, mesh.triangles)
    for bad, bound in ((uneven, 0.06), (noisy, 0.2)):
        found = JetSurface(bad).project(bad.corners.mean(axis=1))
        truth = HILLS.project(found.positions)
        assert norm(found.positions - truth.positions).max() < 0.02 * mesh.edge_length
        assert norm((found.bending - truth.bending).reshape(-1, 9)).mean() < bound


def test_points_far_away_reach_the_jets_by_the_nearest_vertex():
    surface = JetSurface(Sphere(2.0).mesh(40))
    far = 50 * unit(np.random.default_rng(0).normal(size=(50, 3)))
    at = surface.project(far)
    np.testing.assert_allclose(norm(at.positions), 2, atol=2e-3)
    assert at.known.all()


def test_the_graph_runs_on_smoothly_beyond_the_boundary():
    surface = GraphSurface(HILLS.mesh(40))
    line = np.linspace(1.3, 1.5 + 0.9 * 0.15 * surface.diagonal, 200)[:, None] * [1, 0, 0]
    at = surface.project(line)
    assert not at.known[-1]
    bend = norm(at.bending.reshape(-1, 9))
    assert np.abs(np.diff(bend)).max() < 0.05
    assert bend.max() < 1.5 * norm(HILLS.project(scattered(HILLS)).bending.reshape(-1, 9)).max()
    far = surface.project(surface.to_space(np.array([[100.0, 0, 0], [200, 0, 0], [300, 0, 0]]))).positions
    np.testing.assert_allclose(np.diff(far, 2, axis=0), 0, atol=1e-9)


def test_surfaces_that_are_no_graph_say_so():
    assert facing_up(HILLS.mesh(20)) == pytest.approx(1)
    with pytest.raises(Infeasible, match="no graph"):
        GraphSurface(Cylinder(1, 3).mesh(20))


@pytest.mark.parametrize("name", ["sphere", "torus", "height field"])
def test_feet_of_perpendiculars_are_closest_points(name):
    surface = FORMULAS[name]
    points = scattered(surface) + 0.1 * np.random.default_rng(2).normal(size=(200, 3))
    feet = closest_on_surface(surface, points)
    assert norm(np.cross(points - feet.positions, feet.normals)).max() < 1e-10
    dense = surface.mesh(160 if name != "sphere" else 80)
    nearest, faces = closest_on_mesh(dense, points)
    assert np.abs(norm(points - nearest) - norm(points - feet.positions))[feet.known].max() < 5e-3
    assert faces.max() < len(dense.triangles)


def test_closest_points_of_a_mesh_agree_with_trying_all_faces():
    mesh = HILLS.mesh(10)
    points = np.random.default_rng(0).normal(size=(60, 3))
    feet, faces = closest_on_mesh(mesh, points)
    grid = np.array([[i, j, 60 - i - j] for i in range(61) for j in range(61 - i)]) / 60
    samples = np.einsum("gk,fki->fgi", grid, mesh.corners)
    brute = norm(points[:, None] - samples.reshape(-1, 3)).min(axis=1)
    assert (norm(points - feet) <= brute + 1e-12).all()
    assert (norm(points - feet) >= brute - 0.02).all()
    corners = mesh.corners[faces]
    assert np.abs(dot(feet - corners[:, 0], mesh.normals[faces])).max() < 1e-12


def test_the_outline_knows_holes_corners_and_distances():
    mesh = grid_mesh(np.stack([*np.meshgrid(np.arange(7.0), np.arange(7.0), indexing="ij"), np.zeros((7, 7))], axis=-1))
    middle = mesh.corners.mean(axis=1)
    holed = ReferenceMesh(mesh.vertices, mesh.triangles[norm(middle - [3, 3, 0]) > 1.2])
    outline = Outline(holed)
    points = np.array([[3, 3, 0], [1, 1, 0], [-0.5, 3, 0], [6.3, 6.4, 0], [5.9, 5.9, 0], [3, -2, 0]])
    assert outline.inside(points).tolist() == [False, True, False, False, True, False]
    assert outline.beyond(points)[[1, 2, 3, 5]] == pytest.approx([-1, 0.5, 0.5, 2])
    assert Outline(Sphere(1).mesh(16)).inside(points).all()


@pytest.mark.parametrize("text", ["x", "3", "-x + +y", "x*y/3 - 2*y", "x**3*y**2", "2**x", "(1+x*x)**y",
                                  "sin(x)*cos(2*y)", "tan(0.3*x)", "exp(x-y)", "log(3+x)", "sqrt(4+x*y)", "abs(x+2)",
                                  "x**0", "x**1", "(-2-x)**3", "1/(3+y)", "pi*x**-2", "1e-1*x**2.0"])
def test_expressions_are_differentiated_exactly(text):
    heights = height_expression(text)
    rng = np.random.default_rng(0)
    x, y = rng.uniform(0.2, 1, 20), rng.uniform(-1, 1, 20)
    z, zx, zy, zxx, zxy, zyy = heights(x, y)
    functions = {name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "abs", "pi")}
    np.testing.assert_allclose(z, eval(text, {"__builtins__": {}}, functions | {"x": x, "y": y}) + 0 * x, rtol=1e-14)
    step = 1e-5
    (east, north), (west, south) = [(heights(x + s, y), heights(x, y + s)) for s in (step, -step)]
    np.testing.assert_allclose([zx, zy], [(east - west)[0] / (2 * step), (north - south)[0] / (2 * step)],
                               rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose([zxx, zxy, zyy], [(east - west)[1] / (2 * step), (north - south)[1] / (2 * step),
                                                 (north - south)[2] / (2 * step)], rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("text", [
    "__import__('os').system('true')", "open('/etc/passwd')", "().__class__.__bases__[0]", "x.__class__", "eval('1')",
    "exec('1')", "lambda: 0", "[x for x in (1,)]", "x if y else 1", "f'{x}'", "globals()", "sin.__call__(x)",
    "(x := 1)", "x; y", "import os", "sin(x, y)", "sin(a=x)", "sin(*[x])", "x and y", "x < y", "x @ y", "x // y",
    "x % y", "x ^ 2", "~x", "'x'", "True", "1j", "None", "...", "z", "e", "x[0]", "{x}", "await x", "1e999",
    "10**99999999999999999", "9" * 999, "x" * 1001,
    "(" * 400 + "x" + ")" * 400, "-" * 500 + "x", "x" + "+x" * 300, "", "   ", "x\0", "sin",
    "\ud800"])
def test_anything_but_a_formula_is_refused_in_one_sentence(text):
    with pytest.raises(InvalidDesign) as caught:
        height_expression(text)
    sentence = str(caught.value)
    assert "\n" not in sentence
    assert len(sentence) < 300


def test_towers_of_powers_cost_nothing_and_are_not_defined():
    assert np.isnan(height_expression("9**9**9**9")(np.zeros(1), np.zeros(1))).all()


def test_height_fields_must_be_defined_on_their_rectangle():
    with pytest.raises(InvalidDesign, match=r"not defined at x = -1, y = -1"):
        HeightField("log(x)")
    with pytest.raises(InvalidDesign, match="two rising numbers"):
        HeightField("x*y", (1, 1))
    assert np.isnan(HeightField("sqrt(x)", (0.1, 1)).project(np.array([[-1.0, 0, 0]])).positions[0, 2])
