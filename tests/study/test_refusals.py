"""What becomes of designs that are refused, by whose fault it is."""

import pytest

from plisse.errors import MissingExtra
from plisse.memory import CHOSEN
from plisse.study.child import attempted

ROOM = 2**33
CONES = {"closed_form": {"kind": "cones", "creases": 4, "samples": 12, "sector": 90}}


def test_a_design_for_which_a_worker_has_no_memory_may_be_tried_again(monkeypatch):
    monkeypatch.setenv(CHOSEN, "0.05")
    outcome = attempted(CONES, ROOM)
    assert outcome.status == "memory" and "the limit is 0.05 GB" in outcome.reasons[0]


def test_a_design_for_which_a_worker_has_no_library_has_failed(monkeypatch):
    def missing(recipe, forecast):
        raise MissingExtra("meshes need trimesh")

    monkeypatch.setattr("plisse.study.child._made", missing)
    assert attempted(CONES, ROOM).status == "failed"


def test_a_mesh_that_a_worker_does_not_have_is_no_mistake_of_the_recipe_and_a_bad_one_is(tmp_path):
    recipe = {"surface": {"file": str(tmp_path / "roof.obj")}, "pattern": {"width": 5}}
    outcome = attempted(recipe, ROOM)
    assert outcome.status == "failed" and "roof.obj" in outcome.reasons[0]
    (tmp_path / "roof.obj").write_text("no mesh")
    assert attempted(recipe, ROOM).status == "invalid"


@pytest.mark.parametrize("wrong", [{"kind": "none"}, {"kind": "cones", "slope": -1.0}])
def test_a_recipe_that_cannot_be_is_invalid_wherever_it_is_made(wrong):
    assert attempted({"closed_form": wrong}, ROOM).status == "invalid"
