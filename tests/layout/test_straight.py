"""Rows that start straight: they cover sheets and tubes evenly, and close where tubes do."""

import numpy as np
import pytest

from plisse.geometry.formulas import Cone, Cylinder
from plisse.geometry.parametric import ParametricSurface
from plisse.layout.automatic import Sizes, lay_out
from plisse.layout.coverage import AreaSamples
from plisse.layout.rows import RowGeometry
from plisse.layout.straight import Straight, directions

WIDTH = 0.3


def tube():
    return ParametricSurface(Cylinder(1.0, 3.0).mesh(48))


@pytest.mark.parametrize("degrees", [90, 70, 130])
def test_rows_up_a_tube_are_even_in_number_and_gap(degrees):
    rows = Straight(np.radians(degrees)).rows(tube(), WIDTH)
    assert rows.is_ring
    assert len(rows.radii) == 2 * round(np.pi * np.sin(np.radians(degrees)) / WIDTH)
    gaps = RowGeometry.of(rows, tube()).gaps
    assert gaps.shape == rows.radii.shape
    # the rows of a cylinder are helices at the same angle
    np.testing.assert_allclose(gaps, 2 * np.pi * np.sin(np.radians(degrees)) / len(rows.radii), rtol=0.03)


def test_rows_around_a_tube_close_and_are_circles():
    rows = Straight(0.0).rows(tube(), WIDTH)
    geometry = RowGeometry.of(rows, tube())
    assert rows.closed
    assert not rows.is_ring
    np.testing.assert_allclose(np.ptp(geometry.positions[..., 2], axis=1), 0, atol=1e-3)
    np.testing.assert_allclose(geometry.steps.sum(axis=1)[2:-2], 2 * np.pi, rtol=0.01)
    np.testing.assert_allclose(geometry.gaps, WIDTH, rtol=0.1)


@pytest.mark.parametrize("start", [*(np.radians(angle) for angle in (90, 60, 0))])
def test_the_quads_kept_of_a_tube_go_around_it(start):
    surface = ParametricSurface(Cone(np.radians(10), 4.0, 9.0).mesh(60))
    mesh = surface.mesh
    found = lay_out(Straight(start).rows(surface, WIDTH), AreaSamples.of(mesh.vertices, mesh.triangles), surface,
                    Sizes(WIDTH, 0.8 * WIDTH, curvature=0.0))
    ring = found.net.is_ring
    assert found.mask.shape == (len(found.zigzag) - (not ring), found.zigzag.shape[1] - (not found.net.closed))
    around = found.mask.all(axis=0 if ring else 1)
    assert around.sum() > 0.6 * len(around)
    assert ring != found.net.closed


def test_columns_of_a_ring_meet_themselves():
    surface = tube()
    mesh = surface.mesh
    net = lay_out(Straight(np.radians(70)).rows(surface, WIDTH), AreaSamples.of(mesh.vertices, mesh.triangles), surface,
                  Sizes(WIDTH, 0.8 * WIDTH, curvature=0.0)).net
    last = np.linalg.norm(net.points[0] - net.points[-1], axis=1)
    others = np.linalg.norm(np.diff(net.points, axis=0), axis=-1)
    assert last.max() < 1.5 * others.max()


def test_directions_of_sheets_and_tubes_have_names():
    assert next(directions(tube())).label(tube()) == "creases up the tube at 90°"
    assert Straight(0.0).label(tube()) == "creases around the tube"
