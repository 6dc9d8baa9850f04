"""One fold becomes three: parallel, exact, local, with mountains and valleys in turn."""

import numpy as np
import pytest

from plisse.errors import Infeasible, InvalidStructure
from plisse.measure.folds import fold_angles
from plisse.structure.exact import alternating_cones, conic_creases, marched, miura
from plisse.structure.helical import helical_pleats
from plisse.structure.lines import joined
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.refine_fold import inner_creases, refine_fold, refine_folds


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(axis=-1))


def defects(structure):
    """Planarity (relative) and angle sums, by a few lines of their own."""
    vertices, quads = structure.vertices, structure.topology.quads
    a, b, c, d = (vertices[quads[:, k]] for k in range(4))
    normal = np.cross(b - a, c - a)
    planarity = np.abs(np.einsum("ij,ij->i", normal, d - a)) / np.linalg.norm(normal, axis=1) / np.linalg.norm(c - a, axis=1)
    total = np.zeros(len(vertices))
    for k in range(4):
        corner, after, before = vertices[quads[:, k]], vertices[quads[:, (k + 1) % 4]], vertices[quads[:, (k + 3) % 4]]
        np.add.at(total, quads[:, k], angle(after - corner, before - corner))
    return planarity.max(), np.abs(total - 2 * np.pi)[~structure.topology.is_boundary].max()


STRUCTURES = {"cones": alternating_cones(5, 24), "ring": alternating_cones(5, 24, closed=True), "miura": miura(5, 8),
              "conics": conic_creases(5, 30), "general": marched(5, 16), "helix": helical_pleats(5, 30)}


@pytest.mark.parametrize("name", STRUCTURES)
def test_a_fold_becomes_three_and_everything_stays_exact(name):
    structure = STRUCTURES[name]
    found = refine_folds(structure, [2], fraction=0.3)
    assert len(found.topology.creases) == len(structure.topology.creases) + 2
    planarity, angles = defects(found)
    assert planarity < 1e-13
    assert angles < 1e-12


@pytest.mark.parametrize("name", ["cones", "ring", "miura", "conics", "helix"])
def test_refined_three_times_it_is_still_exact(name):
    found = STRUCTURES[name]
    for _ in range(3):
        found = refine_folds(found, inner_creases(found.topology))
    assert len(found.topology.creases) == 2 + 3 * 27
    planarity, angles = defects(found)
    assert planarity < 1e-12
    assert angles < 1e-12


def test_nothing_moves_beyond_the_two_strips():
    structure = conic_creases(7, 20)
    found = refine_folds(structure, [3])
    kept = np.concatenate([structure.topology.creases[k].vertices for k in (0, 1, 2, 4, 5, 6)])
    assert np.array_equal(found.vertices[kept], structure.vertices[kept])


def test_new_creases_are_parallel_to_the_old_one_and_faces_to_those_beside_it():
    structure = marched(5, 16)
    old = structure.topology.creases[2].vertices
    found = refine_folds(structure, [2])
    count = structure.topology.vertex_count
    edges = np.diff(structure.vertices[old], axis=0)
    for line in (old, count + np.arange(16), count + 16 + np.arange(16)):
        new = np.diff(found.vertices[line], axis=0)
        assert np.linalg.norm(np.cross(edges, new), axis=1).max() < 1e-13
        assert ((edges * new).sum(axis=1) > 0).all()


def test_mountain_becomes_mountain_valley_mountain_of_the_same_size():
    structure = conic_creases(5, 20)
    found = refine_folds(structure, [2])

    def fold(shape, line):
        edges = shape.topology.edges
        on = np.isin(edges.vertices, line).all(axis=1) & edges.is_crease
        return fold_angles(shape.topology, shape.vertices)[on]

    count, old = structure.topology.vertex_count, structure.topology.creases[2].vertices
    before = fold(structure, old)
    for line, sign in ((old, 1), (count + np.arange(20), -1), (count + 20 + np.arange(20), 1)):
        assert fold(found, line) == pytest.approx(sign * before, abs=1e-12)


