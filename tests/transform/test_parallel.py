"""Parallel meshes: the linear space, Cauchy data, spirals, the nearest mesh; measured by cross products and angles."""

import sys

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.sparse import csr_array, eye_array

from plisse.errors import Infeasible, InvalidStructure, MissingExtra
from plisse.structure.exact import alternating_cones, conic_creases, marched, miura
from plisse.structure.grid import grid
from plisse.structure.grid_numbers import grid_numbers
from plisse.structure.helical import helical_pleats
from plisse.structure.incidence import edges_of_corners, loop_edges, tree_edges
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.edge_scales import ParallelSpace
from plisse.transform.nearest_parallel import nearest_parallel
from plisse.transform.parallel import from_polylines, parallel, spiral
from plisse.transform.saddle import least_quadratic, projected

SMALL = {"cones": alternating_cones(5, 9), "miura": miura(4, 6), "conics": conic_creases(4, 8), "general": marched(4, 8),
         "helix": helical_pleats(5, 9), "ring": alternating_cones(4, 9, closed=True)}


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(axis=-1))


def require_exact(structure, tolerance=1e-12):
    """Planarity by volumes, angle sums corner by corner, with nothing of plisse but the topology."""
    vertices, quads = structure.vertices, structure.topology.quads
    a, b, c, d = (vertices[quads[:, k]] for k in range(4))
    volume = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)
    size = np.linalg.norm(c - a, axis=1) * np.linalg.norm(d - b, axis=1)
    assert np.abs(volume / (size * np.sqrt(size))).max() < tolerance
    total = np.zeros(len(vertices))
    for k in range(4):
        corner, after, before = vertices[quads[:, k]], vertices[quads[:, (k + 1) % 4]], vertices[quads[:, (k + 3) % 4]]
        np.add.at(total, quads[:, k], angle(after - corner, before - corner))
    inner = ~structure.topology.is_boundary
    assert np.abs(total[inner] - 2 * np.pi).max() < tolerance


def require_parallel(one, other, tolerance=1e-12):
    """Corresponding edges by cross products, and pointing the same way."""
    i, j = one.topology.edges.vertices.T
    p, q = one.vertices[j] - one.vertices[i], other.vertices[j] - other.vertices[i]
    lengths = np.linalg.norm(p, axis=1) * np.linalg.norm(q, axis=1)
    assert (np.linalg.norm(np.cross(p, q), axis=1) / lengths).max() < tolerance
    assert ((p * q).sum(axis=1) > 0).all()


def freedoms_by_brute_force(structure):
    """Vertices that keep all edges parallel, without translations: three unknowns per vertex, two conditions per edge."""
    ends, count = structure.topology.edges.vertices, len(structure.vertices)
    rows = np.zeros((3 * len(ends), 3 * count))
    for k, (i, j) in enumerate(ends):
        along = structure.vertices[j] - structure.vertices[i]
        across = np.eye(3) - np.outer(along, along) / (along @ along)
        rows[3 * k:3 * k + 3, 3 * i:3 * i + 3], rows[3 * k:3 * k + 3, 3 * j:3 * j + 3] = -across, across
    return 3 * count - np.linalg.matrix_rank(rows, tol=1e-9) - 3


@pytest.mark.parametrize("name", SMALL)
def test_the_dimension_is_that_of_all_vertex_positions_with_parallel_edges(name):
    space = ParallelSpace(SMALL[name])
    assert space.dimension == freedoms_by_brute_force(SMALL[name])
    conditions = space.conditions.toarray()
    assert space.dimension == conditions.shape[1] - np.linalg.matrix_rank(conditions, tol=1e-9)


@pytest.mark.parametrize(("creases", "columns"), [(3, 3), (4, 7), (7, 4), (6, 12)])
def test_an_open_grid_has_one_freedom_per_edge_of_two_transverse_polylines(creases, columns):
    assert ParallelSpace(miura(creases, columns)).dimension == (creases - 1) + (columns - 1)


def test_faces_fill_all_loops_of_a_disk_all_but_one_of_a_ring_and_all_but_two_of_a_torus():
    for topology, loops in ((grid(4, 6), 0), (grid(4, 6, closed_creases=True), 1),
                            (grid(4, 6, closed_creases=True, closed_family=True), 2)):
        leading = tree_edges(topology, 0)[1]
        assert (leading < 0).sum() == 1
        assert len(loop_edges(topology, leading)) == loops


def test_edges_of_corners_run_around_their_faces():
    topology = grid(3, 5)
    edge, sign = edges_of_corners(topology)
    ends = topology.edges.vertices[edge]
    start = np.where(sign > 0, ends[:, 0], ends[:, 1])
    assert (start == topology.corners.vertex).all()


