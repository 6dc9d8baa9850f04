"""The main job, end to end: recipes become exact structures, and what cannot work is diagnosed."""

import msgspec
import numpy as np
import pytest

import plisse
from plisse.io.designs import design_from_dict
from plisse.measure.isometry import isometry_defect
from plisse.structure.grid import grid

OPEN = {"curve": {"kind": "spline", "points": [[80, -60, -10], [100, -20, 0], [102, 25, 4], [85, 65, 14]]},
        "pattern": {"theta": 30, "creases": 8, "width": 6, "amplitude": 4, "samples": 70}}
CLOSED = {"curve": {"kind": "ellipse", "a": 100, "b": 90},
          "pattern": {"theta": 40, "creases": 7, "width": 6, "amplitude": 5, "samples": 80}}


def varied(recipe, section, **changes):
    return {**recipe, section: {**recipe.get(section, {}), **changes}}


def independent_defects(vertices, faces):
    """Planarity and angle sums by a loop over faces, sharing no code with plisse."""
    sums, corners, planarity = np.zeros(len(vertices)), np.zeros(len(vertices), int), 0.0
    for face in faces:
        a, b, c, d = vertices[face]
        volume = np.linalg.det([b - a, c - a, d - a])
        planarity = max(planarity, abs(volume) / np.linalg.norm(c - a) / np.linalg.norm(d - b) / np.linalg.norm(b - a))
        for k in range(4):
            p, q = vertices[face[k - 1]] - vertices[face[k]], vertices[face[(k + 1) % 4]] - vertices[face[k]]
            sums[face[k]] += np.arctan2(np.linalg.norm(np.cross(p, q)), p @ q)
            corners[face[k]] += 1
    return planarity, np.abs(sums[corners == 4] - 2 * np.pi).max()


@pytest.mark.parametrize("recipe", [OPEN, CLOSED], ids=["open", "closed"])
@pytest.mark.parametrize("principal", [False, True])
def test_designs_become_exact_by_an_independent_count(recipe, principal):
    result = plisse.design(varied(recipe, "solve", principal=principal))
    assert result.status == "exact", result.report.reasons
    planarity, angle = independent_defects(result.structure.vertices, result.structure.topology.faces)
    assert planarity < 1e-11
    assert angle < 1e-11
    if principal:
        assert result.report.principal
        assert result.report.principal_defect.max < 1e-11


def test_the_development_is_isometric_and_its_cut_edges_are_congruent():
    result = plisse.design(CLOSED)
    opened = result.structure.opened
    flat = opened.development
    assert isometry_defect(opened.topology, opened.vertices, flat) < 1e-12
    assert opened.topology.vertex_count == result.structure.topology.vertex_count + 7
    copies = np.arange(result.structure.topology.vertex_count, opened.topology.vertex_count)
    sources = result.structure.cut.source[copies]
    assert np.array_equal(opened.vertices[copies], opened.vertices[sources])
    gaps = [np.linalg.norm(np.diff(flat[row], axis=0), axis=1) for row in (copies, sources)]
    assert np.allclose(*gaps, rtol=1e-12)


def test_principal_structures_have_constant_fold_angles_along_creases():
    from plisse.measure.folds import fold_angles

    structure = plisse.design(varied(OPEN, "solve", principal=True)).structure
    edges = structure.topology.edges
    folds = fold_angles(structure.topology, structure.vertices).reshape(-1)
    for crease in structure.topology.creases[1:-1]:
        on_crease = np.isin(edges.vertices, crease.vertices).all(axis=1) & edges.is_crease
        assert np.ptp(folds[on_crease]) < 1e-10


def test_two_runs_give_the_same_numbers():
    first, second = plisse.design(OPEN), plisse.design(OPEN)
    assert np.array_equal(first.structure.vertices, second.structure.vertices)
    assert np.array_equal(first.structure.development, second.structure.development)


def test_a_scaled_design_gives_the_scaled_structure():
    scaled = design_from_dict(OPEN)
    big = msgspec.structs.replace(
        scaled, curve=msgspec.structs.replace(scaled.curve, points=(np.array(scaled.curve.points) * 1000).tolist()),
        pattern=msgspec.structs.replace(scaled.pattern, width=6000.0, amplitude=4000.0))
    small, large = plisse.design(OPEN).structure.vertices, plisse.design(big).structure.vertices
    assert np.abs(large / 1000 - small).max() < 1e-6  # solutions of a nonlinear solve, not of a formula


