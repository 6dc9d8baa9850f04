"""Options of surface designs do what they say: guides of all kinds, directions, crops, sides, boundaries, principal."""

import numpy as np
import pytest

import plisse
from plisse.errors import InvalidDesign
from plisse.geometry.height_field import HeightField
from plisse.geometry.polyline import distance_to_polyline
from plisse.geometry.vectors import dot, unit

HILLS = {"height": "0.3*sin(x)*cos(0.8*y)", "x": [-3, 3], "y": [-2, 2]}
FIELD = HeightField(HILLS["height"], (-3, 3), (-2, 2))
GUIDE = {"guide": [[-2.8, 0, 0], [2.8, 0, 0]]}
SIZES = {"theta": 60, "width": 0.4, "amplitude": 0.2, "samples": 30}  # few large pleats: fast
ROOF = {"height": "-0.05*x**2-0.02*y**2", "x": [-3, 3], "y": [-2, 2], **GUIDE}


def made(surface, pattern=SIZES, **solve):
    """The result of a design that must become exact."""
    result = plisse.design({"surface": surface, "pattern": pattern, "solve": solve})
    assert result.status == "exact", result.report.reasons
    return result


@pytest.fixture(scope="module")
def along():
    return made({**HILLS, **GUIDE})


def test_a_plane_section_and_a_file_guide_the_same_creases_as_their_curve(tmp_path):
    across = {"guide_section": {"point": [0, 0.3, 0], "normal": [0, 1, 0]}}
    section = made({**HILLS, **across}, {**SIZES, "creases": 12})
    x = np.linspace(3, -3, 200)  # the section runs along n × normal
    np.savetxt(tmp_path / "line.csv", np.stack([x, 0 * x + 0.3, 0 * x], axis=1), delimiter=",")
    (tmp_path / "design.toml").write_text(
        '[surface]\nheight = "0.3*sin(x)*cos(0.8*y)"\nx = [-3, 3]\ny = [-2, 2]\nguide_file = "line.csv"\n'
        "[pattern]\ntheta = 60\nwidth = 0.4\namplitude = 0.2\nsamples = 30\ncreases = 12\n")
    file = plisse.design(tmp_path / "design.toml")
    assert file.status == "exact"
    # the section is a polygon on the mesh, the file is exact: a tenth of the amplitude lies between them
    assert np.abs(section.structure.vertices - file.structure.vertices).max() < 0.02


def test_a_boundary_loop_guides_a_closed_family():
    vase = {"radius": "1+0.2*sin(1.2*x)", "x": [-1, 1], "guide_boundary": 1, "directions": "orthogonal", "reach": 0.8}
    result = made(vase, {"theta": 60, "width": 0.3, "amplitude": 0.18, "samples": 16})
    creases = result.structure.vertices.reshape(-1, 16, 3)
    assert len(creases) % 2 == 0
    ends = creases[:, 0]
    # all creases begin on the loop, moved off along the surface by at most their amplitude
    assert np.abs(np.abs(ends[:, 2]) - 1).max() < 0.18
    assert np.ptp(np.unwrap(np.arctan2(ends[:, 1], ends[:, 0]))) > 5.5
    with pytest.raises(plisse.errors.InvalidDesign, match="2 boundary loops"):
        plisse.design({"surface": {**vase, "guide_boundary": 3}, "pattern": {"theta": 60, "width": 0.3, "amplitude": 0.2}})


def test_creases_leave_the_guide_at_the_angle_asked_for():
    plane = {"height": "0*x", "x": [-3, 3], "y": [-2, 2], **GUIDE}  # pseudo-geodesics of a plane are straight
    for directions, degrees in ((70, 70), ("orthogonal", 90), ("tuned", 90)):
        pattern = plisse.design({"surface": {**plane, "directions": directions}, "pattern": SIZES}).pattern
        run = unit(pattern.curves[:, -1] - pattern.curves[:, 0])
        assert np.degrees(np.arctan2(run[:, 1], run[:, 0])) == pytest.approx(np.full(len(run), degrees), abs=1e-6)


@pytest.mark.slow
def test_creases_around_a_point_keep_to_their_range_of_directions():
    result = made({**HILLS, "point": [0, 0, 0], "directions": [20, 160]}, {**SIZES, "creases": 10, "width": 0.3})
    guides = result.pattern.curves
    angle = np.degrees(np.arctan2(guides[..., 1], guides[..., 0]))
    assert angle[:, 0].min() > 0
    assert angle[:, 0].max() < 180
    assert not result.pattern.closed_family


def test_the_first_crease_lies_on_the_side_asked_for(along):
    above = made({**HILLS, **GUIDE, "side": "above"})
    for result, sign in ((along, -1), (above, 1)):
        first = result.structure.vertices.reshape(-1, 30, 3)[0]
        at = FIELD.project(first)
        assert (np.sign(dot(first - at.positions, at.normals)) == sign).all()


def test_the_side_of_whole_surfaces_can_be_chosen_as_well():
    surface = {"height": "12*sin(x/45)*cos(y/60)", "x": [-100, 100], "y": [-70, 70], "centre": [0, -420, 0]}
    field = HeightField(surface["height"], (-100, 100), (-70, 70))
    sides = {}
    for side in ("below", "above"):
        structure = made({**surface, "side": side}, {"width": 12}).structure
        lines = [structure.vertices[crease.vertices] for crease in structure.topology.creases if len(crease.vertices) > 12]
        lines.sort(key=lambda line: line[:, 1].mean())
        heights = [dot(line - (at := field.project(line)).positions, at.normals) for line in lines]
        sides[side] = np.sign([np.median(height) for height in heights])
        assert (sides[side][1:] == -sides[side][:-1]).all()
    np.testing.assert_array_equal(sides["above"], -sides["below"])


