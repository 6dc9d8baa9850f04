"""Rows, inclinations and columns on surfaces that have formulas."""

from dataclasses import dataclass

import numpy as np
import pytest

from plisse.geometry.monge import monge
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.columns import mirror_shift, woven
from plisse.layout.inclination import InclinationFit
from plisse.layout.rows import RowGeometry, circles, rows_between
from plisse.layout.rows_relax import Relaxation, relaxed

RADIUS, SLOPE = 10.0, 0.7
TURN = np.linspace(0, 2 * np.pi, 200)
RIM = 6.0 * np.stack([np.cos(TURN), np.sin(TURN)], axis=1)
DISK = np.concatenate([RIM * share for share in (0.2, 0.4, 0.6, 0.8, 1.0)])


@dataclass(frozen=True)
class Revolved:
    """z(r) around the z axis, with its first two derivatives."""

    profile: object
    diagonal: float = 20.0

    def to_plane(self, points):
        return points

    def to_space(self, coordinates):
        return coordinates

    def at(self, places):
        return self.project(np.column_stack([places, np.zeros(len(places))]))

    def project(self, points):
        x, y = points[:, 0], points[:, 1]
        r = np.hypot(x, y)
        z, first, second = self.profile(r)
        c, s = x / r, y / r
        hessian = np.stack([second * c**2 + first / r * s**2, (second - first / r) * c * s,
                            second * s**2 + first / r * c**2])
        normals, bending = monge(np.stack([first * c, first * s]), hessian)
        return SurfacePoints(np.stack([x, y, z], axis=1), normals, bending, np.ones(len(x), bool))


def plane(r):
    return 0 * r, 0 * r, 0 * r


def cone(r):
    return -SLOPE * r, -SLOPE + 0 * r, 0 * r


def sphere(r):
    z = np.sqrt(RADIUS**2 - r**2)
    return z, -r / z, -(RADIUS**2) / z**3


CURVATURES = {  # geodesic and normal curvature of a circle of radius r around the axis
    plane: lambda r: (1 / r, 0 * r),
    cone: lambda r: (1 / r / np.hypot(1, SLOPE), -SLOPE / r / np.hypot(1, SLOPE)),
    sphere: lambda r: (np.sqrt(RADIUS**2 - r**2) / r / RADIUS, 0 * r - 1 / RADIUS),
}


@pytest.mark.parametrize("profile", CURVATURES)
def test_curvatures_of_circles_around_an_axis_have_closed_forms(profile):
    rows = circles(Revolved(profile), DISK, np.zeros(2), 0.5)
    assert rows.closed
    geometry = RowGeometry.of(rows, Revolved(profile))
    geodesic, normal = CURVATURES[profile](rows.radii)
    chords = 1 + (rows.angles[1] - rows.angles[0]) ** 2  # second order in the step
    np.testing.assert_allclose(geometry.geodesic, geodesic, rtol=chords - 1)
    np.testing.assert_allclose(geometry.normal, normal, rtol=1e-9, atol=1e-12)
    assert (dot(geometry.outward[..., :2], rows.places) > 0).all()


@pytest.mark.parametrize("profile", CURVATURES)
def test_circles_lie_one_width_apart(profile):
    rows = circles(Revolved(profile), DISK, np.zeros(2), 0.5, pad=0)
    gaps = RowGeometry.of(rows, Revolved(profile)).gaps
    np.testing.assert_allclose(gaps, 0.5, rtol=0.03)


def test_circles_about_a_centre_outside_are_open_and_cover_the_places_with_a_margin():
    centre = np.array([-15.0, 3.0])
    rows = circles(Revolved(plane), DISK, centre, 0.5, pad=2)
    assert not rows.closed
    distance = norm(DISK - centre)
    assert rows.radii.min() == pytest.approx(distance.min() - 1.0)
    assert distance.max() + 0.5 < rows.radii.max() <= distance.max() + 1.0
    angle = np.arctan2(*(DISK - centre).T[::-1])
    first, last = np.unwrap([0.0, rows.angles[0]])[1], np.unwrap([0.0, rows.angles[-1]])[1]
    assert first < angle.min() - 0.05
    assert last > angle.max() + 0.05


