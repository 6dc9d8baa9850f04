import contextlib
import sqlite3

import pytest
from PIL import Image

from plisse.errors import PlisseError
from plisse.study import Study
from plisse.study.outcome import Outcome
from plisse.study.plan import read_plan
from plisse.study.samples import samples
from plisse.study.store import LOCK, STORE, Store, locked


@pytest.fixture
def planned(study):
    return samples(read_plan(study))


def test_designs_wait_in_their_order_until_their_outcome_is_committed(tmp_path, planned):
    with Store(tmp_path) as store:
        store.plan(planned)
        assert [key for key, _ in store.waiting()] == [sample.key for sample in planned]
        store.begun(planned[2].key)
        store.done(planned[2].key, Outcome(status="exact", reasons=[], numbers={"vertices": 12}, picture=b"png"))
    with Store(tmp_path) as store:
        assert planned[2].key not in dict(store.waiting())
        row = store.rows()[2]
        assert (row.status, row.attempts, row.numbers["vertices"]) == ("exact", 1, 12)
        assert store.pictures([planned[2].key, planned[3].key]) == {planned[2].key: b"png"}


def test_a_design_that_was_under_way_waits_again_and_its_attempt_is_remembered(tmp_path, planned):
    with Store(tmp_path) as store:
        store.plan(planned)
        store.begun(planned[0].key)
        assert len(store.waiting()) == len(planned) - 1
        store.plan(planned)
        assert len(store.waiting()) == len(planned)
        assert store.rows()[0].attempts == 1


def test_a_changed_study_adds_designs_keeps_results_and_forgets_what_never_ran(tmp_path, study, planned):
    other = samples(read_plan({**study, "vary": {"closed_form.slope": [1.0], "closed_form.width": [8, 10]}}))
    with Store(tmp_path) as store:
        store.plan(planned)
        for sample in planned[:2]:
            store.done(sample.key, Outcome(status="exact", reasons=[]))
        store.plan(other)
        rows = store.rows()
    assert {row.key for row in rows if row.status == "exact"} == {sample.key for sample in planned[:2]}
    assert {row.key for row in rows if row.status == "waiting"} == {sample.key for sample in other}


def test_designs_that_took_too_long_wait_again_only_when_asked(tmp_path, planned):
    with Store(tmp_path) as store:
        store.plan(planned)
        store.done(planned[0].key, Outcome(status="timeout", reasons=["it takes more than 1 second"]))
        store.plan(planned)
        assert planned[0].key not in dict(store.waiting())
        store.plan(planned, again=("timeout",))
        assert planned[0].key in dict(store.waiting())


def test_an_impossible_design_is_a_row_with_its_reason_from_the_start(tmp_path, study):
    with Store(tmp_path) as store:
        store.plan(samples(read_plan({**study, "vary": {"closed_form.slope": [0.5, -1]}})))
        row = store.rows()[1]
    assert row.status == "invalid" and "closed_form.slope" in row.reasons[0]


def test_two_studies_on_one_store_are_refused_with_a_sentence(tmp_path):
    with locked(tmp_path), pytest.raises(PlisseError, match=r"another study works in .*; wait"), locked(tmp_path):
        pass
    with locked(tmp_path):
        pass
    assert not any(tmp_path.iterdir())


def test_what_cannot_be_a_lock_is_a_sentence(tmp_path):
    (tmp_path / LOCK).mkdir()
    with pytest.raises(PlisseError, match=r"\.study\.lock cannot be locked .*; remove it"), locked(tmp_path):
        pass


def test_reading_a_store_writes_nothing(tmp_path, planned):
    with Store(tmp_path) as store:
        store.plan(planned)
        store.begun(planned[0].key)
        with Store(tmp_path, reading=True) as reader:  # what is committed is seen at once
            assert len(reader.rows()) == len(planned) and reader.rows()[0].status == "running"
    file, before = tmp_path / "study.sqlite", sorted(tmp_path.iterdir())
    file.chmod(0o444)
    tmp_path.chmod(0o555)
    try:
        with Store(tmp_path, reading=True) as store:
            assert len(store.rows()) == len(planned)
        assert sorted(tmp_path.iterdir()) == before
    finally:
        tmp_path.chmod(0o755)


