"""Families of constant inclination: exact gaps on cylinders, turned circles on spheres, rectangles, closed families."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.formulas import Cone, Cylinder, HeightField, Sphere, Torus
from plisse.geometry.polyline import distance_to_polyline
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.crossing import trajectories
from plisse.layout.family import Family, fan, shoot
from plisse.layout.family_columns import pattern_of
from plisse.layout.guides import Guide, boundary_guide, guide_through, section_guide
from plisse.layout.positions import crease_positions
from plisse.layout.stops import Stop, Trace
from plisse.measure.mid_surface import mid_surface_deviation
from plisse.measure.sectors import angle_defect
from plisse.solve.attempt import Start
from plisse.solve.portfolio import GENERAL, SECOND_CHANCE, solve
from plisse.solve.zigzag import zigzag, zigzag_curves

HILLS = HeightField("0.3*sin(x)*cos(0.8*y)", (-3, 3), (-2, 2))
ACROSS = [[-2.8, 0, 0], [2.8, 0, 0]]
THETA = np.radians(60)


def guided_pattern(surface, guide, *, theta, width, amplitude, creases=None, samples=60, closed=False, **options):
    """The pattern of a family along a guide, or along points."""
    guide = guide if isinstance(guide, Guide) else guide_through(surface, guide, closed)
    family = shoot(surface, guide, theta=np.radians(theta), width=width, amplitude=amplitude, creases=creases, **options)
    return pattern_of(family, surface, amplitude, samples, crop=creases is None)


def ring(radius, height=0.0, count=120):
    turn = 2 * np.pi / count * np.arange(count)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(count, height)], axis=1)


def test_strips_mirror_at_the_guide():
    positions, spacing = crease_positions(10.0, False, theta=THETA, width=0.5, amplitude=0.3)
    assert np.diff(positions) == pytest.approx(spacing)
    assert 1 / spacing[1] - 1 / spacing[0] == pytest.approx(np.sin(THETA) / 0.3)
    assert positions[0] == pytest.approx(10.0 - positions[-1])
    assert positions[0] < spacing[1]


def test_closed_guides_take_an_even_number_of_creases_that_fit_exactly():
    positions, spacing = crease_positions(10.0, True, theta=THETA, width=0.5, amplitude=0.3)
    assert len(positions) % 2 == 0
    assert spacing.sum() == pytest.approx(10.0)
    assert 1 / spacing[1::2] - 1 / spacing[::2] == pytest.approx(np.sin(THETA) / 0.3)
    with pytest.raises(Infeasible, match="even number"):
        crease_positions(10.0, True, theta=THETA, width=0.5, amplitude=0.3, creases=7)


def test_a_guide_that_is_too_short_says_how_many_creases_it_has_room_for():
    with pytest.raises(Infeasible, match=r"room for (\d+) creases, not for 40") as error:
        crease_positions(10.0, False, theta=THETA, width=0.5, amplitude=0.3, creases=40)
    fits = int(str(error.value).split("room for ")[1].split()[0])
    crease_positions(10.0, False, theta=THETA, width=0.5, amplitude=0.3, creases=fits)
    with pytest.raises(Infeasible):
        crease_positions(10.0, False, theta=THETA, width=0.5, amplitude=0.3, creases=fits + 1)


def test_sphere_families_are_one_circle_turned_about_the_axis_of_the_guide():
    sphere = Sphere(2.0)
    equator = guide_through(sphere, ring(2.0), closed=True)
    family = shoot(sphere, equator, theta=THETA, width=0.2, amplitude=0.1, creases=20)
    assert family.closed_curves
    assert np.array([curve.length for curve in family.curves]) == pytest.approx(4 * np.pi * np.sin(THETA), rel=1e-3)
    turn = 2 * np.pi * np.cumsum(family.spacing) / equator.length
    for curve, angle in zip(family.curves[1:], turn, strict=False):
        turned = Rotation.from_rotvec([0, 0, angle]).apply(family.curves[0].points)
        assert distance_to_polyline(curve.points, turned, True).max() < 1e-5  # fourth order in the step


def test_tuning_leaves_a_family_with_rotational_symmetry_symmetric():
    torus = Torus(3.0, 1.0)
    family = shoot(torus, guide_through(torus, ring(4.0), closed=True), theta=THETA, width=0.4, amplitude=0.25, creases=12,
                   length=0.8)
    assert np.ptp(family.turns) < 1e-3


@pytest.mark.parametrize("degrees", [45, 60, 75])
def test_cylinder_families_across_a_generator_keep_their_gaps_exactly(degrees):
    """Curves across a generator are copies of each other, moved along it: gaps along the generators never change."""
    cylinder = Cylinder(1.0, 8.0)
    family = shoot(cylinder, guide_through(cylinder, [[1, 0, -2.0], [1, 0, 2.0]]), theta=np.radians(degrees), width=0.3,
                   amplitude=0.2, creases=9, length=0.8, tuned=False)
    at = np.linspace(-0.7, 0.7, 15)
    points = np.stack([spline(at) for spline in family.splines])
    assert norm(np.diff(points, axis=0)) == pytest.approx(np.broadcast_to(family.spacing[:, None], (8, 15)), abs=1e-7)


def test_directions_are_tuned_for_even_gaps_within_twelve_degrees():
    slanted = HeightField("0.3*sin(x + 0.8*y) + 0.1*y**2", (-3, 3), (-2, 2))
    guide = guide_through(slanted, ACROSS)
    families = [shoot(slanted, guide, theta=THETA, width=0.25, amplitude=0.12, creases=20, tuned=tuned)
                for tuned in (False, True)]
    spreads = []
    for family in families:
        middle = np.linspace(-1.5, 1.5, 9)
        relative = trajectories(family, 10, middle).gaps / family.spacing[:, None]
        spreads.append(np.nanstd(relative))
    assert spreads[1] < 0.9 * spreads[0]
    assert np.degrees(np.abs(families[1].turns).max()) <= 12.001


def test_columns_are_orthogonal_trajectories_of_the_family():
    family = shoot(HILLS, guide_through(HILLS, ACROSS), theta=THETA, width=0.2, amplitude=0.1, creases=21, tuned=False)
    crossing = trajectories(family, 10, np.linspace(-1.0, 1.0, 11))
    tangents = np.stack([unit(spline(row, 1)) for spline, row in zip(family.splines, crossing.at, strict=True)])
    chords = np.diff(crossing.points, axis=0)
    assert np.abs(dot(unit(chords), unit(tangents[1:] + tangents[:-1]))).max() < 1e-8
    mirrored = dot(unit(chords), tangents[1:]) + dot(unit(chords), tangents[:-1])
    assert np.abs(mirrored).max() < 1e-8


def test_offsets_enclose_theta_with_the_normals_and_lean_along_the_guide():
    pattern = guided_pattern(HILLS, ACROSS, theta=60, width=0.25, amplitude=0.12, samples=40)
    normals = HILLS.project(pattern.curves.reshape(-1, 3)).normals.reshape(pattern.curves.shape)
    assert dot(pattern.binormals, normals) == pytest.approx(np.full(normals.shape[:2], 0.5), abs=1e-12)
    assert (dot(pattern.binormals[:-1], np.diff(pattern.curves, axis=0)) > 0).all()
    assert norm(HILLS.project(pattern.curves.reshape(-1, 3)).positions - pattern.curves.reshape(-1, 3)).max() < 1e-12
    assert pattern.widths.shape == (pattern.creases - 1, 40)


def test_zigzags_with_mirror_spacing_start_near_developable():
    pattern = guided_pattern(HILLS, ACROSS, theta=60, width=0.25, amplitude=0.12, samples=60)
    start = zigzag(pattern, 0.12)
    assert np.abs(angle_defect(start.topology, start.vertices)).max() < 2e-3


def test_the_family_is_cropped_to_a_rectangle_that_the_surface_contains():
    free = guided_pattern(HILLS, ACROSS, theta=60, width=0.25, amplitude=0.12, samples=30)
    kept = guided_pattern(HILLS, ACROSS, theta=60, width=0.25, amplitude=0.12, samples=30, creases=24)
    assert kept.creases == 24
    for pattern in (free, kept):
        assert np.abs(pattern.curves[..., 1]).max() < 2.1  # curves are shifted by a part of their gaps
        assert np.abs(pattern.curves[..., 0]).max() < 3.0
        gaps = pattern.widths / np.median(pattern.widths[::2], axis=1).mean()
        assert gaps.min() > 0.1
        assert gaps.max() < 3.0
    across = guided_pattern(HILLS, [[0, -1.9, 0], [0, 1.9, 0]], theta=60, width=0.2, amplitude=0.1, samples=30)
    assert np.ptp(across.curves[across.creases // 2, :, 0]) > 3.5


def test_a_crop_that_begins_with_a_crease_above_leaves_it_above():
    family = shoot(HILLS, guide_through(HILLS, ACROSS), theta=THETA, width=0.25, amplitude=0.12, creases=12, tuned=False)
    stub = Trace(family.curves[0].points[:6], Stop.CURLED_UP)
    cut = Family((stub, *family.curves[1:]), family.theta, family.spacing, False, family.turns)
    whole, rest = (zigzag_curves(pattern_of(part, HILLS, 0.12, 30), 0.12) for part in (family, cut))
    assert len(rest) == len(whole) - 1
    inner = slice(8, 22)
    for crease, guide in zip(rest[1:, inner], whole[2:], strict=True):  # the first is shifted by other neighbours
        assert distance_to_polyline(crease, guide).max() < 0.02


def test_closed_families_close_after_an_even_number_of_creases():
    torus = Torus(3.0, 1.0)
    pattern = guided_pattern(torus, ring(4.0), theta=60, width=0.4, amplitude=0.25, samples=20, creases=24,
                             closed=True, length=0.9)
    assert pattern.closed_family
    assert pattern.topology.face_count == 24 * 19
    assert pattern.widths.shape == (24, 20)
    pair = pattern.curves.reshape(12, 2, 20, 3)
    turn = Rotation.from_rotvec([0, 0, 2 * np.pi / 12])
    turned = turn.apply(pair[:-1].reshape(-1, 3)).reshape(11, 2, 20, 3)
    assert np.abs(turned - pair[1:]).max() < 1e-3
    assert np.abs(pattern.resampled(31).widths.shape[0]) == 24


def test_closed_creases_come_from_families_whose_curves_close():
    """Parallels of a cone are pseudo-geodesics of one inclination: θ = 90° − half angle."""
    half = np.radians(35)
    cone = Cone(half, 1.0, 6.0)
    ray = np.array([np.sin(half), 0, np.cos(half)])
    patterns = []
    for ends in (([2.0], [5.0]), ([5.0], [2.0])):
        line = Guide(np.linspace(ends[0][0], ends[1][0], 50)[:, None] * ray)
        try:
            family = shoot(cone, line, theta=np.pi / 2 - half, width=0.3, amplitude=0.2, creases=6)
            patterns.append(pattern_of(family, cone, 0.2, 40, crop=False))
        except Infeasible:
            continue
    assert any(pattern.closed for pattern in patterns)
    for pattern in patterns:
        if pattern.closed:
            assert np.ptp(pattern.curves[..., 2], axis=1).max() < 1e-4


def test_fans_leave_a_point_in_all_directions():
    dome = HeightField("-0.4*(x**2 + y**2)", (-2, 2), (-2, 2))
    family = fan(dome, [0, 0, 0], theta=np.radians(65), creases=16, radius=0.8, length=1.8)
    assert family.closed
    assert norm(np.stack([spline(0.0) for spline in family.splines])).max() < 1e-12
    pattern = pattern_of(family, dome, 0.2, 24, crop=False)
    assert pattern.creases == 16
    assert np.ptp(norm(pattern.curves[..., :2]), axis=0).max() < 0.12
    assert (dot(pattern.binormals, np.roll(pattern.curves, -1, axis=0) - pattern.curves) > 0).all()
    other = pattern_of(fan(dome, [0, 0, 0], theta=np.radians(65), creases=16, radius=0.8, length=1.8, side=-1), dome, 0.2,
                       24, crop=False)
    assert (dot(other.binormals, np.roll(other.curves, -1, axis=0) - other.curves) > 0).all()
    with pytest.raises(Infeasible, match="even"):
        fan(dome, [0, 0, 0], theta=1.0, creases=15, radius=0.8)


def test_boundaries_guide_creases_into_the_surface():
    cone = Cone(np.radians(30), 2.0, 5.0)
    guide = boundary_guide(cone, cone.mesh(60))
    assert guide.closed
    family = shoot(cone, guide, theta=THETA, width=0.5, amplitude=0.3, length=1.0)
    points = np.concatenate([curve.points for curve in family.curves])
    assert cone.project(points).known.mean() > 0.99
    assert norm(points).min() < 4.3
    with pytest.raises(InvalidDesign, match="2 boundary loops"):
        boundary_guide(cone, cone.mesh(30), 2)


def test_plane_sections_guide_creases():
    guide = section_guide(HILLS, HILLS.mesh(60), [0, 0.5, 0], [0, 1, 0])
    assert not guide.closed
    assert np.abs(guide.points[:, 1] - 0.5).max() < 1e-6
    assert np.ptp(guide.points[:, 0]) == pytest.approx(6.0, abs=1e-6)
    assert guide.reversed().at(np.zeros(1))[0] == pytest.approx(guide.points[-1:])
    around = section_guide(Cylinder(1.0, 3.0), Cylinder(1.0, 3.0).mesh(40), [1, 0, 0.3], [0, 0, 1])
    assert around.closed
    assert around.length == pytest.approx(2 * np.pi, rel=1e-3)
    with pytest.raises(InvalidDesign, match="does not meet"):
        section_guide(HILLS, HILLS.mesh(20), [0, 50, 0], [0, 1, 0])


def test_disarray_is_said_with_its_place():
    bumps = HeightField("0.5*sin(4*x)*sin(4*y)", (-2, 2), (-2, 2))
    with pytest.raises(Infeasible, match=r"curves? \d+ .*of 16.*(theta|guide)"):
        guided_pattern(bumps, [[-1.8, 0.1, 0], [1.8, 0.1, 0]], theta=15, width=0.25, amplitude=0.1, creases=16)
    with pytest.raises(Infeasible, match="curl"):
        guided_pattern(Sphere(1.0, 1.2), ring(0.5, np.sqrt(0.75)), theta=1.5, width=0.2, amplitude=0.1,
                       closed=True)


@pytest.mark.parametrize("theta", [0, 90, -5])
def test_inclinations_outside_the_range_are_refused(theta):
    with pytest.raises(InvalidDesign, match="inclination"):
        guided_pattern(HILLS, ACROSS, theta=theta, width=0.25, amplitude=0.1)


@pytest.mark.parametrize("guide", [[[0, 0, 0]], [[0, 0, 0], [0, 0, 0]], [[0, 0, np.nan], [1, 0, 0]]])
def test_impossible_guides_are_refused(guide):
    with pytest.raises(InvalidDesign, match=r"guide"):
        guided_pattern(HILLS, guide, theta=60, width=0.25, amplitude=0.1)


def test_a_height_field_becomes_exact_and_stays_near():
    amplitude = 0.2
    pattern = guided_pattern(HILLS, ACROSS, theta=60, width=0.25, amplitude=amplitude, samples=40)
    best = solve([(Start(pattern, amplitude, 40), SECOND_CHANCE)]).best
    assert best.verdict is not None
    assert best.verdict.is_good
    assert np.degrees(best.verdict.regularity.min_sector) > 60
    deviation = mid_surface_deviation(HILLS, best.attempt.vertices, best.start.topology.quads)
    assert deviation.mean < 0.3 * amplitude


def test_a_closed_family_becomes_exact():
    torus = Torus(3.0, 1.0)
    pattern = guided_pattern(torus, ring(4.0), theta=60, width=0.8, amplitude=0.5, samples=24, creases=24,
                             closed=True, length=0.9, tuned=False)
    best = solve([(Start(pattern, 0.5, 24), GENERAL)]).best
    assert best.verdict is not None
    assert best.verdict.is_good
    assert best.start.topology.face_count == 24 * 23
