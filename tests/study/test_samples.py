import tomllib

import numpy as np
import pytest

from plisse.errors import InvalidDesign
from plisse.io.designs import design_from_dict
from plisse.study.plan import read_plan
from plisse.study.samples import samples
from plisse.study.values import assignments, read_block

BOUNDS = {"closed_form": {"slope": {"low": 0.2, "high": 2.2}, "width": {"low": 4, "high": 8}}, "samples": 40, "seed": 7}


def drawn(block):
    return assignments(read_block(block))


def test_the_same_plan_gives_the_same_designs_with_the_same_keys(study):
    study["vary"] = BOUNDS
    first, second = samples(read_plan(study)), samples(read_plan(study))
    assert first == second
    assert len({sample.key for sample in first}) == 40


def test_a_grid_holds_every_combination_once(study):
    found = samples(read_plan(study))
    pairs = [(s.recipe["closed_form"]["slope"], s.recipe["closed_form"]["width"]) for s in found]
    assert pairs == [(slope, width) for slope in (0.5, 1.0) for width in (4, 6, 8)]


def test_every_recipe_is_a_whole_design(study):
    for sample in samples(read_plan(study)):
        assert design_from_dict(sample.recipe).to_dict() == sample.recipe


def test_keys_tell_designs_apart_and_not_how_they_were_written(study):
    grid = samples(read_plan(study))
    width = {"start": 4, "stop": 8, "count": 3}
    other = {**study, "vary": [{"closed_form": {"slope": [slope], "width": width}} for slope in (1, 0.5)]}
    assert {sample.key for sample in samples(read_plan(other))} == {sample.key for sample in grid}
    wider = {**study, "base": {"closed_form": {**study["base"]["closed_form"], "sector": 91}}}
    assert not {sample.key for sample in samples(read_plan(wider))} & {sample.key for sample in grid}


def test_a_latin_hypercube_puts_one_sample_into_each_part_of_each_key():
    shares = np.array([list(values.values()) for values in drawn(BOUNDS)])
    for column, (low, high) in zip(shares.T, ((0.2, 2.2), (4, 8)), strict=True):
        assert sorted(np.floor((column - low) / (high - low) * 40).astype(int)) == list(range(40))


def test_random_samples_keep_their_beginning_when_more_are_asked_for():
    few, many = (drawn({**BOUNDS, "method": "random", "samples": count}) for count in (5, 50))
    assert many[:5] == few


def test_steps_of_a_tenth_look_like_it():
    found = drawn({"a.b": {"low": 0, "high": 1, "step": 0.1}, "samples": 400, "method": "random"})
    assert {str(values["a.b"]) for values in found} >= {"0.3", "0.7"} and all(len(str(v["a.b"])) <= 3 for v in found)


@pytest.mark.parametrize("method", ["random", "latin-hypercube"])
def test_another_seed_gives_other_samples_between_the_bounds(method):
    one, other = (drawn({**BOUNDS, "method": method, "seed": seed}) for seed in (1, 2))
    assert one != other
    assert all(0.2 <= values["closed_form.slope"] <= 2.2 for values in one + other)


def test_samples_are_combined_with_every_value_of_lists():
    found = drawn({**BOUNDS, "closed_form.creases": [4, 5]})
    assert [values["closed_form.creases"] for values in found] == [4] * 40 + [5] * 40
    assert found[0]["closed_form.slope"] == found[40]["closed_form.slope"]


def test_ranges_include_both_ends_evenly_or_by_equal_ratios():
    ranges = {"a.b": {"start": 1, "stop": 100, "count": 3, "scale": "log"}}
    assert [values["a.b"] for values in drawn(ranges)] == [1, 10, 100]
    assert [values["a.b"] for values in drawn({"a.b": {"start": 0.1, "stop": 0.3, "count": 3}})] == [0.1, 0.2, 0.3]


def test_steps_between_bounds_are_whole_numbers_that_all_occur():
    found = drawn({"a.b": {"low": 5, "high": 8, "step": 1}, "samples": 400, "method": "random"})
    assert {values["a.b"] for values in found} == {5, 6, 7, 8}
    assert all(type(values["a.b"]) is int for values in found)


