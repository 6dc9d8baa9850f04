"""Plates are closed solids that do not intersect, by trimesh and manifold3d, and their limits are sharp."""

import re

import manifold3d
import numpy as np
import pytest
import shapely
import trimesh

from plisse.errors import InvalidDesign, InvalidStructure
from plisse.measure.convex_overlap import ConvexSolids
from plisse.measure.folds import fold_angles
from plisse.structure.exact import alternating_cones, conic_creases, conical_vertex, marched, miura
from plisse.transform.hinged_range import hinged_range, placed
from plisse.transform.solids import solids

STRUCTURES = {"cones": alternating_cones(), "closed cones": alternating_cones(closed=True), "miura": miura(),
              "conics": conic_creases(), "vertex": conical_vertex()}
# in mean edges: thickness, gap, side, hinged
CUTS = {"outer": (0.05, 0.0, "outer", False), "inner": (0.05, 0.0, "inner", False), "both": (0.1, 0.0, "both", False),
        "mitred gap": (0.05, 0.04, "both", False), "hinged": (0.03, 0.2, "outer", True), "film": (0.05, 0.2, "both", True)}


def made(structure, cut):
    thickness, gap, side, hinged = CUTS[cut]
    edge = structure.mean_edge
    return structure.plates(thickness * edge, gap=gap * edge, side=side, hinged=hinged)


