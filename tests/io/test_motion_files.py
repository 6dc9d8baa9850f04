"""Motions as files: FOLD frames, binary glTF with morph targets, one OBJ per state."""

import json
import struct

import numpy as np
import pytest
import trimesh

from plisse.assess import assess
from plisse.geometry.vectors import norm
from plisse.io.fold import read_fold
from plisse.io.glb import motion_glb, write_motion_glb
from plisse.io.motion import frame_names, write_motion_fold, write_motion_objs
from plisse.io.obj import read_obj
from plisse.structure.exact import alternating_cones, conical_vertex, miura

PERCENT = [0.0, 50.0, 100.0, 150.0]


@pytest.fixture(scope="module")
def motion():
    return alternating_cones(5, 16, sector=1.6).flex(PERCENT)


def test_every_state_is_a_folded_frame_with_its_percent_as_title(motion, tmp_path):
    write_motion_fold(motion, tmp_path / "motion.fold", title="cones", units="cm")
    document = json.loads((tmp_path / "motion.fold").read_text())
    frames = document["file_frames"]
    assert [frame["frame_title"] for frame in frames] == ["0", "50", "100", "150"]
    assert all(frame["frame_classes"] == ["foldedForm"] and frame["frame_inherit"] for frame in frames)
    assert document["frame_classes"] == ["creasePattern"]
    assert document["frame_unit"] == "cm"
    flat = np.array(document["vertices_coords"])
    a, b = np.array(document["edges_vertices"]).T
    for frame in frames:
        points = np.array(frame["vertices_coords"])
        assert np.abs(norm(points[a] - points[b]) - norm(flat[a] - flat[b])).max() < 1e-12


def test_fold_angles_of_frames_are_those_of_their_own_state(motion, tmp_path):
    write_motion_fold(motion, tmp_path / "motion.fold")
    document = json.loads((tmp_path / "motion.fold").read_text())
    designed = np.tan(np.radians(document["edges_foldAngle"]) / 2)
    for frame in document["file_frames"]:
        factor = np.tan(np.pi * frame["frame_plisse:percent"] / 400)
        assert np.abs(np.tan(np.radians(frame["edges_foldAngle"]) / 2) - factor * designed).max() < 1e-11


def test_a_motion_is_read_as_its_designed_state(motion, tmp_path):
    write_motion_fold(motion, tmp_path / "motion.fold")
    read = read_fold(tmp_path / "motion.fold")
    assert np.abs(read.vertices - motion.vertices[2]).max() < 1e-12
    report = assess(read)
    assert report.status == "exact"
    assert report.principal


@pytest.mark.parametrize("percent", [3.0, 80.0, 170.0])
def test_one_written_state_is_exact_principal_and_has_the_same_sheet(percent, tmp_path):
    cones = alternating_cones(5, 16, closed=True)
    motion = cones.flex(percent)
    write_motion_fold(motion, tmp_path / "state.fold")
    read = read_fold(tmp_path / "state.fold")
    report = assess(read)
    assert report.principal
    assert report.isometry < 1e-9
    far = np.triu_indices(len(read.development), 1)
    own, first = (norm(flat[far[0]] - flat[far[1]]) for flat in (read.development, cones.development))
    assert np.abs(own - first).max() < 1e-9 * first.max()


def test_one_obj_per_state(motion, tmp_path):
    write_motion_objs(motion, tmp_path, title="cones")
    assert frame_names(motion) == ["000.obj", "001.obj", "002.obj", "003.obj"]
    for name, vertices in zip(frame_names(motion), motion.vertices, strict=True):
        assert np.array_equal(read_obj(tmp_path / name).vertices, vertices)


def test_other_readers_see_the_designed_state_in_metres_with_y_up(motion, tmp_path):
    write_motion_glb(motion, tmp_path / "motion.glb", units="cm")
    scene = trimesh.load(tmp_path / "motion.glb")
    paper = max((mesh for mesh in scene.geometry.values() if hasattr(mesh, "faces")), key=lambda mesh: len(mesh.faces))
    assert len(paper.faces) == 2 * motion.topology.face_count
    wanted = motion.mechanism.designed[:, [0, 2, 1]] * [1, 1, -1] / 100
    low, high = wanted.min(axis=0), wanted.max(axis=0)
    assert np.abs(paper.bounds - [low, high]).max() < 1e-6  # single precision
    assert abs(paper.area - _area(motion) / 1e4) < 1e-5 * paper.area


