"""Explicit designs: exact without a solver, the same at every resolution, and honest about strips that die."""

import numpy as np
import pytest

import plisse
from plisse.errors import InvalidDesign
from plisse.geometry.vectors import norm
from plisse.measure.folds import fold_angles
from plisse.recipe import March
from plisse.structure.exact import alternating_cones

ARC = {"kind": "arc", "radius": 100, "angle": 120}
HELIX = {"kind": "helix", "radius": 80, "pitch": 160, "turns": 0.6}
GENTLE = {"kind": "helix", "radius": 100, "pitch": 60, "turns": 0.2}
SPLINE = {"kind": "spline", "points": [[0, 0, 0], [30, 40, 4], [80, 60, 8], [140, 50, 16], [180, 5, 20]]}


def marched(curve, **numbers):
    return plisse.design({"curve": curve, "march": {"creases": 7, "distance": 8, "samples": 41, **numbers}})


@pytest.mark.parametrize("curve, numbers", [
    (ARC, {}), (HELIX, {"opening": 70}), (SPLINE, {"distance": 4}), (ARC, {"direction": 1.5, "fold": 70}),
    (HELIX, {"distance": [6, 7, 8, 9, 8, 7], "fold": [80, 80, 90, 90, 90, 80, 80], "seed": 2}),
    (HELIX, {"distance": [[0, 5], [0.5, 9], [1, 5]], "direction": [[0, -1], [1, 1]]}),
    ({"kind": "ellipse", "a": 100, "b": 70}, {}), (ARC | {"angle": 360, "closed": True}, {"distance": [5, 6, 7, 8, 7, 6]}),
    ({"kind": "arc", "radius": 100, "angle": 90}, {"samples": 9, "turn": 4}),
])
def test_marched_structures_are_exact_and_principal(curve, numbers):
    report = marched(curve, **numbers).report
    assert report.status == "exact", report.reasons
    assert report.principal
    assert report.method == "march"
    assert max(report.planarity.max, report.angle_defect.max, report.principal_defect.max) < 1e-11


def test_an_arc_becomes_cones_of_equal_slope():
    structure = marched(ARC, opening=90).structure
    rows = structure.vertices.reshape(7, -1, 3)
    step = np.radians(120) / 40
    # the slope of rulings whose creases fold by 90°: 2 atan(slope / cos(δ/2))
    slope = np.cos(step / 2)
    width = 8 / np.hypot(1, slope)
    inner = np.hypot(rows[0, 0, 0], rows[0, 0, 1])
    cones = alternating_cones(7, 41, radius=inner, width=width, slope=slope, sector=np.radians(120))
    pairs = np.random.default_rng(0).integers(0, len(cones.vertices), (2, 400))
    # row 0 is high where the middle one is low; distances know nothing of that
    own, other = (norm(v[pairs[0]] - v[pairs[1]]) for v in (structure.vertices, cones.vertices))
    assert np.abs(own - other).max() < 1e-7  # the seed is a polynomial series, 1e-9 of its length from the arc


def test_numbers_mean_what_they_say():
    fold = [70.0, 75, 80, 85, 80, 75, 70]
    distance = [5.0, 6, 7, 8, 7, 6]
    structure = marched(GENTLE, fold=fold, distance=distance, opening=95, seed=4).structure
    folds = np.degrees(fold_angles(structure.topology, structure.vertices))
    edges = structure.topology.edges
    rows = np.array([crease.vertices for crease in structure.topology.creases])
    signs = []
    for number, row in enumerate(rows[1:-1], start=1):
        own = folds[edges.is_crease & np.isin(edges.vertices, row).all(axis=1)]
        wanted = 85 if number == 3 else fold[number]
        assert np.abs(np.abs(own) - wanted).max() < 1e-8
        signs.append(np.sign(own[0]))
    assert signs == [signs[0], -signs[0]] * 2 + [signs[0]]
    middle = structure.vertices[rows[:, 20]]
    assert np.abs(norm(np.diff(middle, axis=0)) - distance).max() < 1e-9