def overlaps(plates, lower=None, upper=None):
    """Volumes that manifold3d finds in all pairs of plates whose boxes meet."""
    bodies = []
    for part in solids(plates):
        start = sum(len(body[0]) for body in bodies) // 2
        points = part.vertices
        if lower is not None:
            points = np.concatenate([lower[start:start + len(points) // 2], upper[start:start + len(points) // 2]])
        bodies.append((points, part.triangles))
    manifolds = [manifold3d.Manifold(manifold3d.Mesh64(points, triangles.astype(np.uint64))) for points, triangles in bodies]
    low, high = (np.array([getattr(points, side)(axis=0) for points, _ in bodies]) for side in ("min", "max"))
    meets = ((low[:, None] <= high[None]) & (low[None] <= high[:, None])).all(axis=2)
    return np.array([(manifolds[a] ^ manifolds[b]).volume() for a, b in zip(*np.nonzero(np.triu(meets, 1)), strict=True)])


@pytest.mark.parametrize("cut", CUTS)
@pytest.mark.parametrize("name", STRUCTURES)
def test_plates_are_closed_oriented_solids(name, cut):
    plates = made(STRUCTURES[name], cut)
    for part, volume in zip(solids(plates), plates.volumes, strict=True):
        body = trimesh.Trimesh(part.vertices, part.triangles, process=False)
        assert body.is_watertight and body.is_winding_consistent and body.is_convex
        assert body.volume == pytest.approx(volume, rel=1e-9)


@pytest.mark.parametrize("cut", CUTS)
@pytest.mark.parametrize("name", STRUCTURES)
def test_plates_are_pairwise_disjoint(name, cut):
    plates = made(STRUCTURES[name], cut)
    assert overlaps(plates).max(initial=0) <= 1e-9 * plates.volumes.max()


@pytest.mark.parametrize("name", STRUCTURES)
def test_four_mitred_plates_meet_in_the_nodes_of_the_structure_and_of_its_offset(name):
    structure = STRUCTURES[name]
    plates = made(structure, "outer")
    vertex = structure.topology.corners.vertex
    inner = ~structure.topology.is_boundary[vertex]
    assert np.abs(plates.lower - structure.vertices[vertex]).max() == 0
    moved = structure.offset(plates.cut.thickness).vertices[vertex]
    assert np.abs(plates.upper - moved)[inner].max() < 1e-11


@pytest.mark.parametrize("side", ["outer", "inner", "both"])
def test_walls_lean_by_the_bevel_and_plates_are_as_thick_as_asked(side):
    plates = STRUCTURES["conics"].plates(0.004, side=side)
    lower, upper = plates.flat
    following = plates.cut.outlines.following
    along = lower[following] - lower
    inward = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.hypot(*along.T)[:, None]
    run = ((upper - lower) * inward).sum(axis=1)
    assert np.abs(np.arctan2(run, 0.004) - plates.bevels).max() < 1e-9
    folds = fold_angles(plates.structure.topology, plates.structure.vertices)
    assert np.sort(2 * np.abs(plates.bevels)) == pytest.approx(np.sort(np.abs(folds[plates.cut.outlines.edge])), abs=1e-12)


def test_neighbours_know_each_other_and_strips_are_those_between_creases():
    plates = made(STRUCTURES["cones"], "outer")
    face, neighbour = plates.structure.topology.corners.face, plates.neighbours
    pairs = set(zip(face[neighbour >= 0].tolist(), neighbour[neighbour >= 0].tolist(), strict=True))
    assert pairs == {(b, a) for a, b in pairs}
    assert np.array_equal(plates.strips, np.repeat(np.arange(5), 23))


@pytest.mark.parametrize("cut", ["outer", "inner", "both", "hinged", "film"])
@pytest.mark.parametrize("name", ["cones", "conics", "vertex"])
def test_thickness_limits_are_sharp_and_named(name, cut):
    structure = STRUCTURES[name]
    _, gap, side, hinged = CUTS[cut]
    gap *= structure.mean_edge
    limit = structure.plates(1e-6, gap=gap, side=side, hinged=hinged).cut.largest_thickness
    structure.plates(limit * (1 - 1e-7), gap=gap, side=side, hinged=hinged)
    with pytest.raises(InvalidDesign, match="largest possible thickness is") as caught:
        structure.plates(limit * (1 + 1e-7), gap=gap, side=side, hinged=hinged)
    named = float(re.search(r"is ([\d.]+)$", str(caught.value))[1])
    assert named == pytest.approx(limit, rel=1e-4)
    structure.plates(named, gap=gap, side=side, hinged=hinged)


def test_beyond_the_limit_hinged_plates_really_intersect():
    plates = made(STRUCTURES["cones"], "hinged")
    thick = plates.cut.with_thickness(plates.cut.largest_thickness * 1.01)
    lower, upper = thick.solids()
    assert overlaps(plates, lower, upper).max() > 1e-9 * plates.volumes.max()


def test_a_hinge_closes_where_the_closed_form_says():
    # both crease edges fold by 1 rad; on both sides of the film each half may be (g/2) cot(1/2) thick
    plates = conical_vertex(fold=1.0).plates(0.01, gap=0.1, side="both", hinged=True)
    assert plates.cut.largest_thickness == pytest.approx(2 * 0.05 / np.tan(0.5), rel=1e-12)


@pytest.mark.parametrize("name", ["cones", "miura", "vertex", "conics"])
def test_hinged_plates_stay_disjoint_in_their_whole_free_range(name):
    plates = made(STRUCTURES[name], "hinged")
    free = hinged_range(plates)
    assert free.low == 0
    percent = np.linspace(1e-6, free.high, 4)
    for lower, upper in zip(*placed(plates, plates.structure.flex(percent)), strict=True):
        assert overlaps(plates, lower, upper).max(initial=0) <= 1e-9 * plates.volumes.max()
    lower, upper = placed(plates, plates.structure.flex(free.high + 1))
    assert overlaps(plates, lower[0], upper[0]).max() > 1e-9 * plates.volumes.max()
    assert len(free.reasons) == 1


def test_the_named_thickness_lets_plates_follow_the_bare_faces():
    structure = STRUCTURES["cones"]
    free = hinged_range(made(structure, "hinged"))
    assert free.high < free.faces.high
    thin = structure.plates(free.thickness_for_faces * (1 - 1e-9), gap=0.2 * structure.mean_edge, hinged=True)
    again = hinged_range(thin)
    assert again.high == pytest.approx(free.faces.high, abs=0.1)  # ends are searched to 0.1 percent
    lower, upper = placed(thin, structure.flex(again.high))
    assert overlaps(thin, lower[0], upper[0]).max() <= 1e-9 * thin.volumes.max()


def test_hinged_plates_stand_the_gap_apart_on_the_flat_film():
    from plisse.draw.plates import film

    plates = made(STRUCTURES["conics"], "film")
    outlines = [shapely.Polygon(line.points) for line in film(plates).layer("plate").lines]
    face = plates.structure.topology.corners.face
    for a, b in zip(face.tolist(), plates.neighbours.tolist(), strict=True):
        if a < b:
            assert outlines[a].distance(outlines[b]) == pytest.approx(plates.cut.gap, rel=1e-9)
    assert sum(outline.area for outline in outlines) == pytest.approx(plates.areas.sum(), rel=1e-9)


def test_plates_that_are_no_neighbours_are_kept_apart_too():
    nearly_closed = alternating_cones(sector=2 * np.pi - 0.002)
    nearly_closed.plates(1e-4)
    with pytest.raises(InvalidDesign, match=r"plates \d+ and \d+ would run into each other") as caught:
        nearly_closed.plates(0.1)
    named = float(re.search(r"is ([\d.e-]+)$", str(caught.value))[1])
    plates = nearly_closed.plates(named)
    assert overlaps(plates).max(initial=0) <= 1e-9 * plates.volumes.max()
    lower, upper = plates.cut.with_thickness(named * 1.01).solids()
    assert overlaps(plates, lower, upper).max() > 1e-12 * plates.volumes.max()


def test_slim_plates_are_named():
    structure = STRUCTURES["cones"]
    gap = 0.97 * structure.plates(1e-6).cut.largest_gap
    slim = structure.plates(0.03, gap=gap, hinged=True)
    assert re.match(r"plate \d+ and \d+ more would be slim", slim.warnings[0])
    assert slim.widths.min() < 0.03
    assert not structure.plates(0.004, gap=0.02, hinged=True).warnings


@pytest.mark.parametrize(("arguments", "sentence"), [
    ({"thickness": 0.0}, "positive"), ({"thickness": np.inf}, "positive"),
    ({"thickness": 0.01, "gap": -1.0}, "not negative"), ({"thickness": 0.01, "gap": 9.0}, "largest possible gap"),
    ({"thickness": 0.01, "hinged": True}, "need a gap"),
    ({"thickness": 0.01, "side": "left"}, "inner, outer or both"),
])
def test_impossible_plates_are_one_sentence(arguments, sentence):
    with pytest.raises(InvalidDesign, match=sentence) as caught:
        STRUCTURES["cones"].plates(**arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("hinged", [False, True])
def test_plates_need_a_principal_structure(hinged):
    with pytest.raises(InvalidStructure, match=r"opposite angles miss π by .* at vertex"):
        marched().plates(0.01, gap=0.02, hinged=hinged)


def test_mitred_plates_do_not_move():
    with pytest.raises(InvalidDesign, match="mitred"):
        hinged_range(made(STRUCTURES["cones"], "outer"))


def test_separating_axes_agree_with_manifold3d_on_random_solids():
    rng = np.random.default_rng(3)
    turn = np.linspace(0, 2 * np.pi, 4, endpoint=False)
    outline = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    lower = np.array([outline @ np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(40)])
    up = np.cross(lower[:, 1] - lower[:, 0], lower[:, 2] - lower[:, 1])
    lower = lower + rng.uniform(0, 4, (40, 1, 3))
    upper = 0.8 * (lower - lower.mean(axis=1, keepdims=True)) + lower.mean(axis=1, keepdims=True) + 0.2 * up[:, None]
    faces = np.array([[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], *[t for k in range(4) for t in (
        [k, (k + 1) % 4, 4 + (k + 1) % 4], [k, 4 + (k + 1) % 4, 4 + k])]], np.uint64)
    bodies = [manifold3d.Manifold(manifold3d.Mesh64(np.concatenate(pair), faces)) for pair in zip(lower, upper, strict=True)]
    every = np.array([(a, b) for a in range(40) for b in range(a + 1, 40)])
    found = {tuple(pair) for pair in ConvexSolids(lower, upper).overlapping(every, 1e-9).tolist()}
    expected = {(a, b) for a, b in every.tolist() if abs((bodies[a] ^ bodies[b]).volume()) > 1e-12}
    assert found == expected
    assert 5 < len(found) < len(every) / 2


def test_the_largest_thickness_is_the_same_whoever_says_it():
    nearly_closed = alternating_cones(sector=2 * np.pi - 0.002)
    said = nearly_closed.plates(1e-4).largest_thickness
    assert said < nearly_closed.plates(1e-4).cut.largest_thickness
    for thickness in (1.01 * said, 1e3 * nearly_closed.diagonal):
        with pytest.raises(InvalidDesign, match="largest possible thickness is") as caught:
            nearly_closed.plates(thickness)
        assert float(str(caught.value).split()[-1]) == pytest.approx(said, rel=1e-4)  # five digits are printed
    nearly_closed.plates(0.9999 * said)
