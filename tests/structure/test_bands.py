import numpy as np
import pytest

from plisse.structure.bands import bands
from plisse.structure.grid import grid
from plisse.structure.topology import Topology
from plisse.structure.triangles import triangulated


def test_an_open_grid_has_a_band_per_strip_along_its_two_creases():
    topology = grid(4, 6)
    index = np.arange(24).reshape(4, 6)
    for row, band in enumerate(bands(topology)):
        sides = {tuple(sorted(band.left.tolist())), tuple(sorted(band.right.tolist()))}
        assert sides == {tuple(index[row]), tuple(index[row + 1])}
        assert not band.closed
        step = np.diff(band.left)
        assert (step == step[0]).all() and abs(step[0]) == 1


@pytest.mark.parametrize("shape", [{"closed_creases": True}, {"closed_family": True}, {}])
def test_rulings_join_the_two_sides_and_every_quad_is_in_one_band(shape):
    topology = grid(6, 7, **shape)
    rulings = {frozenset(pair) for pair in topology.edges.vertices[~topology.edges.is_crease].tolist()}
    found = bands(topology)
    for band in found:
        assert {frozenset(pair) for pair in zip(band.left.tolist(), band.right.tolist(), strict=True)} <= rulings
        assert band.closed == bool(shape.get("closed_creases"))
    assert sum(len(band.left) - (not band.closed) for band in found) == topology.face_count


def test_turned_face_lists_give_the_same_bands_and_holes_split_them():
    topology = grid(3, 8)
    shuffled = Topology(24, topology.quads[np.random.default_rng(3).permutation(14)])
    assert sorted(sorted(band.left.tolist()) for band in bands(shuffled)) == \
        sorted(sorted(band.left.tolist()) for band in bands(topology))
    mask = np.ones((2, 7), bool)
    mask[0, 3] = False
    assert sorted(len(band.left) for band in bands(grid(3, 8, mask=mask))) == [4, 4, 8]


def test_triangles_cover_every_face_once():
    angle = np.arange(6) * np.pi / 3
    points = np.concatenate([np.stack([np.cos(angle), np.sin(angle)], axis=1), [[3, 0], [3, 1]]])
    topology = Topology(8, np.array([[0, 6, 7, 1]]), (np.arange(6),))
    faces, owner = triangulated(topology)
    assert owner.tolist() == [0, 0, 1, 1, 1, 1]
    a, b, c = points[faces].swapaxes(0, 1)
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert area[owner == 1].sum() == pytest.approx(1.5 * np.sqrt(3))
    assert (area > 0).all()
