"""Designs along asymptotic curves, from the recipe to files that others can check."""

import json
import re
from importlib.resources import files

import numpy as np
import pytest
import trimesh
from scipy.spatial import Delaunay

import plisse
from plisse.cli import main
from plisse.designs.deviations import deviation_again
from plisse.errors import InvalidDesign, InvalidMesh
from plisse.measure.folds import fold_angles
from plisse.measure.isometry import isometry_defect
from plisse.measure.sectors import sector_angles
from plisse.structure.chains import boundary_loops

MONKEY = {"kind": "asymptotic", "formula": "0.3*(x**3 - 3*x*y**2)"}
SMALL = {"creases": 5, "columns": 16}


def made(surface=MONKEY, **pattern):
    return plisse.design({"surface": surface, "pattern": {**SMALL, **pattern}})


@pytest.fixture(scope="module")
def monkey():
    return made()


def test_a_monkey_saddle_becomes_one_exact_piece_of_paper(monkey):
    report = monkey.report
    assert report.status == "exact", report.reasons
    assert max(report.planarity.max, report.angle_defect.max) < 1e-11
    assert report.min_sector_angle_deg > 15
    assert report.development.pieces == 1
    assert not report.development.overlaps
    assert report.self_intersections == 0
    assert 0.1 < report.coverage < 1
    assert report.crease_deviation.max < 3
    assert any("index -0.5 at (0, 0, 0), 3 sectors" in note for note in report.warnings)
    assert report.design["surface"]["kind"] == "asymptotic"


def test_the_development_closes_around_the_polygon(monkey):
    structure = monkey.structure
    assert structure.cut.is_trivial
    assert isometry_defect(structure.topology, structure.vertices, structure.development) < 1e-12
    hub, = structure.topology.hubs
    flat = structure.development[hub]
    sides = np.roll(flat, -1, axis=0) - flat
    turns = np.angle((np.roll(sides, -1, axis=0) @ [1, 1j]) / (sides @ [1, 1j]))
    assert turns.sum() == pytest.approx(2 * np.pi, abs=1e-12)
    assert (turns > 0).all()


def test_files_are_accepted_by_check_and_carry_the_letters_of_the_folds(tmp_path, capsys):
    (tmp_path / "saddle.toml").write_text(
        '[surface]\nkind = "asymptotic"\nweierstrass = { g = "z**2" }\nx = [-0.4, 0.4]\ny = [-0.4, 0.4]\n'
        "[pattern]\ncreases = 5\ncolumns = 9\n")
    assert main(["make", str(tmp_path / "saddle.toml"), "-o", str(tmp_path / "out"), "--quiet"]) == 0
    assert main(["check", str(tmp_path / "out" / "structure.fold")]) == 0
    assert main(["check", str(tmp_path / "out" / "structure.obj")]) == 0
    capsys.readouterr()
    fold = json.loads((tmp_path / "out" / "structure.fold").read_text())
    assert sorted(set(map(len, fold["faces_vertices"]))) == [4, 6]
    for letter, angle in zip(fold["edges_assignment"], fold["edges_foldAngle"], strict=True):
        assert letter not in "MV" or (letter == "V") == (angle > 0)


@pytest.mark.parametrize("family", [1, 2])
def test_both_families_of_both_kinds_of_formula_work(family):
    data = {"kind": "asymptotic", "weierstrass": {"g": "z**3"}, "x": [-0.5, 0.5], "y": [-0.5, 0.5], "family": family}
    report = made(data, creases=6, columns=10).report
    assert report.status == "exact", report.reasons
    assert any("index -1" in note for note in report.warnings)


def test_a_polygon_that_is_cut_out_leaves_an_annulus_with_more_than_a_full_turn_around_it():
    result = made({**MONKEY, "hub": "cut"})
    assert result.report.status == "exact", result.report.reasons
    topology = result.structure.topology
    assert topology.hubs == ()
    assert topology.euler_characteristic == 0
    assert not result.structure.cut.is_trivial
    hole = min(boundary_loops(topology), key=len)
    around = np.bincount(topology.corners.vertex, sector_angles(topology, result.structure.vertices))
    cone = (around[hole] - np.pi).sum()  # 2π for a hole in a flat sheet
    assert np.radians(365) < cone < np.radians(420)