def test_quoted_and_bare_dotted_keys_are_the_same():
    quoted, bare = (tomllib.loads(text) for text in ('"pattern.theta" = [1, 2]', "pattern.theta = [1, 2]"))
    assert drawn(quoted) == drawn(bare) == [{"pattern.theta": 1}, {"pattern.theta": 2}]


def test_tables_that_vary_stay_as_they_were_given(study):
    tables = [{**study["base"]["closed_form"], "width": width} for width in (4, 6)]
    given = [dict(table) for table in tables]
    study["vary"] = {"closed_form": tables, "closed_form.slope": [0.5, 1.0]}
    found = samples(read_plan(study))
    assert tables == given
    assert [sample.parameters["closed_form"] for sample in found] == [given[0], given[0], given[1], given[1]]
    assert [sample.recipe["closed_form"]["slope"] for sample in found] == [0.5, 1.0, 0.5, 1.0]


def test_a_study_is_a_table_or_a_file():
    with pytest.raises(InvalidDesign, match="a study is 7"):
        read_plan(7)


def test_one_impossible_value_is_marked_and_the_others_stay(study):
    study["vary"] = {"closed_form.slope": [0.5, -1.0]}
    good, bad = samples(read_plan(study))
    assert good.mistake is None
    assert "closed_form.slope" in bad.mistake and "-1.0" in bad.mistake


@pytest.mark.parametrize(("change", "words"), [
    ({"vary": {"closed_form.slop": [1, 2]}}, "closed_form.slop is not a key of a design"),
    ({"vary": {"closed_form.slope": []}}, "vary.closed_form.slope is"),
    ({"vary": {"closed_form.slope": 3}}, "vary.closed_form.slope is 3; give a list"),
    ({"vary": {"closed_form.slope": {"low": 1, "high": 2}}}, "vary.samples is missing"),
    ({"vary": {"closed_form.slope": [1], "samples": 3}}, "no key has bounds"),
    ({"vary": {"closed_form.slope": {"low": 2, "high": 1}, "samples": 3}}, "low must be below high"),
    ({"vary": {"closed_form.slope": {"start": 1, "stop": 2}}}, "missing required field `count`"),
    ({"vary": {"closed_form.slope": {"low": 0, "high": 1, "scale": "log"}, "samples": 3}}, "logarithmic"),
    ({"vary": {"closed_form.slope": {"low": 1, "high": 1e308, "step": 1e-300}, "samples": 3}}, "too small to be counted"),
    ({"vary": {"closed_form.sector": {"low": 20, "high": 21, "step": 5}, "samples": 4}}, "give a smaller step"),
    ({"vary": {"closed_form.slope": {"low": -1e308, "high": 1e308}, "samples": 3}}, "give ends that lie closer"),
    ({"vary": {"closed_form.slope": {"start": -1e308, "stop": 1e308, "count": 3}}}, "give ends that lie closer"),
    ({"vary": {"closed_form": {"slope": {"low": 1, "hihg": 2}}, "samples": 3}}, "field `hihg`; known here: low, high"),
    ({"vary": {"closed_form.slope": {"low": 1, "high": 2}, "samples": 3, "method": "sobol"}},
     'vary.method: invalid enum value \'sobol\'; give "latin-hypercube" or "random"'),
    ({"vary": {"closed_form.slope": {"low": "a", "high": 2}, "samples": 3}}, "low: expected a number, got text; give a"),
    ({"vary": {"slope": [1, 2]}}, "vary.slope names no section of a design; write closed_form.slope"),
    ({"vary": [{"closed_form.slope": {"start": 1, "stop": 2, "count": 600_000}}] * 2}, "1,200,000 designs"),
    ({"base": 7}, "base: expected text or a table, got a whole number; give a design file"),
    ({"folder": "/etc"}, "folder is not a key of a study; known here: base, vary"),
    ({"vary": {"closed_form.slope": {"low": 1, "high": 2, "step": 1, "scale": "log"}, "samples": 3}}, "both a step and"),
    ({"vary": {"closed_form.kind.x": [1]}}, "goes through kind"),
    ({"vary": {}}, "vary names no key"),
    ({"vary": []}, "vary is empty"),
    ({"base": "nowhere.toml"}, "nowhere.toml"),
    ({"limits": {"seconds": 0}}, "limits.seconds"),
    ({"limits": {"second": 10}}, "limits.second is not a key of a study; known here: seconds, memory"),
    ({"map": {"keys": ["a"]}}, "map.keys"),
    ({"map": {"keys": ["closed_form.slope", "pattern.theta"]}}, "map names pattern.theta"),
    ({"map": {"keys": ["closed_form.slope"] * 2}}, "map names closed_form.slope twice"),
    ({"map": {"keys": ["closed_form.slope", "closed_form.width"], "panels": "closed_form.width"}}, "width twice"),
    ({"map": {"keys": ["closed_form.slope", "closed_form.width"], "panels": "closed_form.sector"},
      "vary": {"closed_form.slope": [1, 2], "closed_form.sector": {"start": 30, "stop": 54, "count": 25}}},
     "has 25 values, and a map up to 24 panels"),
    ({"by": "beauty"}, "by: "),
    ({"vary": {"closed_form.slope": {"start": 1, "stop": 2, "count": 2000},
               "closed_form.width": {"start": 1, "stop": 2, "count": 2000}}}, "4,000,000 designs"),
])
def test_a_mistake_in_a_study_is_one_sentence_with_its_key(study, change, words):
    with pytest.raises(InvalidDesign) as caught:
        samples(read_plan({**study, **change}))
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_a_base_is_a_file_beside_the_study_or_a_name_of_the_gallery(tmp_path):
    (tmp_path / "base.toml").write_text('[closed_form]\nkind = "miura"\n')
    for name, key in (("base.toml", "closed_form.fold"), ("fig01d", "pattern.theta")):
        (tmp_path / "study.toml").write_text(f'base = "{name}"\n[vary]\n{key} = [20, 30]\n')
        assert len(samples(read_plan(tmp_path / "study.toml"))) == 2


