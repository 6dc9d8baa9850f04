"""Plates in place as one thick sheet."""

import numpy as np
import pytest

import plisse
from plisse.draw.thick import thick_sheet
from plisse.geometry.vectors import norm
from plisse.studio.view import plates_view

DESIGN = {"curve": {"kind": "arc", "radius": 60, "angle": 60}, "solve": {"principal": True},
          "pattern": {"theta": 25, "creases": 5, "width": 5, "amplitude": 3, "samples": 21}}
THICKNESS = 0.3


@pytest.fixture(scope="module")
def plates():
    return plisse.design(DESIGN).structure.plates(THICKNESS)


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def test_it_is_closed_and_holds_the_volume_of_all_plates(plates):
    view = plates_view(plates)
    assert volume(view.points, view.triangles) == pytest.approx(plates.volumes.sum(), rel=1e-3)  # corners of the rim
    moved = volume(view.points + np.float32(100), view.triangles)
    assert moved == pytest.approx(plates.volumes.sum(), rel=1e-2)  # float32: a gap would show as a volume that moves


def test_away_from_the_rim_both_sides_are_those_of_the_plates(plates):
    thick, topology = thick_sheet(plates), plates.structure.topology
    inner = ~topology.is_boundary[topology.corners.vertex]
    for side, outline in zip(thick.sides, (plates.upper, plates.lower), strict=True):
        miss = thick.structure.vertices[side[topology.corners.vertex]] - outline
        assert np.abs(miss[inner]).max() < 1e-12 * plates.structure.diagonal
        assert np.abs(miss).max() < THICKNESS


def test_sharp_edges_are_creases_and_rims_on_both_sides_and_corners_of_the_rim(plates):
    thick, edges = thick_sheet(plates), plates.structure.topology.edges
    sharp = (edges.is_crease | edges.is_boundary).sum()
    assert len(thick.outlines) == 2 * sharp + len(thick.upright)
    assert len(thick.upright) == 2 * 5  # both ends of every crease
    ends = thick.structure.vertices[thick.upright]
    assert norm(ends[:, 1] - ends[:, 0]).min() >= 0.99 * THICKNESS


def test_its_lines_as_runs_are_the_same_edges(plates):
    thick = thick_sheet(plates)
    drawn = {tuple(sorted(pair)) for run in thick.runs for pair in
             zip(run.vertices, [*run.vertices[1:], *run.vertices[:run.closed]], strict=False)}
    assert drawn == {tuple(sorted(pair)) for pair in thick.outlines.tolist()}
