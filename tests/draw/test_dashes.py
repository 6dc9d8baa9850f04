import numpy as np
import pytest
from scipy.spatial import cKDTree

import plisse
from plisse.draw.dashes import SHARE, dashed, longest_stride, whole
from plisse.geometry.vectors import norm
from plisse.measure.folds import assignments
from plisse.structure.incidence import edge_lookup


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def valleys(structure):
    letters = assignments(structure.topology, structure.vertices)
    return structure.topology.edges.is_crease & (letters == "V")


def test_their_share_of_every_length_is_drawn(structure):
    edges, chosen = structure.topology.edges, valleys(structure)
    whole = norm(np.diff(structure.vertices[edges.vertices[chosen]], axis=1)).sum()
    dashes = dashed(structure.topology, chosen, structure.vertices, whole / 1000)
    assert norm(np.diff(dashes, axis=1)).sum() == pytest.approx(SHARE * whole, rel=0.01)  # begun on each crease


def test_every_piece_lies_on_a_chosen_edge(structure):
    ends = structure.vertices[structure.topology.edges.vertices[valleys(structure)]]
    dashes = dashed(structure.topology, valleys(structure), structure.vertices, 0.03 * structure.diagonal)
    start, along = ends[:, 0], np.diff(ends, axis=1)[:, 0]
    for place in dashes.reshape(-1, 3)[::7]:
        share = np.clip(np.einsum("ij,ij->i", place - start, along) / np.einsum("ij,ij->i", along, along), 0, 1)
        assert norm(place - start - share[:, None] * along).min() < 1e-12 * structure.diagonal


def test_dashes_begin_one_period_apart_along_a_crease(cones):
    """Lengths along the crease from its start: no piece reaches into a gap."""
    topology, period = cones.topology, 0.02 * cones.diagonal
    crease = max((line for line in topology.creases if valleys(cones)[edge_of(topology, line.path)].all()),
                 key=lambda line: len(line.vertices))
    own = np.zeros(len(topology.edges.vertices), bool)
    own[edge_of(topology, crease.path)] = True
    points = cones.vertices[crease.path]
    reached = np.concatenate([[0], np.cumsum(norm(np.diff(points, axis=0)))])
    carried = np.zeros((topology.vertex_count, 1))
    carried[crease.path[1:], 0] = reached[1:]
    dashes = dashed(topology, own, np.concatenate([cones.vertices, carried], axis=1), period)[..., 3]
    assert (dashes.mean(axis=1) / period % 1).max() < SHARE
    assert dashes.min() == 0


def test_where_nothing_is_chosen_there_are_none(cones):
    none = np.zeros(len(cones.topology.edges.vertices), bool)
    assert dashed(cones.topology, none, cones.vertices, 1.0).shape == (0, 2, 3)


def test_fewer_pieces_leave_a_fine_crease_by_no_more_than_their_sag():
    structure = plisse.design({"closed_form": {"kind": "cones", "creases": 4, "samples": 301}}).structure
    topology, sag = structure.topology, 2e-4 * structure.diagonal
    stride, creases = longest_stride(topology, structure.vertices, sag), topology.edges.is_crease
    assert stride > 1
    pieces = whole(topology, creases, structure.vertices, stride)
    assert len(pieces) == sum(-(-(len(crease.path) - 1) // stride) for crease in topology.creases)
    ends = structure.vertices[topology.edges.vertices[creases]]
    near = cKDTree(np.concatenate([ends[:, 0], ends.mean(axis=1)]))  # vertices, and places between them
    assert near.query(pieces.mean(axis=1))[0].max() < sag
    assert np.array_equal(np.unique(whole(topology, creases, structure.vertices)), np.unique(ends))


def edge_of(topology, path):
    return edge_lookup(topology)(path[:-1], path[1:])