@pytest.mark.parametrize("reading", [True, False])
def test_the_database_of_somebody_else_stays_as_it_is(tmp_path, reading):
    file = tmp_path / "study.sqlite"
    with contextlib.closing(sqlite3.connect(file)) as base:
        base.execute("CREATE TABLE songs (title)")
    before = file.read_bytes()
    with pytest.raises(PlisseError, match="not the store of a study"):
        Store(tmp_path, reading=reading)
    assert file.read_bytes() == before and list(tmp_path.iterdir()) == [file]


def test_what_is_no_store_is_refused_and_left_alone(tmp_path):
    (tmp_path / "study.sqlite").write_bytes(b"no database " * 100)
    with pytest.raises(PlisseError, match="not the store of a study"):
        Store(tmp_path)
    assert (tmp_path / "study.sqlite").read_bytes() == b"no database " * 100
    with sqlite3.connect(tmp_path / "other.sqlite") as base:
        base.execute("CREATE TABLE designs (something)")
    base.close()
    (tmp_path / "other.sqlite").replace(tmp_path / "study.sqlite")
    with pytest.raises(PlisseError, match="not the store of a study"):
        Store(tmp_path)


def test_the_values_that_vary_are_those_of_the_plan_that_asks_now(tmp_path, study, planned):
    fixed = {**study["base"]["closed_form"], "width": 4}
    other = samples(read_plan({"base": {"closed_form": fixed}, "vary": {"closed_form.slope": [1.0, 0.5]}}))
    assert {sample.key for sample in other} < {sample.key for sample in planned}
    with Store(tmp_path) as store:
        store.plan(planned)
        store.done(other[0].key, Outcome(status="exact", reasons=[]))
        store.plan(other)
    rows = Study.load(tmp_path, [sample.key for sample in other]).rows
    assert [row.parameters for row in rows] == [{"closed_form.slope": 1.0}, {"closed_form.slope": 0.5}]
    assert rows[0].status == "exact"


def test_a_store_that_another_program_holds_is_to_be_waited_for(tmp_path, planned):
    with Store(tmp_path) as store, contextlib.closing(sqlite3.connect(tmp_path / STORE, isolation_level=None)) as other:
        store.plan(planned)
        store._base.execute("PRAGMA busy_timeout = 10")
        other.execute("BEGIN EXCLUSIVE")
        with pytest.raises(PlisseError, match=r"another program works with .*; wait until .* run the same command again"):
            store.begun(planned[0].key)


def test_a_store_that_breaks_in_the_middle_is_a_sentence(tmp_path, planned):
    with Store(tmp_path) as store:
        store.plan(planned)
        store._base.executescript("DROP TABLE pictures; DROP TABLE designs;")
        for question in (store.waiting, store.statuses, lambda: store.begun("key"), lambda: store.pictures(["key"])):
            with pytest.raises(PlisseError, match=r"study\.sqlite is not the store of a study"):
                question()


def test_a_page_that_is_too_small_shows_the_first_designs_where_none_is_exact(tmp_path, study):
    planned = samples(read_plan({**study, "vary": {"closed_form.width": {"start": 4, "stop": 8, "count": 150}}}))
    with Store(tmp_path) as store:
        store.plan(planned)
        for sample in planned:
            store.done(sample.key, Outcome(status="approximate", reasons=["not flat"]))
    found = Study.load(tmp_path)
    found.write_contact_sheet(tmp_path / "all.png")
    Study(tmp_path, found.rows[:120]).write_contact_sheet(tmp_path / "first.png")
    assert size(tmp_path / "all.png") == size(tmp_path / "first.png")


def size(picture):
    with Image.open(picture) as image:
        return image.size