def test_the_boundary_is_kept_where_creases_shall_end_on_it(along):
    kept = made({**HILLS, **GUIDE, "boundary": True})
    ends = kept.structure.vertices.reshape(-1, 30, 3)[:, [0, -1], 1]
    assert np.abs(np.abs(ends) - 2).max() < 0.2  # an amplitude
    assert kept.report.coverage > along.report.coverage


@pytest.mark.slow
def test_outlines_hold_more_than_rectangles_and_stay_inside_when_asked(along):
    outline = made({**HILLS, **GUIDE, "crop": "outline"})
    inside = made({**HILLS, **GUIDE, "crop": "outline", "boundary": True})
    assert outline.report.coverage > along.report.coverage
    assert outline.report.coverage > inside.report.coverage
    assert np.abs(inside.structure.vertices[:, 1]).max() < 2.2
    assert outline.report.crease_deviation.max < 2.5
    assert outline.report.isometry < 1e-9


def test_principal_families_become_exact_where_gaps_are_even():
    result = made({**ROOF, "reach": 1.6}, principal=True)
    assert result.report.principal
    assert result.report.principal_defect.max < 1e-12
    assert result.report.crease_deviation.max < 0.5


@pytest.mark.slow
def test_principal_families_with_uneven_gaps_are_diagnosed():
    peak = {"height": "2*exp(-(x**2+y**2)/2)", "x": [-2, 2], "y": [-2, 2], "guide": [[-1.6, -0.3, 0], [1.6, 0.3, 0]]}
    result = plisse.design({"surface": peak, "pattern": {**SIZES, "width": 0.3, "amplitude": 0.22, "samples": 24},
                            "solve": {"principal": True}})
    assert result.status != "exact"
    assert "times as wide at one place as at another" in " ".join(result.report.reasons)


def test_whole_surfaces_become_principal_where_they_bend_evenly():
    surface = {"height": "12*sin(x/45)*cos(y/60)", "x": [-100, 100], "y": [-70, 70], "centre": [0, -420, 0]}
    result = made(surface, {"width": 12}, principal=True)
    assert result.report.principal
    assert result.report.principal_defect.max < 1e-12
    assert result.report.deviation.mean_amplitudes < 0.5


@pytest.mark.slow
def test_pleats_stay_upright_below_the_amplitude_that_the_report_names():
    sizes = {**SIZES, "theta": 25}
    limit = 0.4 * np.cos(np.radians(50)) / (2 * np.sin(np.radians(25)))
    upright = made({**ROOF, "reach": 1.6, "overhang": False}, {**sizes, "amplitude": 0.8 * limit})
    leaning = made({**ROOF, "reach": 1.6}, {**sizes, "amplitude": 1.2 * limit})
    assert not any("overhang" in warning for warning in upright.report.warnings)
    assert any(f"amplitude below {limit:.3g}" in warning for warning in leaning.report.warnings)


@pytest.mark.slow
def test_the_paper_method_runs_on_families_and_keeps_its_weights():
    result = plisse.design({"surface": {**HILLS, **GUIDE}, "pattern": SIZES,
                            "solve": {"method": "paper", "weights": [10, 1, 100, 1, 0], "iterations": 8}})
    assert result.report.method == "paper"
    assert result.report.iterations <= 8
    assert result.report.history[-1] < 0.5 * result.report.history[0]


@pytest.mark.slow
def test_more_samples_refine_a_whole_surface_without_changing_it():
    surface = {"height": "12*sin(x/45)*cos(y/60)", "x": [-100, 100], "y": [-70, 70], "centre": [0, -420, 0]}
    coarse, fine = made(surface, {"width": 12}), made(surface, {"width": 12, "samples": 100})
    assert fine.report.vertices > 3 * coarse.report.vertices
    assert fine.report.coverage == pytest.approx(coarse.report.coverage, abs=0.01)
    points = coarse.structure.vertices
    nearest = np.min([distance_to_polyline(points, fine.structure.vertices[crease.vertices])
                      for crease in fine.structure.topology.creases], axis=0)
    assert nearest.max() < 0.1 * 0.8 * 12


@pytest.mark.parametrize(("surface", "pattern", "says"), [
    (GUIDE, {"width": 1e-5}, r"about 1\.7e\+07 vertices.*250,000.*pattern\.width"),
    ({}, {"theta": 0.0, "width": 1e-5}, r"vertices, more than the 250,000"),
    ({"point": [0, 0, 0]}, {"width": 1e-6, "creases": 8}, "too near"),
    ({"guide": [[500, 0, 0], [502, 0, 0]]}, {}, r"surface\.guide is not on the surface: \(502, 0, 0\) lies 499"),
    ({"guide": [[-2, 2.5, 0], [2, 2.5, 0]]}, {}, r"the guide is not on the surface: it passes 0\.48 beside it"),
    ({"guide_boundary": 7}, {}, r"1 boundary loops, so there is no loop 7"),
])
def test_layouts_that_cannot_be_meant_are_refused_before_anything_is_traced(surface, pattern, says):
    sizes = {**SIZES, **pattern} if surface else pattern
    with pytest.raises(InvalidDesign, match=says):
        plisse.design({"surface": {**HILLS, **surface}, "pattern": sizes})


def test_little_coverage_is_said_with_what_would_cover_more(along):
    assert along.report.coverage < 0.9
    (said,) = [text for text in along.report.warnings if text.startswith("only ")]
    assert f"{100 * along.report.coverage:.0f} % of the surface" in said
    assert "crop" in said
    assert "reach" not in said  # none was given


def test_outlines_count_their_holes():
    assert made({**HILLS, **GUIDE, "crop": "outline"}).report.holes == 0
