"""Files of plates, read back by trimesh, lib3mf and Python's own csv and json."""

import csv
import json

import numpy as np
import pytest
import shapely
import trimesh

from plisse.errors import InvalidDesign
from plisse.io.plate_solids import require_format, write_plate_solids, write_solid_stl
from plisse.io.plate_table import plates_document, write_plates_csv, write_plates_json
from plisse.structure.exact import alternating_cones
from plisse.transform.hinged_range import hinged_range
from plisse.transform.solids import solids

PLATES = alternating_cones(4, 9).plates(0.02, gap=0.01, side="both")


@pytest.mark.parametrize(("name", "units", "scale"), [("a.obj", "cm", 1.0), ("a.stl", "cm", 10.0), ("a.glb", "cm", 0.01)])
def test_trimesh_reads_closed_solids_of_the_right_volume(tmp_path, name, units, scale):
    write_plate_solids(PLATES, tmp_path / name, title="cones", units=units)
    body = trimesh.load_scene(tmp_path / name).to_geometry()
    body.merge_vertices(merge_norm=True)
    assert body.is_watertight
    assert body.volume == pytest.approx(PLATES.volumes.sum() * scale**3, rel=1e-5)  # STL and GLB keep seven digits


def test_obj_has_a_group_per_plate_and_all_digits(tmp_path):
    write_plate_solids(PLATES, tmp_path / "a.obj")
    lines = (tmp_path / "a.obj").read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if line.startswith("g ")] == [f"g plate_{k:02d}" for k in range(1, 25)]
    points = np.array([line.split()[1:] for line in lines if line.startswith("v ")], float)
    assert np.array_equal(points, np.concatenate([part.vertices for part in solids(PLATES)]))
    assert sum(line.startswith("f ") for line in lines) == 24 * 6


def test_glb_has_a_named_node_per_plate(tmp_path):
    write_plate_solids(PLATES, tmp_path / "a.glb")
    scene = trimesh.load_scene(tmp_path / "a.glb")
    assert sorted(scene.graph.nodes_geometry) == [f"plate_{k:02d}" for k in range(1, 25)]


def test_lib3mf_finds_a_closed_object_per_plate(tmp_path):
    lib3mf = pytest.importorskip("lib3mf")
    write_plate_solids(PLATES, tmp_path / "a.3mf", title="cones & co", units="in")
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(tmp_path / "a.3mf"))
    assert model.GetUnit() == lib3mf.ModelUnit.Inch
    meshes = model.GetMeshObjects()
    count = 0
    while meshes.MoveNext():
        count += 1
        assert meshes.GetCurrentMeshObject().IsManifoldAndOriented()
    assert count == PLATES.count == model.GetBuildItems().Count()


def test_one_plate_as_stl_is_closed(tmp_path):
    write_solid_stl(solids(PLATES)[3], tmp_path / "a.stl", "m")
    body = trimesh.load_mesh(tmp_path / "a.stl")
    assert body.is_watertight
    assert body.volume == pytest.approx(1e9 * PLATES.volumes[3], rel=1e-5)  # STL keeps seven digits


def test_two_writes_give_the_same_bytes(tmp_path):
    for suffix in (".obj", ".stl", ".glb", ".3mf"):
        write_plate_solids(PLATES, tmp_path / f"a{suffix}")
        write_plate_solids(PLATES, tmp_path / f"b{suffix}")
        assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_the_csv_is_one_row_per_edge_from_which_plates_can_be_cut(tmp_path):
    write_plates_csv(PLATES, tmp_path / "a.csv")
    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4 * PLATES.count
    sides = {(row["plate"], row["neighbour"]): row for row in rows if row["kind"] != "boundary"}
    for (plate, neighbour), row in sides.items():
        other = sides[neighbour, plate]
        assert (row["kind"], row["fold_deg"], row["bevel_deg"]) == (other["kind"], other["fold_deg"], other["bevel_deg"])
        assert float(row["bevel_deg"]) == pytest.approx(float(row["fold_deg"]) / 2, abs=1e-8)  # nine decimals
    first = shapely.Polygon([(float(row["x_upper"]), float(row["y_upper"])) for row in rows[:4]])
    assert first.exterior.is_ccw
    lower = shapely.Polygon([(float(row["x"]), float(row["y"])) for row in rows[:4]])
    assert max(first.area, lower.area) == pytest.approx(PLATES.areas[0], rel=1e-7)


def test_the_json_says_what_was_made_and_every_plate(tmp_path):
    hinged = alternating_cones(4, 9).plates(0.01, gap=0.04, hinged=True)
    movement = hinged_range(hinged)
    document = plates_document(hinged, movement, units="cm", title="cones")
    write_plates_json(document, tmp_path / "a.json")
    read = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert read == json.loads(json.dumps(document))
    assert read["plates"] == len(read["table"]) == 24
    assert read["free_range_percent"] == [movement.low, movement.high]
    assert read["units"] == "cm" and read["largest_thickness"] > 0.01
    assert read["table"][0]["neighbour"] == [None, 2, 9, None]
    assert sum(entry["volume"] for entry in read["table"]) == pytest.approx(read["total_volume"], rel=1e-7)


def test_other_formats_are_refused():
    with pytest.raises(InvalidDesign, match=r"\.obj, \.stl, \.glb, \.3mf"):
        require_format("a.step")
