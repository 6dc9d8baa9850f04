"""Pictures of a motion."""

import numpy as np
import pytest
from PIL import Image

from plisse.draw.animation import write_gif
from plisse.draw.cones import with_cone
from plisse.draw.motion import shown_percents, write_motion_strip
from plisse.geometry.vectors import dot, norm
from plisse.measure.planarity import face_normals
from plisse.structure.exact import conical_vertex, miura


def test_the_strip_shows_paper_beside_the_table(tmp_path):
    write_motion_strip(miura().flex([0, 75, 150]), tmp_path / "strip.png", title="miura")
    with Image.open(tmp_path / "strip.png") as image:
        assert image.width == 2400
        assert len(image.convert("RGB").resize((200, 80)).getcolors(16_000)) > 500


@pytest.mark.parametrize(("given", "shown"), [
    (np.linspace(0, 200, 20), [0, 50, 100, 150, 200]), (np.linspace(0, 150, 30), [0, 37.5, 75, 100, 150]),
    ([0, 50, 150], [0, 50, 100, 150]), (np.linspace(0, 80, 9), [0, 20, 40, 60, 80]), ([30], [30])])
def test_pictures_show_the_designed_state_among_even_ones(given, shown):
    assert shown_percents(np.array(given, float)) == pytest.approx(shown)


def test_the_animation_goes_to_and_fro_without_end(tmp_path):
    write_gif(miura().flex([0, 40, 80, 120]), tmp_path / "motion.gif")
    with Image.open(tmp_path / "motion.gif") as image:
        assert image.n_frames == 6
        assert image.info["loop"] == 0
        frames = []
        for k in range(6):
            image.seek(k)
            frames.append(np.asarray(image.convert("RGB"), float))
    assert np.array_equal(frames[1], frames[5])
    assert np.abs(frames[0] - frames[3]).max() > 50


@pytest.mark.parametrize("percent", [30, 100, 150])
def test_the_cone_touches_all_four_faces(percent):
    state = conical_vertex().flex(percent).structures[0]
    centre = int(np.flatnonzero(~state.topology.is_boundary)[0])
    drawn = with_cone(state, centre)
    assert len(drawn.vertices) > len(state.vertices)
    lines = drawn.vertices[len(state.vertices):] - state.vertices[centre]
    lines = lines / norm(lines)[:, None]
    for normal in face_normals(state.topology, state.vertices):
        heights = dot(lines, normal[None])
        # one generator lies in the plane, all others on one side of it; 96 generators meet it to 1/2 (π/96)²
        assert min(abs(heights.min()), abs(heights.max())) < 1e-3


def test_a_flat_vertex_has_no_cone():
    state = conical_vertex().flex(0).structures[0]
    assert with_cone(state, 4) is state