def scattered(path, noise, count=1100, seed=5, hole=0.0):
    """A saddle that is not harmonic, as a mesh of scattered vertices with noise."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-0.95, 0.95, (count, 2))
    places = places[(np.hypot(*places.T) < 0.95) & (np.hypot(*places.T) >= hole)]
    x, y = places.T
    height = 0.2 * (x**3 - 3 * x * y**2) + 0.015 * np.cos(2.2 * x + 0.7) * np.sin(1.9 * y - 0.3) + 0.02 * (x**2 + y**2) ** 2
    triangles = Delaunay(places).simplices
    sides = places[triangles] - places[np.roll(triangles, 1, axis=1)]
    triangles = triangles[np.hypot(*sides.transpose(2, 0, 1)).max(axis=1) < 0.2]
    points = np.column_stack([x, y, height + noise * rng.standard_normal(len(x))])
    trimesh.Trimesh(points, triangles, process=False).export(path)


def test_a_noisy_mesh_of_scattered_vertices_that_is_not_harmonic_works(tmp_path):
    scattered(tmp_path / "saddle.ply", 1e-3)
    report = made({"kind": "asymptotic", "file": str(tmp_path / "saddle.ply")}, columns=9).report
    assert report.status == "exact", report.reasons
    assert report.min_sector_angle_deg > 10
    assert report.deviation.mean_amplitudes < 0.5


@pytest.mark.slow
def test_a_mesh_design_is_refined_and_folds_as_its_labels_say(tmp_path):
    scattered(tmp_path / "saddle.ply", 1e-3)
    result = made({"kind": "asymptotic", "file": str(tmp_path / "saddle.ply")}, columns=30)
    assert result.report.status == "exact", result.report.reasons
    assert not any("doubled" in note for note in result.report.warnings)
    assert result.report.faces > 250
    assert folds_as_labelled(result)


def folds_as_labelled(result):
    """Whether every crease folds one way all along, and both ways occur."""
    topology, vertices = result.structure.topology, result.structure.vertices
    edges = topology.edges
    inner = edges.is_crease & ~edges.is_boundary
    sign = np.sign(fold_angles(topology, vertices))
    owner = np.full(topology.vertex_count, -1)
    for number, crease in enumerate(topology.creases):
        owner[crease.vertices] = number
    crease = owner[edges.vertices[inner, 0]]
    total = np.bincount(crease, sign[inner], len(topology.creases))
    return bool((np.abs(total) == np.bincount(crease, minlength=len(total))).all() and len(set(sign[inner])) == 2)


@pytest.mark.slow
def test_every_crease_of_fig22_is_a_mountain_or_a_valley_all_along():
    assert folds_as_labelled(plisse.design(str(files("plisse") / "gallery" / "fig22.toml")))


def test_little_room_on_one_side_leaves_a_sector_out_and_not_the_whole_pattern():
    report = made({"kind": "asymptotic", "formula": "0.3*((x - 0.95)**3 - 3*(x - 0.95)*y**2)"}, creases=9, columns=10).report
    assert report.status == "exact", report.reasons
    assert report.coverage > 0.1
    assert any("without a polygon" in note for note in report.warnings)
    assert any(f"only {100 * report.coverage:.2g} % of the surface" in note for note in report.warnings)


def test_columns_that_are_cut_off_are_counted(monkey):
    assert any(re.match(r"\d+ of 23 columns were left out", note) for note in monkey.report.warnings)


def test_only_what_is_curved_negatively_is_pleated():
    report = made({"kind": "asymptotic", "formula": "x**3 - y**2", "x": [-0.5, 1]}, creases=6, columns=10).report
    assert report.status == "exact", report.reasons
    assert any("33 % of the surface are curved like a dome and left out" in note for note in report.warnings)


def test_singularities_too_close_to_be_told_apart_count_as_one_of_their_common_index():
    data = {"kind": "asymptotic", "weierstrass": {"g": "z**3/3 - 1e-6*z"}, "x": [-0.5, 0.5], "y": [-0.5, 0.5]}
    report = made(data, columns=10).report
    assert report.status == "exact", report.reasons
    assert any("index -1" in note and "for 2 of them that are too close" in note for note in report.warnings)
    assert 0.5 < report.coverage < 1
    assert 0 < report.deviation.mean_amplitudes < 0.5


def test_deviation_is_coloured_from_the_report_of_a_pattern_with_a_polygon(monkey):
    found = deviation_again(monkey.structure, monkey.report)
    assert found is not None
    assert found.largest == pytest.approx(monkey.report.deviation.max_amplitudes)


def test_a_mesh_with_a_hole_where_its_singularity_would_be_is_pleated_beside_it(tmp_path):
    scattered(tmp_path / "saddle.ply", 0, hole=0.3)
    report = made({"kind": "asymptotic", "file": str(tmp_path / "saddle.ply")}, columns=9).report
    assert report.status == "exact", report.reasons
    assert 0 < report.coverage < 0.5
    assert not any("singularity" in note for note in report.warnings)


def test_the_helicoid_needs_no_singularity():
    data = {"kind": "asymptotic", "weierstrass": {"g": "exp(z)", "f": "i*exp(-z)"}, "x": [0.6, 1.5], "y": [-2, 2]}
    report = made(data, creases=6, columns=30).report
    assert report.status == "exact", report.reasons
    assert report.faces == report.vertices - 6 - report.vertices // 6 + 1


@pytest.mark.parametrize(("surface", "pattern", "sentence"), [
    ({"formula": "-x**2 - y**2"}, {}, "positive curvature over 100 %"),
    ({"formula": "3*(x**3 - 3*x*y**2)"}, {}, "twists too much"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"hub_size": 0.01, "width": 0.14}, "would be slivers; give pattern.hub_size"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"width": 2.0}, "give a smaller pattern.width"),
    ({"formula": "0.3*(x**2 - y**2)"}, {}, "straight"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"creases": 200, "columns": 40}, "25 of 28 columns are cut off"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"hub_size": 9.0}, "begin 9 from the singularity (pattern.hub_size)"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"reach": 100.0}, "legs of the singularities leave the surface after"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"reach": 0.05}, "end at 0.05 (pattern.reach)"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"amplitude": 50.0}, "pattern.amplitude is 50, but creases are 0.167 apart"),
    ({"formula": "0.3*(x**3 - 3*x*y**2)"}, {"width": 1e-6}, "specks on a surface"),
    ({"weierstrass": {"g": "z**2", "f": "0"}}, {}, "shrinks to a point"),
    ({"weierstrass": {"g": "exp(50*z)"}}, {}, "times more in one place than in another"),
])
def test_what_cannot_be_is_diagnosed_before_anything_is_solved(surface, pattern, sentence):
    report = made({"kind": "asymptotic", **surface}, **pattern).report
    assert report.status == "infeasible"
    assert len(report.reasons) == 1
    assert sentence in report.reasons[0]
    assert "solve" not in report.seconds


@pytest.mark.parametrize(("surface", "pattern", "sentence"), [
    ({}, {}, "need one surface, a file, a formula or weierstrass data, but none is given"),
    ({"formula": "x*y", "weierstrass": {"g": "z"}}, {}, "surface.formula and surface.weierstrass are given"),
    ({"formula": "x*y", "x": [1, -1]}, {}, "two rising numbers"),
    ({"formula": "x*y", "smoothing": 2}, {}, "surface.smoothing is for a mesh file"),
    ({"formula": "x*y", "family": 3}, {}, "surface.family.*give 1 or 2"),
    ({"formula": "x*y", "radius": 3}, {}, "surface.radius is not a key of a design; known here: file, formula"),
    ({"weierstrass": {"h": "z"}}, {}, "surface.weierstrass.h is not a key"),
    ({"formula": "x*y", "x": [-1, 1], "y": [-0.001, 0.001]}, {}, "a strip 0.002 wide and 2 long"),
    ({"formula": "x*y", "x": [0, 1e-14]}, {}, "give ranges more alike"),
    ({"formula": "x*y/(x - 0.123)"}, {}, "a pole, a jump or no value near x = 0.123"),
    ({"weierstrass": {"g": "z**2", "f": "1/(z - 0.0137)"}}, {}, r"weierstrass.f has a pole.*near z = 0.0137"),
    ({"weierstrass": {"g": "1/(z - 0.313 - 0.217*i)"}}, {}, r"weierstrass.g has a pole.*near z = 0.313\+0.217i"),
    ({"weierstrass": {"g": "log(z + 0.0011)"}}, {}, "weierstrass.g has a pole, a jump"),
    ({"formula": "x*y"}, {"creases": 1}, "pattern.creases.*from 2 to 200"),
    ({"formula": "x*y"}, {"hub_size": 2.0, "reach": 1.0}, "give a smaller hub_size"),
    ({"formula": "x*y"}, {"width": 1.0, "amplitude": 50.0}, "about half the width"),
    ({"formula": "x*y", "kind": "geodesic"}, {}, "surface"),
])
def test_mistakes_are_answered_in_a_sentence(surface, pattern, sentence):
    with pytest.raises(InvalidDesign, match=sentence):
        plisse.design({"surface": {"kind": "asymptotic", **surface}, "pattern": pattern})


def test_a_missing_mesh_is_one_sentence():
    with pytest.raises(InvalidMesh, match="there is no mesh file"):
        made({"kind": "asymptotic", "file": "nowhere.obj"})


def test_creases_beside_a_hole_are_not_kinked():
    result = made({**MONKEY, "hub": "cut"}, columns=64)
    assert result.report.status == "exact", result.report.reasons
    turns = []
    for crease in result.structure.topology.creases:
        sides = np.diff(result.structure.vertices[crease.vertices], axis=0)
        sines, cosines = np.linalg.norm(np.cross(sides[1:], sides[:-1]), axis=1), (sides[1:] * sides[:-1]).sum(axis=1)
        turns.append(np.arctan2(sines, cosines))
    assert np.degrees(np.concatenate(turns).max()) < 8  # where columns are twice as far apart; 60 without smoothing


def test_the_report_says_why_creases_end_before_the_boundary(monkey):
    result = made({"kind": "asymptotic", "formula": "x**3 - y**2", "x": [-0.5, 1]}, creases=6, columns=12)
    assert any(re.fullmatch(r"creases end: \d+ at the boundary, \d+ at a parabolic curve", note)
               for note in result.report.warnings)
    assert not any("creases end" in note for note in monkey.report.warnings)