def test_inclination_fitted_to_circles_on_a_sphere_is_their_polar_angle():
    surface = Revolved(sphere)
    rows = circles(surface, DISK, np.zeros(2), 0.5, pad=0)
    fit = InclinationFit(rows.radii.shape, rows.closed, 0.5, np.radians(58))
    theta = fit.improved(np.zeros(rows.radii.shape), RowGeometry.of(rows, surface), 20)
    polar = np.arcsin(rows.radii / RADIUS)
    # smoothness across rows draws the ends towards the mean
    np.testing.assert_allclose(theta, -polar, atol=np.radians(12))
    assert theta.mean() == pytest.approx(-polar.mean(), abs=np.radians(4))


def test_relaxation_makes_gaps_even():
    surface = Revolved(lambda r: (0.5 * np.cos(r), -0.5 * np.sin(r), -0.5 * np.cos(r)))
    rows = circles(surface, DISK, np.array([9.0, 2.0]), 0.5)
    before = RowGeometry.of(rows, surface).gaps
    after, theta = relaxed(rows, surface, 0.5, Relaxation(curvature=0.0))
    assert RowGeometry.of(after, surface).gaps.std() < 0.4 * before.std()
    assert np.abs(theta).max() < np.radians(65)


def test_rows_between_two_loops_divide_the_way_evenly():
    inner, outer = 0.4 * RIM, RIM * [1.0, 1.3]
    rows = rows_between(Revolved(plane), inner, outer, np.zeros(2), 0.3)
    np.testing.assert_allclose(rows.radii[0], 2.4, rtol=0.01)
    np.testing.assert_allclose(np.diff(rows.radii, n=2, axis=0), 0, atol=1e-9)
    parallel = rows_between(Revolved(plane), inner, outer, np.zeros(2), 0.3, parallel=True)
    np.testing.assert_allclose(np.diff(parallel.radii, axis=0), 0.3, rtol=1e-9)
    assert parallel.radii.max() >= 6 * 1.3 - 1e-2


def test_columns_are_orthogonal_to_rows_and_keep_their_angles_on_concentric_circles():
    surface = Revolved(sphere)
    rows = circles(surface, DISK, np.zeros(2), 0.5, pad=0)
    net = woven(rows, np.zeros(rows.radii.shape), surface, 0.4)
    angle = np.unwrap(np.arctan2(net.points[..., 1], net.points[..., 0]))
    np.testing.assert_allclose(angle, np.broadcast_to(angle[:1], angle.shape), atol=1e-4)
    off = circles(surface, DISK, np.array([-15.0, 3.0]), 0.5)
    off = off.with_radii(np.minimum(off.radii, 20.0) + 0.2 * np.sin(5 * off.angles))
    net = woven(off, np.zeros(off.radii.shape), Revolved(plane), 0.4)
    chord, tangent = unit(np.diff(net.points, axis=0)), unit(np.gradient(net.points, axis=1))
    both = unit(tangent[1:] + tangent[:-1])
    assert np.abs(dot(chord, both))[:, 2:-2].max() < 0.02


def test_mirror_shift_couples_the_widths_of_climbing_and_falling_strips():
    gaps, theta, amplitude = 1.3, np.radians([-40.0, -5.0, 0.0, 20.0, 60.0]), 0.8
    shift = mirror_shift(np.full(5, gaps), theta, amplitude)
    climbing, falling = gaps + 2 * np.abs(shift), gaps - 2 * np.abs(shift)
    np.testing.assert_allclose(amplitude * (1 / falling - 1 / climbing), np.abs(np.sin(theta)), atol=1e-8)
    assert (np.sign(shift) == np.sign(theta)).all()


def test_a_zigzag_leaves_the_plane_by_the_amplitude_in_turn():
    rows = circles(Revolved(plane), DISK, np.zeros(2), 0.5)
    net = woven(rows, np.zeros(rows.radii.shape), Revolved(plane), 0.4)
    heights = net.shifted(Revolved(plane), 0.3).zigzag(0.3)[..., 2]
    np.testing.assert_allclose(heights[::2], -0.3)
    np.testing.assert_allclose(heights[1::2], 0.3)
