"""Designs along asymptotic curves, from the recipe to files that others can check."""

import json

import numpy as np
import pytest
import trimesh
from scipy.spatial import Delaunay

import plisse
from plisse.cli import main
from plisse.errors import InvalidDesign, InvalidMesh
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


def scattered(path, noise, count=1100, seed=5):
    """A saddle that is not harmonic, as a mesh of scattered vertices with noise."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-0.95, 0.95, (count, 2))
    places = places[np.hypot(*places.T) < 0.95]
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
