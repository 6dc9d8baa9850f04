import ezdxf
import numpy as np
import pytest

from plisse.errors import InvalidStructure, PlisseError
from plisse.io.exports import BOTH, FLAT, FOLDED, developed, export
from plisse.io.fold import read_fold
from plisse.io.model import Model
from plisse.measure.isometry import isometry_defect
from plisse.structure.pleated import PleatedStructure

SUFFIXES = [*FOLDED, *BOTH, *FLAT]


def bare(structure):
    """The structure as it comes from a mesh file: no development, no cut."""
    return PleatedStructure(structure.topology, structure.vertices)


def test_every_format_is_written_and_nothing_else(closed_cones, tmp_path):
    export(Model(closed_cones, "cm", "fan"), [tmp_path / f"s{suffix.upper()}" for suffix in SUFFIXES])
    assert {file.suffix.lower() for file in tmp_path.iterdir()} == set(SUFFIXES)
    assert all(file.stat().st_size > 400 for file in tmp_path.iterdir())
    assert len(list(tmp_path.iterdir())) == len(SUFFIXES)


def test_the_sheet_for_cad_has_the_five_layers(cones, tmp_path):
    export(Model(cones, "mm", "fan"), [tmp_path / "s.dxf"])
    document = ezdxf.readfile(tmp_path / "s.dxf")
    assert {"MOUNTAIN", "VALLEY", "CUT", "RULING", "TEXT"} <= {layer.dxf.name for layer in document.layers}
    text, = document.modelspace().query("TEXT")
    assert text.dxf.text.startswith("fan") and not document.audit().errors


@pytest.mark.parametrize("fixture", ["cones", "closed_cones"])
def test_meshes_without_a_sheet_get_one_where_a_format_needs_it(fixture, tmp_path, request):
    structure = request.getfixturevalue(fixture)
    export(Model(bare(structure)), [tmp_path / "s.fold", tmp_path / "s.pdf", tmp_path / "s.obj"])
    back = read_fold(tmp_path / "s.fold")
    assert np.array_equal(back.vertices, structure.vertices)
    assert isometry_defect(back.opened.topology, back.opened.vertices, back.development) < 1e-12
    assert back.cut.is_trivial == (fixture == "cones")


def test_what_does_not_lie_flat_has_no_sheet_but_still_a_shape(cones, tmp_path):
    bent = cones.vertices.copy()
    bent[3 * 25 + 12, 2] += 3.0
    model = Model(cones.with_vertices(bent))
    with pytest.raises(InvalidStructure, match=r"does not lie flat.*\.obj, \.ply, \.stl"):
        export(model, [tmp_path / "s.obj", tmp_path / "s.dxf"])
    assert list(tmp_path.iterdir()) == []
    export(model, [tmp_path / "s.obj", tmp_path / "s.stl"])
    assert len(list(tmp_path.iterdir())) == 2


def test_a_sheet_that_is_not_that_of_the_shape_is_refused(cones):
    wrong = PleatedStructure(cones.topology, cones.vertices, development=1.01 * cones.development)
    with pytest.raises(InvalidStructure, match="does not lie flat"):
        developed(Model(wrong))


@pytest.mark.parametrize(("name", "sentence"), [
    ("s.step", r"s\.step has no extension that plisse can export; give one of \.fold, \.3dm, \.obj"),
    ("s", "no extension"),
    ("missing/s.obj", "there is no directory"),
    ("folder.obj", "is a directory"),
    ("file.txt/s.obj", "no directory"),
])
def test_one_bad_target_is_one_sentence_and_no_file_at_all(cones, tmp_path, name, sentence):
    (tmp_path / "folder.obj").mkdir()
    (tmp_path / "file.txt").write_text("in the way")
    before = sorted(tmp_path.iterdir())
    with pytest.raises(PlisseError, match=sentence) as caught:
        export(Model(cones), [tmp_path / "good.svg", tmp_path / name])
    assert "\n" not in str(caught.value)
    assert sorted(tmp_path.iterdir()) == before


def test_a_writer_that_fails_leaves_the_older_files_as_they_were(cones, tmp_path):
    (tmp_path / "s.obj").write_text("old")
    with pytest.raises(PlisseError, match="PDF ends at"):
        export(Model(cones, "m"), [tmp_path / "s.obj", tmp_path / "s.pdf"])
    assert [file.read_text() for file in tmp_path.iterdir()] == ["old"]