def _area(motion):
    from plisse.measure.planarity import face_areas

    return face_areas(motion.topology, motion.mechanism.designed).sum()


class Glb:
    """An independent reader: chunks, accessors, morph targets."""

    def __init__(self, data):
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        assert size % 4 == 0
        self.document = json.loads(data[20:20 + size])
        length, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0"
        self.binary = data[28 + size:]
        assert len(self.binary) == length == self.document["buffers"][0]["byteLength"]

    def array(self, accessor):
        entry = self.document["accessors"][accessor]
        view = self.document["bufferViews"][entry["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        dtype = {5126: "<f4", 5125: "<u4"}[entry["componentType"]]
        width = {"VEC3": 3, "SCALAR": 1}[entry["type"]]
        assert view["byteLength"] == 4 * width * entry["count"]
        values = np.frombuffer(self.binary, dtype, entry["count"] * width, view["byteOffset"]).reshape(-1, width)
        if "min" in entry:
            assert np.array_equal(values.min(axis=0), np.float32(entry["min"]))
            assert np.array_equal(values.max(axis=0), np.float32(entry["max"]))
        return values

    def played(self, primitive, time):
        """Positions of a primitive at a time of the animation."""
        sampler = self.document["animations"][0]["samplers"][0]
        times, targets = self.array(sampler["input"])[:, 0], primitive["targets"]
        weights = self.array(sampler["output"]).reshape(len(times), len(targets))
        weight = [np.interp(time, times, column) for column in weights.T]
        positions = self.array(primitive["attributes"]["POSITION"])
        return positions + sum(w * self.array(t["POSITION"]) for w, t in zip(weight, targets, strict=True)), times


def test_the_animation_runs_through_all_states_and_back(motion):
    glb = Glb(motion_glb(motion, units="m"))
    primitives = glb.document["meshes"][0]["primitives"]
    assert [primitive["mode"] for primitive in primitives] == [4, 1, 1]
    assert len({len(primitive["targets"]) for primitive in primitives}) == 1
    corners = motion.topology.corners.vertex
    _, times = glb.played(primitives[0], 0)
    for k, time in zip([0, 1, 2, 3, 2, 1, 0], times, strict=True):
        shown = glb.played(primitives[0], time)[0][:, [0, 2, 1]] * [1, -1, 1]
        assert np.abs(shown - motion.vertices[k][corners]).max() < 1e-6 * 4  # single precision, coordinates up to 4


def test_normals_of_the_animation_belong_to_the_faces(motion):
    glb = Glb(motion_glb(motion, units="m"))
    paper = glb.document["meshes"][0]["primitives"][0]
    triangles = glb.array(paper["indices"]).reshape(-1, 3)
    for target in [None, *paper["targets"]]:
        positions, normals = (glb.array(paper["attributes"][name]) + (0 if target is None else glb.array(target[name]))
                              for name in ("POSITION", "NORMAL"))
        a, b, c = positions[triangles[:, 0]], positions[triangles[:, 1]], positions[triangles[:, 2]]
        cross = np.cross(b - a, c - a)
        cross /= norm(cross)[:, None]
        for k in range(3):
            assert np.abs(cross - normals[triangles[:, k]]).max() < 1e-4  # single precision over the size of a face


def test_materials_are_two_sided(motion):
    document = Glb(motion_glb(motion)).document
    assert all(material["doubleSided"] for material in document["materials"])


def test_a_single_state_stands_still():
    document = Glb(motion_glb(conical_vertex().flex(40))).document
    assert "animations" not in document
    assert "targets" not in document["meshes"][0]["primitives"][0]


def test_equal_motions_give_equal_bytes():
    assert motion_glb(miura().flex([0, 100])) == motion_glb(miura().flex([0, 100]))