@pytest.mark.parametrize("name", ["cones", "miura", "conics", "general", "helix"])
def test_factors_on_two_polylines_determine_an_exact_parallel_mesh(name):
    structure = SMALL[name]
    numbers = grid_numbers(structure.topology)
    count, columns = numbers.shape
    lengths = 1 + 0.15 * np.sin(np.arange(columns - 1))
    widths = 1 + 0.2 * np.cos(np.arange(count - 1))
    found = from_polylines(structure, lengths, widths)
    require_parallel(structure, found)
    require_exact(found)
    first, rulings = structure.topology.creases[0].vertices, structure.topology.rulings[0].vertices
    for line, factors in ((first, lengths), (rulings, widths)):
        before, after = (np.linalg.norm(np.diff(s.vertices[line], axis=0), axis=1) for s in (structure, found))
        assert after / before == pytest.approx(factors, abs=1e-12)
    assert found.vertices[first[0]] == pytest.approx(structure.vertices[first[0]], abs=1e-12)


def test_the_combescure_transform_of_the_cones_is_known_in_closed_form():
    """Along cones crease edges are parallel: rulings share one factor w, and rings of radius R + l·width become
    R' + w·l·width where all edges of the first are scaled by R'/R."""
    structure = alternating_cones(6, 24, radius=1.0, width=0.2, slope=0.8, sector=2.0)
    found = from_polylines(structure, 1.5, 0.5)
    wanted = alternating_cones(6, 24, radius=1.5, width=0.1, slope=0.8, sector=2.0)
    shift = wanted.vertices[0] - found.vertices[0]
    assert found.vertices + shift == pytest.approx(wanted.vertices, abs=1e-13)


def test_offsets_of_principal_structures_lie_in_the_space():
    """Offsets are parallel meshes (§2.4): their edge scales satisfy the conditions of the space."""
    structure = conic_creases(5, 20)
    moved = structure.offset(0.01)
    space = ParallelSpace(structure)
    assert np.abs(space.conditions @ space.scales(moved.vertices)).max() < 1e-12
    back = space.positions(space.scales(moved.vertices))
    assert back - back[0] == pytest.approx(moved.vertices - moved.vertices[0], abs=1e-12)


def test_parallel_structures_of_principal_ones_are_principal():
    structure = conic_creases(6, 30)
    report_of = parallel(structure, widths=np.linspace(1, 2, 5))
    star = report_of.topology.stars[4]
    arms = report_of.vertices[star[:, 1:]] - report_of.vertices[star[:, :1]]
    sectors = [angle(arms[:, k], arms[:, (k + 1) % 4]) for k in range(4)]
    assert np.abs(sectors[0] + sectors[2] - np.pi).max() < 1e-12
    assert report_of.development is not None


def test_a_helical_structure_is_exact_and_screws_onto_itself():
    structure = helical_pleats(7, 40, radius=20, pitch=50, width=4, slope=0.9, turns=0.8)
    require_exact(structure)
    numbers = grid_numbers(structure.topology)
    turn = 2 * np.pi * 0.8 / 39
    screw = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    before, after = structure.vertices[numbers[:, :-1]], structure.vertices[numbers[:, 1:]]
    assert after == pytest.approx(before @ screw.T + [0, 0, 50 * 0.8 / 39], abs=1e-12)
    widths = np.linalg.norm(np.diff(structure.vertices[numbers], axis=0), axis=-1)
    assert widths == pytest.approx(4, abs=1e-12)


@pytest.mark.parametrize("growth", [0.6, 1.8])
def test_helical_symmetry_becomes_spiral_symmetry(growth):
    structure = helical_pleats(7, 61)
    found = spiral(structure, growth)
    require_parallel(structure, found)
    require_exact(found)
    rows = found.vertices[grid_numbers(found.topology)]
    here, there = rows[:, :-1].reshape(-1, 3), rows[:, 1:].reshape(-1, 3)
    a, b = here - here.mean(axis=0), there - there.mean(axis=0)
    left, _, right = np.linalg.svd(a.T @ b)
    ratio = growth ** (1 / 60)
    assert b == pytest.approx(ratio * a @ (left @ right), abs=1e-10 * np.abs(a).max())
    creases = structure.topology.creases
    total = [sum(np.linalg.norm(np.diff(s.vertices[crease.vertices], axis=0), axis=1).sum() for crease in creases)
             for s in (structure, found)]
    assert total[0] == pytest.approx(total[1], rel=1e-10)


def test_closed_structures_are_cut_open_for_a_spiral():
    ring = alternating_cones(4, 24, closed=True, slope=1.0, width=0.05)
    found = spiral(ring, 1.05)
    assert not found.topology.creases[0].closed
    require_exact(found)


def nearest_by_slsqp(structure, targets, least):
    """The same program in the null space of the conditions, by another solver: scales and squared distance."""
    space = ParallelSpace(structure)
    _, values, rows = np.linalg.svd(space.conditions.toarray())
    basis = rows[(values > 1e-10).sum():].T
    ones = basis.T @ np.ones(len(basis))
    placed = np.array([space.positions(column) for column in basis.T])
    placed = placed - placed.mean(axis=1, keepdims=True)
    wanted = targets - targets.mean(axis=0)

    def distance(x):
        gap = np.tensordot(x, placed, 1) - wanted
        return (gap**2).sum(), 2 * np.tensordot(placed, gap, ([1, 2], [0, 1]))

    found = minimize(distance, ones, jac=True, method="SLSQP", options={"ftol": 1e-14, "maxiter": 500},
                     constraints={"type": "ineq", "fun": lambda x: basis @ x - least, "jac": lambda x: basis})
    return basis @ found.x, found.fun