def test_the_shape_does_not_depend_on_the_resolution():
    """Creases converge of second order: every crease is a polygon with vertices near one curve."""
    middles, errors = [], []
    for samples in (21, 41, 81, 161, 641):
        rows = marched(GENTLE, samples=samples, opening=80, fold=95).structure.vertices.reshape(7, samples, 3)
        middles.append(rows[:, ::(samples - 1) // 20])
    for coarse in middles[:-1]:
        errors.append(np.abs(coarse - middles[-1]).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 1.8).all()
    assert errors[-1] < 2e-2


def test_a_symmetric_design_is_symmetric():
    """An arc is symmetric about the x axis, and so is everything that marches parallel to it."""
    rows = marched(ARC, fold=[[0, 60], [1, 110]], distance=[[0, 6], [1, 9]]).structure.vertices.reshape(7, 41, 3)
    assert np.abs(rows[:, ::-1] * [1, -1, 1] - rows).max() < 1e-9


def test_turning_creases_open_like_a_fan():
    rows = marched(ARC, direction=2.0, creases=5).structure.vertices.reshape(5, 41, 3)
    widths = norm(np.diff(rows, axis=0))
    assert (np.diff(widths, axis=1) > 0).all()


def test_even_numbers_of_samples_become_odd_and_the_report_says_so():
    report = marched(ARC, samples=40).report
    assert report.vertices == 7 * 41
    assert "from 40 to 41" in report.warnings[0]


def test_the_family_ends_where_rulings_meet_and_the_rest_is_exact():
    """Cones inside an arc of radius 30 run into their common axis after 30 / (8 sin 45°) = 5.3 strips."""
    result = marched({"kind": "arc", "radius": 30, "angle": 120}, creases=13)
    assert result.status == "exact"
    assert result.report.vertices == (5 + 1 + 6) * 41
    assert result.report.warnings == ["the structure ends before crease 1 of the design, because the rulings meet before "
                                      "the crease"]


def test_strips_that_die_at_their_ends_shorten_the_structure_and_the_report_says_where():
    result = marched(HELIX, creases=21, opening=80, fold=[[0, 60], [0.5, 100], [1, 60]],
                     distance=[[0, 5], [0.5, 9], [1, 5]], samples=81)
    assert result.status == "exact"
    assert result.report.vertices < 21 * 81
    assert any("on the structure begins at" in warning for warning in result.report.warnings)
    structure = result.structure
    assert structure.topology.components == 1
    assert structure.topology.euler_characteristic == 1
    creases = [len(crease.vertices) for crease in structure.topology.creases]
    assert max(creases) == 81
    assert creases[0] < 81


def test_what_is_left_does_not_feel_what_died():
    """The middle of a structure whose ends die is that of a design which never goes there."""
    numbers = {"opening": 95, "fold": 75, "distance": 8, "samples": 81}
    short, long = (marched(GENTLE, creases=creases, **numbers) for creases in (9, 41))
    assert len(long.report.warnings) > 1
    own = short.structure.vertices.reshape(9, 81, 3)[:, 40]
    distances = norm(own[:, None] - long.structure.vertices[None]).min(axis=1)
    assert distances.max() < 1e-9


def test_a_march_that_comes_to_nothing_is_infeasible_with_its_reason():
    result = marched({"kind": "arc", "radius": 5, "angle": 120}, distance=45, creases=3, direction=80)
    assert result.status == "infeasible"
    assert "fewer than three creases remain" in result.report.reasons[0]


@pytest.mark.parametrize("section, message", [
    ({"seed": 9}, "march.seed is 9, but march.creases is 7"),
    ({"distance": [5, 5]}, "march.distance has 2 values, but there are 6 strips"),
    ({"fold": [80, 80]}, "march.fold has 2 values, but there are 7 creases"),
    ({"distance": [[0, 5], 6]}, "mixes"),
    ({"distance": [[0, 5], [0, 6]]}, "increasing order"),
    ({"fold": [[0, 5], [1, 190]]}, r"march.fold\[1\]"),
    ({"distance": -5}, "march.distance is -5; give one length from 1e-9 to 1e9 model units, one per strip"),
    ({"distance": [[0, 5], [1, -5]]}, r"march.distance\[1\] is \[1.0, -5.0\]; .* distance from 1e-9 to 1e9"),
    ({"distance": 1e6}, "is 1e.06, but the curve measures 200 model units; give a length between 0.002 and 2000"),
    ({"distance": [5, 5, 5, 5, 1e6, 5]}, r"march.distance\[4\] is 1e.06"),
    ({"samples": 100_000}, "march.samples"),
    ({"opening": 180}, "degrees between 2 and 178"),
    ({"creases": 500, "samples": 5000}, "march.creases × march.samples"),
    ({"thickness": 3}, "march.thickness is not a key"),
])
def test_contradictions_are_one_sentence(section, message):
    with pytest.raises(InvalidDesign, match=message):
        marched(ARC, **section)


@pytest.mark.parametrize("design, message", [
    ({"march": {"creases": 5, "distance": 4}}, "curve is missing"),
    ({"curve": ARC, "march": {"creases": 5, "distance": 4}, "pattern": {"creases": 5, "width": 3, "amplitude": 2}},
     "take no .pattern."),
    ({"closed_form": {"kind": "miura"}, "march": {"creases": 5, "distance": 4}}, "has both"),
    ({"curve": ARC | {"angle": 360, "closed": True}, "march": {"creases": 5, "distance": 4, "turn": 3}}, "do not close"),
])
def test_sections_that_do_not_go_together_are_refused(design, message):
    with pytest.raises(InvalidDesign, match=message):
        plisse.design(design)


def test_every_key_of_a_march_survives_a_report():
    given = {"creases": 7, "distance": [[0.0, 5.0], [1.0, 6.0]], "direction": 1.0, "fold": [80.0] * 7, "opening": 95.0,
             "turn": 0.0, "seed": 3, "samples": 41}
    assert set(given) == set(March.__struct_fields__)
    assert marched(ARC, **given).report.design["march"] == given
