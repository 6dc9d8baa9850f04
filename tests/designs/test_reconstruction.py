"""Reconstruction end to end: a surface section becomes an exact structure over (nearly) the whole surface."""

import json

import numpy as np
import pytest
import trimesh

import plisse
from plisse.cli import main
from plisse.errors import InvalidDesign
from plisse.geometry.height_field import HeightField
from plisse.io.designs import design_from_dict, read_design

HEIGHT = {"surface": {"height": "12*sin(x/45)*cos(y/60)", "x": [-100, 100], "y": [-70, 70], "centre": [0, -420, 0]},
          "pattern": {"width": 9}}


@pytest.fixture(scope="module")
def roof():
    return plisse.design(HEIGHT)


def test_a_height_alone_becomes_exact_over_nearly_all_its_area(roof):
    report = roof.report
    assert report.status == "exact", report.reasons
    assert report.coverage > 0.97
    assert report.deviation.mean_amplitudes < 0.5
    assert report.deviation.mean == pytest.approx(report.deviation.mean_amplitudes * 0.8 * 9, rel=1e-9)
    assert report.opening_angle_deg.min >= 15
    assert report.isometry < 1e-10


def test_the_structure_lies_over_the_surface_by_an_independent_count(roof):
    """Middles of faces against the formula, vertical distances, no code of plisse."""
    vertices, quads = roof.structure.vertices, roof.structure.topology.quads
    middles = vertices[quads].mean(axis=1)
    inside = (np.abs(middles[:, 0]) < 100) & (np.abs(middles[:, 1]) < 70)
    x, y, z = middles[inside].T
    assert np.abs(z - 12 * np.sin(x / 45) * np.cos(y / 60)).mean() < 0.5 * 0.8 * 9
    columns, rows = np.meshgrid(np.linspace(-97, 97, 40), np.linspace(-67, 67, 30))
    points = np.stack([columns.ravel(), rows.ravel()], axis=1)
    covered = np.zeros(len(points), bool)
    for quad in vertices[quads][:, :, :2]:
        side = np.roll(quad, -1, axis=0) - quad
        turn = [s[0] * (points[:, 1] - q[1]) - s[1] * (points[:, 0] - q[0]) for q, s in zip(quad, side, strict=True)]
        covered |= (np.min(turn, axis=0) > 0) | (np.max(turn, axis=0) < 0)
    assert covered.mean() > 0.97


def test_inclinations_are_reported_along_every_inner_crease(roof):
    inclinations = roof.report.inclination_deg
    assert len(inclinations) >= 10
    assert all(-90 < entry.min <= entry.max < 90 for entry in inclinations)


@pytest.mark.slow
def test_a_mesh_file_beside_the_design_gives_the_same_as_its_formula(tmp_path, roof):
    mesh = HeightField(HEIGHT["surface"]["height"], (-100, 100), (-70, 70)).mesh(60)
    trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).export(tmp_path / "roof.obj")
    (tmp_path / "roof.toml").write_text('[surface]\nfile = "roof.obj"\ncentre = [0, -420, 0]\n[pattern]\nwidth = 9\n')
    assert main(["make", str(tmp_path / "roof.toml"), "-o", str(tmp_path / "out"), "--quiet"]) == 0
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert report["status"] == "exact"
    assert report["coverage"] == pytest.approx(roof.report.coverage, abs=0.02)
    assert (tmp_path / "out" / "structure.fold").exists()


@pytest.mark.parametrize(("surface", "expected"), [
    ({}, "neither"),
    ({"file": "a.obj", "height": "x"}, "both"),
    ({"height": "x", "x": [3, 1]}, "rising"),
    ({"height": "__import__('os').system('true')"}, "height"),
    ({"file": "nowhere.obj"}, "nowhere.obj"),
    ({"hight": "x"}, "surface.hight is not a key"),
])
def test_bad_surface_sections_are_one_sentence(surface, expected):
    with pytest.raises(InvalidDesign, match=expected) as caught:
        plisse.design({"surface": surface})
    assert "\n" not in str(caught.value)


def test_the_mesh_is_found_relative_to_the_design(tmp_path):
    (tmp_path / "a.toml").write_text('[surface]\nfile = "mesh/roof.obj"\n')
    assert read_design(tmp_path / "a.toml").surface.file == str(tmp_path / "mesh" / "roof.obj")
    assert design_from_dict({"surface": {"file": "roof.obj"}}).surface.file == "roof.obj"


def test_an_edited_file_with_the_same_faces_is_followed(tmp_path, roof):
    mesh = HeightField(HEIGHT["surface"]["height"], (-100, 100), (-70, 70)).mesh(60)
    square = mesh.vertices[:, :1] ** 2 + mesh.vertices[:, 1:2] ** 2
    lifted = mesh.vertices + np.array([0, 0, 20.0]) * np.exp(-square / 8000)
    for name, vertices in (("a.obj", mesh.vertices), ("b.obj", lifted)):
        trimesh.Trimesh(vertices, mesh.triangles, process=False).export(tmp_path / name)
    trimesh.Trimesh(mesh.vertices, mesh.triangles[:-1], process=False).export(tmp_path / "c.obj")
    text = '[surface]\nfile = "a.obj"\nedited_file = "{}.obj"\ncentre = [0, -420, 0]\n[pattern]\nwidth = 9\n'
    (tmp_path / "b.toml").write_text(text.format("b"))
    (tmp_path / "c.toml").write_text(text.format("c"))
    result = plisse.design(tmp_path / "b.toml")
    assert result.status == "exact"
    assert result.report.deviation.mean_amplitudes < 0.5
    middles = result.structure.vertices[result.structure.topology.quads].mean(axis=1)
    x, y, z = middles[np.hypot(middles[:, 0], middles[:, 1]) < 40].T
    before = 12 * np.sin(x / 45) * np.cos(y / 60)
    lift = 20 * np.exp(-(x**2 + y**2) / 8000)
    assert np.abs(z - before - lift).mean() < 0.5 * np.abs(z - before).mean()
    with pytest.raises(InvalidDesign, match="faces that are not"):
        plisse.design(tmp_path / "c.toml")


def test_the_reported_design_holds_what_was_chosen_and_leads_there_again(roof):
    chosen, design = roof.report.layout, roof.report.design
    assert design["pattern"]["width"] == chosen.width
    assert design["pattern"]["amplitude"] == chosen.amplitude
    assert design["surface"]["centre"] == HEIGHT["surface"]["centre"]
    np.testing.assert_allclose(chosen.centre, design["surface"]["centre"], atol=1e-9)
    again = plisse.design(design)
    assert again.report.coverage > roof.report.coverage - 0.005
    assert again.report.layout == chosen