@pytest.mark.parametrize("name", ["conics", "general"])
def test_the_nearest_parallel_mesh_is_what_another_solver_finds(name):
    pytest.importorskip("clarabel")
    structure = SMALL[name]
    rng = np.random.default_rng(3)
    noise = 0.3 * structure.mean_edge * rng.standard_normal(structure.vertices.shape)
    targets = structure.vertices * [1.4, 0.8, 1.0] + noise
    found = nearest_parallel(structure, targets, least_scale=0.9)
    scales, distance = nearest_by_slsqp(structure, targets, 0.9)
    own = ParallelSpace(structure).scales(found.vertices)
    assert own.min() > 0.9 - 1e-8  # interior points stop 1e-8 from the bound
    assert (own < 0.9 + 1e-6).any()  # some bounds are active, or this would test least squares only
    assert ((found.vertices - targets) ** 2).sum() == pytest.approx(distance, rel=1e-7)
    assert own == pytest.approx(scales, abs=1e-4)  # flat valleys: the distance is what is compared sharply
    require_parallel(structure, found)
    require_exact(found)


def test_a_parallel_mesh_is_its_own_nearest_one():
    pytest.importorskip("clarabel")
    structure = SMALL["conics"]
    wanted = from_polylines(structure, 1.3, 0.7)
    moved = wanted.vertices + np.array([3, -2, 1])
    found = nearest_parallel(structure, moved)
    assert found.vertices == pytest.approx(moved, abs=1e-7)  # accuracy of interior points


def test_handles_are_reached_and_scales_stay_positive():
    pytest.importorskip("clarabel")
    structure = conic_creases(6, 30)
    crease = structure.topology.creases[3].vertices
    place = structure.vertices[crease[0]] + 0.3 * structure.mean_edge
    found = parallel(structure, handles={(3, 0): place}, least_scale=0.3)
    assert np.linalg.norm(found.vertices[crease[0]] - place) < 0.02 * structure.mean_edge
    assert ParallelSpace(structure).scales(found.vertices).min() > 0.3 - 1e-8
    require_exact(found)
    by_number = parallel(structure, handles={int(crease[0]): place}, least_scale=0.3)
    assert by_number.vertices == pytest.approx(found.vertices, abs=1e-12)


def test_without_the_solver_one_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "clarabel", None)
    with pytest.raises(MissingExtra, match="plisse\\[parallel\\]"):
        nearest_parallel(SMALL["miura"], SMALL["miura"].vertices)


def test_what_cannot_be_is_said():
    structure = SMALL["conics"]
    with pytest.raises(Infeasible, match="turn round"):
        from_polylines(SMALL["cones"], 0.05, 4.0, crease=4)
    with pytest.raises(InvalidStructure, match="7 edges"):
        from_polylines(structure, [1.0, 2.0])
    with pytest.raises(InvalidStructure, match="positive"):
        from_polylines(structure, -1.0)
    with pytest.raises(InvalidStructure, match="exactly one"):
        parallel(structure, growth=2, widths=2)
    with pytest.raises(Infeasible, match="factor 0"):
        spiral(structure, 0.0)
    with pytest.raises(Infeasible, match="contradict"):
        from_polylines(SMALL["ring"], 1 + 0.3 * (np.arange(9) > 4))
    with pytest.raises(InvalidStructure, match="no crease 9"):
        parallel(structure, handles={(8, 0): [0, 0, 0]})
    with pytest.raises(InvalidStructure, match="places"):
        nearest_parallel(structure, structure.vertices[:5])
    two = Topology(12, np.concatenate([grid(2, 3).quads, grid(2, 3).quads + 6]))
    with pytest.raises(InvalidStructure, match="connected"):
        ParallelSpace(PleatedStructure(two, np.arange(36.0).reshape(12, 3)))


def test_grids_are_recognised_however_their_vertices_are_numbered():
    topology = grid(4, 7)
    rng = np.random.default_rng(1)
    number = rng.permutation(28)
    numbers = grid_numbers(Topology(28, rng.permutation(number[topology.quads])))
    wanted = number.reshape(4, 7)
    options = [wanted, wanted[::-1], wanted[:, ::-1], wanted[::-1, ::-1]]
    assert any(np.array_equal(numbers, option) for option in options)
    with pytest.raises(InvalidStructure, match="open grid"):
        grid_numbers(grid(3, 5, closed_creases=True))


def test_quadratic_functions_are_minimised_under_equations_that_repeat():
    matrix = np.array([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]])
    found = least_quadratic(eye_array(3), np.array([3.0, 1.0, 5.0]), csr_array(matrix), np.array([2.0, 4.0]))
    assert found == pytest.approx([2, 0, 5], abs=1e-10)
    assert projected(np.array([3.0, 1.0, 5.0]), csr_array(matrix)) == pytest.approx([1, -1, 5], abs=1e-10)
