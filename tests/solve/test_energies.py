"""Every kernel has its exact Jacobian, every term gathers and scatters, and vanishes where it should."""

import importlib
import inspect
import pkgutil

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.geometry.vectors import unit
from plisse.layout.binormal import binormal_fit
from plisse.leastsquares.kernel import KERNELS
from plisse.leastsquares.problem import Problem
from plisse.measure.planarity import face_normals
from plisse.solve import energies
from plisse.solve.energies import (
    Guides,
    closeness,
    constant_fold,
    developability,
    displacement_fairness,
    fairness,
    flat_foldability,
    isometry,
    planarity,
    plane_fit,
)
from plisse.structure.exact import alternating_cones, conic_creases, marched, miura
from plisse.structure.grid import grid

for module in pkgutil.iter_modules(energies.__path__):
    importlib.import_module(f"{energies.__name__}.{module.name}")

ELEMENTS, RING = 7, 4
FLAT = {("equal_length", "a"), ("equal_length", "b")}  # arguments in the plane
SCALAR = {"square"}  # data with one number per element


def local_arrays(kernel, rng):
    """Random positional arguments and data of a kernel."""
    arguments, data = [], {}
    for parameter in inspect.signature(kernel.residual).parameters.values():
        shape = (2 if (kernel.name, parameter.name) in FLAT else 3, ELEMENTS)
        if parameter.kind is parameter.KEYWORD_ONLY:
            data[parameter.name] = rng.normal(size=shape[1:] if parameter.name in SCALAR else shape)
        else:
            copies = RING if parameter.kind is parameter.VAR_POSITIONAL else 1
            arguments += [rng.normal(size=shape) for _ in range(copies)]
    return arguments, data


def differences(kernel, arguments, data, place, component):
    """Derivative of the residual by one component of one argument: complex step, central where that fails."""
    def moved(step):
        shifted = [a.astype(type(step)) for a in arguments]
        shifted[place][component] += step
        return kernel(*shifted, **data)

    try:
        return moved(1e-30j).imag / 1e-30, 1e-13
    except TypeError:
        # arctan2 knows no complex numbers; central differences lose two thirds of the digits
        return (moved(1e-6) - moved(-1e-6)) / 2e-6, 1e-7


@pytest.mark.parametrize("name", sorted(KERNELS))
def test_jacobian_of_every_kernel_agrees_with_differences(name):
    kernel = KERNELS[name]
    arguments, data = local_arrays(kernel, np.random.default_rng(1))
    gradients = kernel.gradients(*arguments, **data)
    assert len(gradients) == len(arguments)
    for place, gradient in enumerate(gradients):
        assert gradient.shape == arguments[place].shape
        for component in range(len(gradient)):
            expected, tolerance = differences(kernel, arguments, data, place, component)
            if kernel.componentwise:
                assert not np.delete(expected, component, axis=0).any()
                expected = expected[component]
            np.testing.assert_allclose(gradient[component], expected, rtol=0,
                                       atol=tolerance * (1 + np.abs(expected).max()))


def test_comparison_with_differences_can_fail():
    kernel = KERNELS["tetrahedron_volume"]
    arguments, data = local_arrays(kernel, np.random.default_rng(1))
    expected, tolerance = differences(kernel, arguments, data, 0, 0)
    wrong = -kernel.gradients(*arguments)[0][0]
    assert np.abs(wrong - expected).max() > 1e3 * tolerance


def blocks_of(structure):
    """Unknowns of a structure at its own scale."""
    return {"vertices": structure.vertices.T, "development": structure.development.T,
            "normals": face_normals(structure.topology, structure.vertices).T}


def keys_of(structure):
    topology = structure.topology
    return {"vertices": (3, np.arange(topology.vertex_count)),
            "development": (2, np.arange(topology.vertex_count) + 0.5),
            "normals": (3, np.linspace(0, topology.vertex_count, topology.face_count))}


def all_terms(structure, guides=None):
    """Every term of the library that structures have."""
    topology, vertices = structure.topology, structure.vertices
    guides = Guides.along_creases(topology, vertices) if guides is None else guides
    return [*plane_fit(topology, 10.0), closeness(guides, vertices, 0.5), isometry(topology, 100.0),
            fairness(topology, 0.2), constant_fold(topology, 3.0), planarity(topology),
            *developability(topology), *flat_foldability(topology, 2.0),
            *displacement_fairness(topology, vertices.T, across=0.03)]


def disturbed(blocks, size, seed=3):
    rng = np.random.default_rng(seed)
    return {name: values + size * rng.normal(size=values.shape) for name, values in blocks.items()}


