"""Layouts around singularities: faces, labels by parity, legs, refinement, and what is known to be impossible."""

import numpy as np
import pytest

from plisse.errors import Infeasible
from plisse.geometry.chart import FormulaChart
from plisse.geometry.height_field import HeightField
from plisse.geometry.vectors import norm
from plisse.geometry.weierstrass import MinimalSurface
from plisse.layout.asymptotic.feasibility import refuse_crowded_hubs, refuse_positive_curvature, refuse_twist
from plisse.layout.asymptotic.labels import propagated
from plisse.layout.asymptotic.pattern import lay_out
from plisse.layout.asymptotic.rays import crossings
from plisse.layout.asymptotic.sizing import Sizes


def around(sectors, creases=4, columns=6, **sizes):
    """A pattern around one singularity of a minimal surface with so many sectors."""
    chart = MinimalSurface(f"z**{sectors - 1}", "1", (-0.5, 0.5), (-0.5, 0.5))
    return lay_out(chart, 1, Sizes(creases, columns, 0.06, **sizes))


@pytest.fixture(scope="module", params=[3, 4, 5])
def layout(request):
    return around(request.param)


def test_the_polygon_in_the_middle_has_two_sides_per_sector(layout):
    hub, = layout.net.topology.hubs
    assert len(hub) == 2 * layout.hubs[0].sectors
    assert layout.net.topology.euler_characteristic == 1


def test_inner_vertices_have_four_edges_and_four_faces(layout):
    assert list(layout.net.topology.stars) == [4]


def test_creases_are_evenly_spaced_along_bisectors(layout):
    first, width = 1.5 * layout.width, layout.width
    for ray in layout.bisectors:
        reached = np.sort(crossings(ray.leaf, list(layout.net.creases)))
        reached = reached[np.isfinite(reached)]
        np.testing.assert_allclose(reached, first + width * np.arange(len(reached)), rtol=2e-3)  # chords of curves


def test_labels_alternate_with_the_level_in_every_sector_and_repeat_across_legs(layout):
    """The label is (−1)^level, single-valued for odd numbers of sectors too."""
    net, labels = layout.net, layout.labels
    level = np.zeros(len(net.creases), int)
    for number, leaf in enumerate(net.creases):
        # distance along the bisector is the smallest distance from the singularity
        away = norm(leaf.points - layout.chart.positions(np.array([layout.hubs[0].place]))).min()
        level[number] = round(away / layout.width - 1.5)
    used = labels.of_creases != 0
    signs = labels.of_creases[used] * (-1) ** level[used]
    assert (signs == signs[0]).all()
    edges = net.topology.edges
    a, b = labels.of_creases[net.crease[edges.vertices]].T
    ruling = ~edges.is_crease
    assert (a[ruling] == b[ruling]).tolist() == labels.repeats[ruling].tolist()
    across = net.crease[edges.vertices[labels.repeats]]
    assert (level[across] == 0).all()


def test_neighbours_across_a_ruling_have_opposite_products_of_label_and_turning(layout):
    """The parity rule itself: label × side to which the crease turns changes along every ruling, across legs too."""
    edges = layout.net.topology.edges
    one, other = edges.vertices[~edges.is_crease].T
    label = layout.labels.of_creases[layout.net.crease]
    same_side = layout.bends.facing(layout.points, one, other)
    clear = np.abs(same_side) > 1e-2 * np.abs(same_side).max()
    product = np.sign(same_side) * label[one] * label[other]
    assert np.mean(product[clear] == -1) > 0.98  # outermost vertices are judged from few samples


def test_refinement_keeps_creases_and_gets_nearer_to_the_singularity(layout):
    fine = layout.refined().refined()
    assert len(fine.net.columns) > 3 * len(layout.net.columns)
    np.testing.assert_array_equal(np.unique(fine.net.crease), np.unique(layout.net.crease))
    assert fine.net.topology.euler_characteristic == 1
    size = [np.abs(layout.net.places[hub]).min() for layout in (layout, fine) for hub in layout.net.topology.hubs]
    assert size[1] < size[0]


def test_columns_are_cut_where_creases_beside_a_leg_hardly_bend():
    whole = around(3, creases=5, columns=9)
    twist = [whole.cut_along_legs(most).bends.twist.max() for most in (1e9, 4.0, 2.0)]
    assert twist[0] >= twist[1] >= twist[2]
    assert len(whole.cut_along_legs(2.0).net.columns) < len(whole.net.columns)


def test_two_singularities_get_a_polygon_each():
    chart = FormulaChart(HeightField("0.09*(4*x**3*y - 4*x*y**3 - 1.47*x*y)"))
    layout = lay_out(chart, 1, Sizes(5, 8, 0.08))
    assert [len(hub) for hub in layout.net.topology.hubs] == [6, 6]
    assert layout.net.topology.euler_characteristic == 1
    assert set(np.abs(layout.labels.of_creases[layout.net.crease])) == {1}


def test_without_singularities_the_net_is_a_grid():
    layout = lay_out(MinimalSurface("exp(z)", "i*exp(-z)", (0.6, 1.5), (-2, 2)), 1, Sizes(6, 20))
    assert layout.hubs == ()
    assert layout.net.topology.hubs == ()
    assert layout.net.topology.vertex_count == 120
    assert not layout.labels.repeats.any()


def test_labels_that_contradict_each_other_are_refused_in_a_sentence():
    np.testing.assert_array_equal(propagated(np.array([[0, 1, -1], [1, 2, -1], [2, 0, 1]]), 4), [1, -1, 1, 0])
    with pytest.raises(Infeasible, match="mountains and valleys cannot be assigned: crease"):
        propagated(np.array([[0, 1, -1], [1, 2, -1], [2, 0, -1]]), 3)


@pytest.mark.parametrize("formula", ["-x**2 - y**2", "x**2", "0*x"])
def test_surfaces_without_negative_curvature_are_refused(formula):
    with pytest.raises(Infeasible, match="asymptotic curves exist only where it is negative"):
        refuse_positive_curvature(FormulaChart(HeightField(formula)))


def test_columns_too_near_to_a_singularity_are_refused():
    with pytest.raises(Infeasible, match=r"too near for creases 0\.06 apart"):
        refuse_crowded_hubs(around(3, hub=0.01))


def test_too_much_twist_is_refused_and_a_larger_amplitude_allows_more():
    steep = lay_out(FormulaChart(HeightField("1.5*(x**3 - 3*x*y**2)")), 1, Sizes(6, 8))
    with pytest.raises(Infeasible, match="torsion over curvature"):
        refuse_twist(steep, 0.2 * steep.width)
    refuse_twist(around(3), 0.03)


def test_creases_that_leave_the_surface_are_refused():
    with pytest.raises(Infeasible, match=r"give a smaller pattern\.width"):
        lay_out(FormulaChart(HeightField("0.3*(x**3 - 3*x*y**2)")), 1, Sizes(6, 8, 1.5))
