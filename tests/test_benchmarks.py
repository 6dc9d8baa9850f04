"""The benchmarks run: one command measures every subject, and the page is made from its JSON."""

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
RUN = ROOT / "benchmarks" / "run.py"
SUBJECTS = {"figure21", "methods", "scipy_solver", "growth", "factorisation", "marching", "tracing", "flattening", "motion",
            "startup"}
README = "# plisse\n\n<!-- benchmarks -->\nolder numbers\n<!-- /benchmarks -->\n\nThe end.\n"


def run(*arguments):
    return subprocess.run([sys.executable, str(RUN), *map(str, arguments)], capture_output=True, text=True)


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    directory = tmp_path_factory.mktemp("benchmarks")
    (directory / "README.md").write_text(README, encoding="utf-8")
    done = run("--quick", "-o", directory)
    assert done.returncode == 0, done.stderr
    return directory


def numbers(value, key=""):
    """Every number below a JSON value, with the key that it or its list has."""
    if isinstance(value, dict):
        for name, item in value.items():
            yield from numbers(item, name)
    elif isinstance(value, list):
        for item in value:
            yield from numbers(item, key)
    elif isinstance(value, int | float):
        yield key, value


@pytest.mark.slow
def test_one_command_measures_every_subject_and_all_ratios_are_finite(quick):
    found = json.loads((quick / "benchmarks.json").read_text(encoding="utf-8"))
    assert set(found["subjects"]) == SUBJECTS
    assert {"processor", "cores", "python", "numpy", "scipy", "plisse"} <= set(found["machine"])
    every = list(numbers(found))
    assert all(math.isfinite(value) for _, value in every)
    ratios = [value for key, value in every if key == "ratio"]
    assert len(ratios) >= 3 and min(ratios) > 0


@pytest.mark.slow
def test_what_is_timed_is_also_right(quick):
    subjects = {name: entry["found"] for name, entry in
                json.loads((quick / "benchmarks.json").read_text(encoding="utf-8"))["subjects"].items()}
    assert all(row["status"] == "exact" for row in subjects["figure21"]["rows"])
    assert all(row["status"] == "exact" for family in subjects["growth"]["families"] for row in family["rows"])
    assert all(max(case["exact"]["planarity"], case["exact"]["angle"]) < 1e-12 for case in subjects["methods"]["cases"])
    assert all(row["residual"] < 1e-12 for row in subjects["factorisation"]["rows"])  # every solver solves
    assert all(row["isometry"] < 1e-10 for row in subjects["flattening"]["rows"])


@pytest.mark.slow
def test_the_page_has_every_subject_and_its_pictures_and_readme_the_block(quick):
    page = (quick / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    for name in SUBJECTS:
        assert f"`benchmarks/{name}.py`" in page
    for name in ("figure21", "methods", "scipy_solver", "growth", "factorisation", "startup"):
        assert f"pictures/benchmark-{name}.png" in page
        assert (quick / "docs" / "pictures" / f"benchmark-{name}.png").stat().st_size > 5000
    assert "| fig26 | 726 |" in (quick / "docs" / "table.md").read_text(encoding="utf-8")
    readme = (quick / "README.md").read_text(encoding="utf-8")
    assert readme.startswith("# plisse\n\n<!-- benchmarks -->\n- ") and readme.endswith("<!-- /benchmarks -->\n\nThe end.\n")
    assert "older numbers" not in readme


@pytest.mark.slow
def test_the_pages_follow_from_the_json_alone(quick):
    page = quick / "docs" / "benchmarks.md"
    before = page.read_text(encoding="utf-8")
    page.unlink()
    assert run("--only", "--quick", "-o", quick).returncode == 0
    assert page.read_text(encoding="utf-8") == before


def test_measurements_of_different_machines_are_not_mixed(tmp_path):
    other = {"machine": {"processor": "abacus"}, "subjects": {}}
    (tmp_path / "benchmarks.json").write_text(json.dumps(other), encoding="utf-8")
    done = run("--only", "--quick", "-o", tmp_path)
    assert done.returncode == 1
    assert "measured with another" in done.stderr and "Traceback" not in done.stderr