def test_finer_sampling_converges_to_one_shape():
    shapes = [plisse.design(varied(OPEN, "pattern", samples=n)).structure.vertices.reshape(8, n, 3)[:, ::(n - 1) // 30]
              for n in (31, 61, 121)]
    assert np.abs(shapes[2] - shapes[1]).max() < 0.5 * np.abs(shapes[1] - shapes[0]).max()


def test_a_family_of_circles_gives_alternating_cones():
    recipe = {"curve": {"kind": "arc", "radius": 100, "angle": 120},
              "pattern": {"theta": 0, "creases": 6, "width": 5, "amplitude": 3, "samples": 60}}
    vertices = plisse.design(recipe).structure.vertices
    radius = np.linalg.norm(vertices[:, :2], axis=1).reshape(6, 60)
    assert np.ptp(radius, axis=1).max() < 1e-3  # circles stay circles; their radii are those of the evolution
    assert np.allclose(radius.mean(axis=1), 100 - 5 * np.arange(6), atol=0.02)


def test_a_pattern_beyond_the_focal_set_is_located_and_not_solved():
    report = plisse.design({"curve": {"kind": "arc", "radius": 20, "angle": 90},
                            "pattern": {"creases": 12, "width": 4, "amplitude": 2}}).report
    assert report.status == "infeasible"
    assert "crease" in report.reasons[0]
    assert "%" in report.reasons[0]
    assert "lower pattern.width" in report.reasons[0]


def test_strips_that_just_reach_the_centre_are_narrowed_and_that_is_said():
    report = plisse.design({"curve": {"kind": "arc", "radius": 20, "angle": 90},
                            "pattern": {"creases": 11, "width": 2, "amplitude": 1.2, "samples": 60}}).report
    assert report.status == "exact"
    assert any("narrowed to 97 %" in warning for warning in report.warnings)


def test_an_inflected_seed_is_reported_with_the_place():
    x = np.linspace(-1, 1, 13)
    points = (100 * np.stack([x, 0.4 * np.sin(2.5 * x), 0.1 * x], axis=1)).tolist()
    report = plisse.design({"curve": {"kind": "spline", "points": points},
                            "pattern": {"creases": 6, "width": 2, "amplitude": 1, "samples": 60}}).report
    assert report.status != "exact"
    assert any("rulings fall" in reason or "curvature" in reason for reason in report.reasons)


def test_the_cut_lies_where_the_designer_says():
    first = plisse.design(varied(CLOSED, "solve", cut=0)).structure
    half = plisse.design(varied(CLOSED, "solve", cut=50)).structure
    assert first.cut.source[-1] % 80 == 0
    assert half.cut.source[-1] % 80 == 40


def test_python_needs_five_lines():
    result = plisse.design({"curve": {"kind": "arc", "radius": 100, "angle": 90},
                            "pattern": {"theta": 20, "creases": 8, "width": 5, "amplitude": 3}})
    assert result.status == "exact"
    assert result.structure.vertices.shape == (8 * 200, 3)
    assert result.structure.development.shape == (8 * 200, 2)


def test_progress_names_the_stages_in_order():
    stages = []
    plisse.design(OPEN, progress=lambda stage, fraction: stages.append((stage, fraction)))
    assert [stage for stage, _ in stages] == ["evolve", "solve", "flatten", "measure", "done"]
    assert [fraction for _, fraction in stages] == sorted(fraction for _, fraction in stages)


def test_mirror_spacing_starts_with_smaller_angle_defects_than_uniform_spacing():
    steep = varied(OPEN, "pattern", theta=60)
    mirror = plisse.design(steep).report.start["angle_defect"].mean
    uniform = plisse.design(varied(steep, "pattern", spacing="uniform")).report.start["angle_defect"].mean
    assert mirror < 0.3 * uniform


def test_a_grid_of_any_kind_is_not_assumed_by_the_exact_polish():
    """A masked grid, one quad missing in the middle, solved by the same constraints."""
    from plisse.solve.constraints import Constraints
    from plisse.solve.polish import polish

    solved = plisse.design(OPEN).structure
    mask = np.ones((7, 69), bool)
    mask[3, 30] = False
    holed = grid(8, 70, mask=mask)
    scale = solved.mean_edge
    noisy = solved.vertices / scale + np.random.default_rng(0).normal(size=solved.vertices.shape) * 1e-4
    done = polish(Constraints(holed), np.ascontiguousarray(noisy.T))
    assert done.defect < 1e-12
    assert holed.euler_characteristic == 0