def test_a_surface_is_known_by_its_contents_wherever_it_lies(tmp_path):
    keys = []
    for folder in ("here", "there"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        (tmp_path / folder / "study.toml").write_text('[base.surface]\nfile = "a.obj"\n[vary]\npattern.width = [1, 2]\n')
        keys.append([sample.key for sample in samples(read_plan(tmp_path / folder / "study.toml"))])
    assert keys[0] == keys[1] and len(set(keys[0])) == 2


def test_a_key_that_is_named_like_the_end_of_a_range_varies_in_every_form():
    words = ("closed_form.start = [1, 2]", "[closed_form]\nstart = [1, 2]", "closed_form = { start = [1, 2] }")
    assert all(drawn(tomllib.loads(text)) == [{"closed_form.start": 1}, {"closed_form.start": 2}] for text in words)
    ranged = drawn(tomllib.loads("closed_form.start = { start = 1, stop = 3, count = 2 }"))
    assert ranged == [{"closed_form.start": 1}, {"closed_form.start": 3}]


def test_designs_are_counted_before_any_is_made(study, monkeypatch):
    monkeypatch.setattr("plisse.study.samples.assignments", lambda block: pytest.fail("a design was made"))
    many = {"start": 1, "stop": 2, "count": 1_000_000}
    with pytest.raises(InvalidDesign, match="2,000,000 designs"):
        samples(read_plan({**study, "vary": [{"closed_form.slope": many}, {"closed_form.width": many}]}))


def test_a_mesh_that_has_changed_is_another_design(tmp_path):
    plan = {"base": {"surface": {"file": str(tmp_path / "a.obj")}}, "vary": {"pattern.width": [1, 2]}}
    keys = set()
    for height in (0, 1):
        (tmp_path / "a.obj").write_text(f"v 0 0 {height}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        keys |= {sample.key for sample in samples(read_plan(plan))}
    assert len(keys) == 4
