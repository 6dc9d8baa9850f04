import numpy as np
import pytest

from plisse.draw.drawing import captioned, crease_pattern
from plisse.errors import InvalidStructure
from plisse.measure.folds import fold_angles
from plisse.structure.front import front_up
from plisse.structure.pleated import PleatedStructure


def test_mountains_and_valleys_alternate_across_the_sheet(cones):
    drawing = crease_pattern(cones)
    assert len(drawing.layer("mountain").lines) == 3
    assert len(drawing.layer("valley").lines) == 2


def test_a_crease_that_turns_from_mountain_to_valley_is_split_there(cones):
    bent = cones.vertices.reshape(7, 25, 3).copy()
    bent[3, :12, 2] = 16 - bent[3, :12, 2] - 3 * (8 - bent[2, :12, 2])
    bent[3, :12, 2] = -8.0
    subject = PleatedStructure(cones.topology, bent.reshape(-1, 3), development=cones.development)
    signs = np.sign(fold_angles(subject.topology, subject.vertices))[subject.topology.edges.is_crease]
    assert {-1, 1} <= set(signs)
    drawing = crease_pattern(subject)
    pieces = sum(len(drawing.layer(name).lines) for name in ("mountain", "valley", "flat"))
    assert pieces > 5


def test_the_size_is_the_sheet_and_its_margins_in_millimetres(cones):
    drawing = crease_pattern(cones, "cm", margin=7.0)
    assert np.allclose(drawing.size, 10 * np.ptp(cones.development, axis=0) + 14, rtol=1e-12)


def test_a_cut_structure_is_drawn_with_both_sides_of_its_cut(closed_cones):
    boundary, = crease_pattern(closed_cones).layer("boundary").lines
    assert boundary.closed and len(boundary.points) == 2 * 25 + 2 * 3


def test_the_front_is_up_and_lengths_survive_mirroring(cones):
    mirrored = PleatedStructure(cones.topology, cones.vertices, development=cones.development * [1.0, -1.0])
    flat = front_up(mirrored)
    a, b = cones.topology.edges.vertices.T
    assert np.allclose(np.linalg.norm(flat[a] - flat[b], axis=1),
                       np.linalg.norm(cones.vertices[a] - cones.vertices[b], axis=1), rtol=1e-12)


def test_without_development_there_is_nothing_to_draw(cones):
    with pytest.raises(InvalidStructure, match="flatten"):
        crease_pattern(cones.with_vertices(cones.vertices))


def test_the_caption_stands_in_the_margin_and_only_where_there_is_room(cones):
    drawing = crease_pattern(cones, title="fan")
    text, = captioned(drawing).layer("text").texts
    assert text.words.startswith("fan") and f"{drawing.size[0]:.1f} × {drawing.size[1]:.1f} mm" in text.words
    assert text.at[1] > 0 and text.at[1] + text.height < 5
    assert captioned(crease_pattern(cones, title="long " * 60)).layer("text").texts == ()