def test_the_fraction_is_that_of_the_rulings_where_it_is_measured():
    structure = marched(5, 16)
    old = structure.topology.creases[2].vertices
    for at, place in ((0.0, 0), (1.0, 15)):
        found = refine_folds(structure, [2], fraction=0.2, at=at)
        gone = np.linalg.norm(found.vertices[old] - structure.vertices[old], axis=1)
        ruling = np.linalg.norm(structure.vertices[structure.topology.creases[1].vertices] - structure.vertices[old], axis=1)
        share = (gone / ruling)[place]
        other = np.linalg.norm(structure.vertices[structure.topology.creases[3].vertices] - structure.vertices[old], axis=1)
        assert min(abs(share - 0.2), abs((gone / other)[place] - 0.2)) < 1e-12


def test_principal_stays_principal_and_the_sheet_is_laid_flat():
    found = refine_fold(conic_creases(5, 20), 2)
    star = found.topology.stars[4]
    arms = found.vertices[star[:, 1:]] - found.vertices[star[:, :1]]
    assert np.abs(angle(arms[:, 0], arms[:, 1]) + angle(arms[:, 2], arms[:, 3]) - np.pi).max() < 1e-12
    i, j = found.topology.edges.vertices.T
    lengths = [np.linalg.norm(points[i] - points[j], axis=1) for points in (found.vertices, found.development)]
    assert lengths[0] == pytest.approx(lengths[1], abs=1e-11)


def test_the_method_is_the_function():
    structure = miura(5, 8)
    assert np.array_equal(structure.refine_fold(2, fraction=0.4).vertices, refine_fold(structure, 2, fraction=0.4).vertices)


def test_what_cannot_be_refined_is_said():
    structure = STRUCTURES["general"]
    with pytest.raises(InvalidStructure, match="boundary"):
        refine_fold(structure, 0)
    with pytest.raises(InvalidStructure, match="no crease 12"):
        refine_fold(structure, 11)
    with pytest.raises(InvalidStructure, match="between 0 and 1"):
        refine_fold(structure, 2, fraction=1.0)
    with pytest.raises(InvalidStructure, match="no position 2"):
        refine_fold(structure, 2, at=2.0)
    with pytest.raises(Infeasible, match=r"below 0\.\d+"):
        refine_fold(structure, 2, fraction=0.95, at=0.5)
    with pytest.raises(Infeasible, match=r"no room.*below 0\.\d+"):
        refine_folds(structure, [1, 2, 3], fraction=0.7)


def test_a_closed_crease_whose_parallels_do_not_close_is_refused():
    ring = alternating_cones(5, 24, closed=True)
    rng = np.random.default_rng(0)
    bent = ring.with_vertices(ring.vertices + 0.01 * rng.standard_normal(ring.vertices.shape))
    with pytest.raises(Infeasible, match=r"misses itself.*cut the structure open"):
        refine_folds(bent, [2])


def test_seams_of_the_sheet_go_on_over_the_new_creases():
    base = conic_creases(5, 20)
    numbers = np.arange(100).reshape(5, 20)
    seam = np.stack([numbers[:-1, 7], numbers[1:, 7]], axis=1)
    topology = Topology(100, base.topology.quads, (), None, seam)
    found = refine_folds(PleatedStructure(topology, base.vertices), [2])
    (line,) = joined(found.topology.seams)
    middle, far = 100 + 7, 120 + 7
    wanted = [numbers[0, 7], numbers[1, 7], numbers[2, 7], middle, far, numbers[3, 7], numbers[4, 7]]
    assert line.vertices.tolist() in (wanted, wanted[::-1])
    along = Topology(100, base.topology.quads, (), None, np.stack([numbers[2, :-1], numbers[2, 1:]], axis=1))
    with pytest.raises(InvalidStructure, match="seam"):
        refine_folds(PleatedStructure(along, base.vertices), [2])
