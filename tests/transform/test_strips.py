"""Rectifying strips: cylinders under helices and circles, straight when flat, planar, closed as solids."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from plisse.assess_strips import assess_strips
from plisse.errors import Infeasible, InvalidStructure
from plisse.geometry.formulas import Sphere
from plisse.geometry.height_field import HeightField
from plisse.layout.guides import Guide, guide_through
from plisse.measure.planarity import planarity_defect
from plisse.solve.flatten import flatten
from plisse.structure.exact import alternating_cones, conic_creases
from plisse.transform.arrangement import Lane, arranged, strips_along_creases, strips_along_rows
from plisse.transform.strip_lanes import lanes_on_surface
from plisse.transform.strip_solids import strip_solid
from plisse.transform.strips import rectifying_strip


def helix(count=160, radius=10.0, rise=3.0, turns=2.0):
    t = np.linspace(0, 2 * np.pi * turns, count)
    return np.stack([radius * np.cos(t), radius * np.sin(t), rise * t], axis=1)


def circle(count, radius=5.0):
    t = 2 * np.pi * np.arange(count) / count
    return np.stack([radius * np.cos(t), radius * np.sin(t), 0 * t], axis=1)


def wave(count, bend, twist):
    t = np.linspace(-1, 1, count)
    return np.stack([10 * np.sin(t), 10 * np.cos(t) + bend * t**3, twist * (t + 0.3 * t**2)], axis=1)


def require_straight(strip, tolerance=1e-9):
    """Laid flat face by face from its shape in space, both edges and the curve are straight and parallel."""
    flat = flatten(strip.structure).development
    rows = flat.reshape(-1, len(strip.points), 2)
    steps = np.diff(rows, axis=1)
    angles = np.arctan2(steps[..., 1], steps[..., 0])
    assert np.abs(angles - angles.mean()).max() < tolerance
    assert planarity_defect(strip.structure.topology, strip.structure.vertices).max() < 1e-12


def test_the_rectifying_developable_of_a_helix_is_its_cylinder():
    strip = rectifying_strip(helix(), 4.0)
    assert np.abs(strip.rulings - [0, 0, 1]).max() < 1e-9
    for across in (-2.0, 2.0):
        x, y, _ = strip.row(across).T
        assert np.hypot(x, y) == pytest.approx(10, abs=1e-9)
    require_straight(strip)


@pytest.mark.parametrize("count", [40, 41])
def test_the_rectifying_developable_of_a_circle_is_a_closed_cylinder(count):
    strip = rectifying_strip(circle(count), 2.0, closed=True)
    assert strip.closed
    assert np.abs(np.abs(strip.rulings[:, 2]) - 1).max() < 1e-12
    assert strip.points[0] == pytest.approx(strip.points[-1])
    assert strip.length == pytest.approx(count * 10 * np.sin(np.pi / count), rel=1e-12)
    require_straight(strip)


def test_over_a_flat_curve_with_an_inflection_the_strip_stands_upright():
    t = np.linspace(-2, 2, 121)
    strip = rectifying_strip(np.stack([t, np.sin(1.5 * t), 0 * t], axis=1), 0.5)
    assert np.abs(np.abs(strip.rulings[:, 2]) - 1).max() < 1e-9
    require_straight(strip)


@settings(max_examples=25, deadline=None)
@given(bend=st.floats(-2, 2), twist=st.floats(-3, 3), count=st.integers(20, 120), width=st.floats(0.2, 3))
def test_every_strip_unfolds_straight(bend, twist, count, width):
    strip = rectifying_strip(wave(count, bend, twist), width)
    assert np.abs(strip.straightness_defect).max() < 1e-12
    assert strip.width <= width * (1 + 1e-12)
    require_straight(strip)


def test_the_strip_converges_to_the_smooth_one_with_second_order():
    """Rulings of the smooth developable have the direction τ e1 + κ e3."""
    errors = []
    for count in (41, 81, 161):
        t = np.linspace(-1, 1, count)
        points = np.stack([t, t**2, 0.4 * t**3], axis=1)
        strip = rectifying_strip(points, 0.05)
        velocity, bend = np.stack([1 + 0 * t, 2 * t, 1.2 * t**2], axis=1), np.stack([0 * t, 2 + 0 * t, 2.4 * t], axis=1)
        jerk = np.stack([0 * t, 0 * t, 2.4 + 0 * t], axis=1)
        binormal = np.cross(velocity, bend)
        size = np.linalg.norm(binormal, axis=1)
        torsion, curvature = (binormal * jerk).sum(axis=1) / size**2, size / np.linalg.norm(velocity, axis=1) ** 3
        darboux = (torsion[:, None] * velocity / np.linalg.norm(velocity, axis=1)[:, None]
                   + curvature[:, None] * binormal / size[:, None])
        darboux /= np.linalg.norm(darboux, axis=1)[:, None]
        errors.append(np.linalg.norm(np.cross(strip.rulings, darboux), axis=1)[count // 8:-count // 8].max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.min() > 1.7


@pytest.mark.parametrize(("side", "low", "high"), [("both", -1, 1), ("above", 0, 2), ("below", -2, 0)])
def test_strips_lie_on_the_side_asked_for(side, low, high):
    strip = rectifying_strip(helix(), 2.0, side=side)
    assert (strip.low, strip.high) == (low, high)
    assert strip.structure.topology.vertex_count == len(strip.points) * (3 if side == "both" else 2)
    require_straight(strip)


def test_where_rulings_meet_a_strip_is_narrowed_and_says_where():
    t = np.linspace(0, 1, 120)
    points = np.stack([10 * np.cos(2 * t), 10 * np.sin(2 * t), 8 * np.sin(5 * t)], axis=1)
    strip = rectifying_strip(points, 8.0)
    assert strip.width < 8 or strip.length < rectifying_strip(points, 0.05).length
    assert any("rulings meet near" in note for note in strip.notes)
    along = np.diff(strip.points, axis=0)
    for across in (strip.low, strip.high):
        assert (np.diff(strip.row(across), axis=0) * along).sum(axis=1).min() > 0
    require_straight(strip)


def test_what_is_no_curve_for_a_strip_is_said():
    with pytest.raises(Infeasible, match="straight"):
        rectifying_strip(np.outer(np.arange(20.0), [1, 2, 3]), 1.0)
    with pytest.raises(InvalidStructure, match="at least 8"):
        rectifying_strip(helix(5), 1.0)
    with pytest.raises(InvalidStructure, match="same"):
        rectifying_strip(helix()[[0, 0, *range(1, 20)]], 1.0)
    with pytest.raises(InvalidStructure, match="width"):
        rectifying_strip(helix(), -1.0)


@pytest.mark.parametrize("points", [helix(), wave(80, 1.0, 2.0)], ids=["helix", "wave"])
def test_solids_are_watertight_and_oriented_and_of_the_right_volume(points):
    strip = rectifying_strip(points, 3.0)
    solid = strip_solid(strip, 0.4)
    mesh = trimesh.Trimesh(solid.vertices, solid.triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(strip.length * strip.width * 0.4, rel=2e-3)  # bends count at second order


def test_sides_of_solids_are_planar_and_at_half_the_thickness():
    strip = rectifying_strip(wave(60, 1.0, 2.0), 3.0)
    solid = strip_solid(strip, 0.6)
    count = len(strip.normals)
    sides = np.concatenate([solid.quads[:count], solid.quads[2 * count:3 * count]])
    a, b, c, d = (solid.vertices[sides[:, k]] for k in range(4))
    volume = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)
    assert np.abs(volume).max() < 1e-12
    top = solid.vertices[2 * len(strip.points):3 * len(strip.points)]
    height = ((top[:-1] - strip.points[:-1]) * strip.normals).sum(axis=1)
    assert height == pytest.approx(0.3, abs=1e-12)
    with pytest.raises(Infeasible, match="too sharply"):
        strip_solid(strip, 60.0)


def test_strips_on_a_sphere_are_cylinders_at_a_constant_angle():
    """Pseudo-geodesics of inclination θ are circles of radius R sin θ (Fig. 13); their strips stand at 90° − θ."""
    sphere = Sphere(2.0)
    t = np.linspace(-0.5, 0.5, 60)
    guide = Guide(2.0 * np.stack([np.sin(t), 0 * t, np.cos(t)], axis=1))
    lanes = lanes_on_surface(sphere, guide, theta=np.radians(50), spacing=0.4, samples=161)
    found = arranged(lanes, 0.2)
    assert len(found.strips) == 5
    for strip, inclination in zip(found.strips, found.inclinations, strict=True):
        assert strip.closed
        spread = np.ptp(strip.rulings, axis=0).max()
        assert spread < 1e-4  # the traced circle is one to the accuracy of its spline
        assert strip.length == pytest.approx(2 * np.pi * 2 * np.sin(np.radians(50)), rel=1e-3)  # a polygon of 161
        assert np.degrees(inclination) == pytest.approx(40, abs=0.02)  # normals at the middles of chords


def test_pseudo_geodesics_on_a_formula_surface_stand_at_their_angle():
    field = HeightField("0.4*(x**2-y**2)", (-1, 1), (-1, 1))
    guide = guide_through(field, [[-0.8, 0, 0], [0.8, 0, 0]])
    found = arranged(lanes_on_surface(field, guide, theta=np.radians(55), spacing=0.2), 0.08)
    assert len(found.strips) == round(guide.length / 0.2)
    for inclination in found.inclinations:
        assert np.degrees(inclination) == pytest.approx(35, abs=0.1)  # second order in the distance of points


def test_strips_along_circular_creases_are_upright_cylinders():
    cones = alternating_cones(5, 40, radius=2.0, width=0.2, slope=0.8)
    found = strips_along_creases(cones, 0.1)
    assert found.numbers == (1, 2, 3, 4, 5)
    assert found.inclinations[0] is None
    for strip, inclination in list(zip(found.strips, found.inclinations, strict=True))[1:-1]:
        assert np.abs(np.abs(strip.rulings[:, 2]) - 1).max() < 1e-9
        assert np.degrees(inclination) == pytest.approx(90, abs=0.5)  # the mid-surface of upright pleats is level


def test_strips_along_principal_creases_bisect_the_faces():
    """Faces lie symmetric to the rectifying developable of the crease between them (§2.4)."""
    structure = conic_creases(5, 40)
    strip = structure.strips(0.02, creases=[2]).strips[0]
    crease = structure.topology.creases[2].vertices
    edges = np.diff(structure.vertices[crease], axis=0)
    edges /= np.linalg.norm(edges, axis=1)[:, None]
    sides = []
    for other in (1, 3):
        inward = structure.vertices[structure.topology.creases[other].vertices[:-1]] - structure.vertices[crease[:-1]]
        inward = inward - (inward * edges).sum(axis=1)[:, None] * edges
        sides.append(inward / np.linalg.norm(inward, axis=1)[:, None])
    bisector = sides[0] + sides[1]
    bisector /= np.linalg.norm(bisector, axis=1)[:, None]
    # the free constant of the strip is chosen without its alternating part, the crease's own is chosen by its faces
    assert np.abs((bisector * strip.normals).sum(axis=1)).max() < 1e-3


def test_strips_are_numbered_like_their_curves_and_lie_apart_on_the_sheet():
    straight = Lane(np.outer(np.arange(30.0), [1, 0, 0]))
    found = arranged([Lane(helix()), straight, Lane(wave(60, 1, 1))], 2.0)
    assert found.numbers == (1, 3)
    assert "strip 2 was left out" in found.lost[0]
    report = assess_strips(found)
    assert report.status == "approximate"
    assert report.reasons == list(found.lost)
    structure = found.structure
    assert structure.topology.components == 2
    first = structure.topology.vertex_count - found.strips[1].structure.topology.vertex_count
    one, two = structure.development[:first], structure.development[first:]
    assert one[:, 1].min() > two[:, 1].max()
    with pytest.raises(Infeasible, match="straight"):
        arranged([straight], 2.0)


def test_rows_of_a_pattern_bring_their_surface():
    angle, radius = np.linspace(0, 1.5, 60), np.array([3.0, 2.8, 2.6, 2.4])
    curves = np.stack([np.outer(radius, np.cos(angle)), np.outer(radius, np.sin(angle)), np.zeros((4, 60))], axis=-1)
    binormals = np.broadcast_to([0.0, 0.0, 1.0], curves.shape)
    found = strips_along_rows(curves, binormals, 0.1)
    for inclination in found.inclinations:
        assert np.degrees(inclination) == pytest.approx(90, abs=1e-6)