def test_gradient_of_a_problem_is_that_of_its_cost():
    structure = alternating_cones(4, 6)
    problem = Problem(all_terms(structure), keys_of(structure))
    blocks = disturbed(blocks_of(structure), 0.01)
    gradient = problem.gradient(problem.linearise(blocks))

    def cost(unknown, step):
        shift = np.zeros(problem.unknowns)
        shift[unknown] = step
        residual = problem.residual(problem.moved(blocks, shift))
        return residual @ residual / 2

    numeric = [(cost(k, 1e-6) - cost(k, -1e-6)) / 2e-6 for k in range(problem.unknowns)]
    # central differences keep about two thirds of the digits
    np.testing.assert_allclose(gradient, numeric, atol=1e-7 * np.abs(gradient).max())


def test_gauss_newton_step_solves_the_normal_equations():
    structure = alternating_cones(4, 6)
    problem = Problem(all_terms(structure), keys_of(structure))
    at = problem.linearise(disturbed(blocks_of(structure), 0.01))
    rows, unknowns, height = problem._layout
    jacobian = np.zeros((height, problem.unknowns))
    np.add.at(jacobian, (rows, unknowns), at.entries)
    step = problem.factor(at, 1e-3).solve(problem.gradient(at))
    damped = jacobian.T @ jacobian + 1e-3 * np.eye(problem.unknowns)
    expected = np.linalg.solve(damped, jacobian.T @ at.residual)
    np.testing.assert_allclose(step, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("place", range(len(all_terms(alternating_cones(4, 6)))))
def test_terms_do_not_see_rigid_motions(place):
    structure = alternating_cones(4, 6)
    blocks = disturbed(blocks_of(structure), 0.01)
    turn, shift = Rotation.from_rotvec([0.3, -0.5, 0.7]).as_matrix(), np.array([[1.0], [2.0], [-3.0]])
    moved = {"vertices": turn @ blocks["vertices"] + shift, "normals": turn @ blocks["normals"],
             "development": blocks["development"] + 2.0}
    rest = structure.with_vertices((turn @ structure.vertices.T + shift).T)
    costs = [np.sum(Problem([all_terms(shape)[place]], keys_of(structure)).residual(at) ** 2)
             for shape, at in ((structure, blocks), (rest, moved))]
    assert costs[0] > 0
    assert costs[1] == pytest.approx(costs[0], rel=1e-9)


@pytest.mark.parametrize("structure", [alternating_cones(), miura(), conic_creases()],
                         ids=["cones", "miura", "conics"])
def test_terms_vanish_on_exact_structures(structure):
    topology = structure.topology
    exact = [*plane_fit(topology), isometry(topology), constant_fold(topology), planarity(topology),
             *developability(topology), *flat_foldability(topology)]
    residual = Problem(exact, keys_of(structure)).residual(blocks_of(structure))
    assert np.abs(residual).max() < 1e-13
    elsewhere = Problem(exact, keys_of(structure)).residual(disturbed(blocks_of(structure), 1e-3))
    assert np.abs(elsewhere).max() > 1e-4


def test_principal_terms_see_that_a_general_structure_is_not_principal():
    structure = marched()
    normals = face_normals(structure.topology, structure.vertices).T
    blocks = {"vertices": structure.vertices.T, "normals": normals}
    for term in (constant_fold(structure.topology), *flat_foldability(structure.topology)):
        arguments = [blocks[rows.block][:, rows.index] for rows in term.arguments]
        assert np.abs(term.kernel(*arguments)).max() > 1e-3


def test_fairness_vanishes_on_evenly_divided_straight_creases():
    topology = grid(3, 5)
    vertices = np.stack([*np.divmod(np.arange(15.0), 5), np.zeros(15)])
    term = fairness(topology)
    residual = term.kernel(*(vertices[:, rows.index] for rows in term.arguments), **term.data)
    assert residual.shape == (3, 9)
    assert not residual.any()


def test_closeness_lets_vertices_slide_along_creases_and_rise_along_binormals():
    structure = alternating_cones(5, 40)
    topology, vertices = structure.topology, structure.vertices
    guides = Guides.along_creases(topology, vertices)
    creases = vertices.reshape(5, 40, 3)
    radial = unit(creases * np.array([1, 1, 0]))
    slid = creases.copy()
    slid[:, 1:-1] += 0.4 * (creases[:, 2:] - creases[:, 1:-1])
    raised = creases + np.array([0, 0, 0.05])
    for moved, expected in ((slid, 0.0), (raised, 0.0), (creases + 0.05 * radial, 0.05)):
        term = closeness(guides, moved.reshape(-1, 3))
        offset = np.abs(term.kernel(moved.reshape(-1, 3).T, **term.data)).reshape(5, 40)
        # normals along a segment deviate from its chord by the square of its length
        np.testing.assert_allclose(offset[:, 3:-3], expected, atol=1e-4)


def test_binormal_terms_vanish_on_plane_polygons():
    angle = np.linspace(0, 2, 9)
    points = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    for closed in (False, True):
        problem = Problem(binormal_fit(points, closed, 0.1), {"binormals": (3, np.arange(9))})
        assert not problem.residual({"binormals": np.repeat([[0.0], [0.0], [1.0]], 9, axis=1)}).any()
