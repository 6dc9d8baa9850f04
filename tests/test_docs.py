"""The code in README and docs runs, and says what it claims."""

import re
import shlex
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

import plisse
from plisse.cli import main

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_python_in_the_docs_runs(page, capsys):
    for code in blocks(page, "python"):
        exec(compile(code, str(page), "exec"), {})
    if page.name == "README.md":
        status, planarity = capsys.readouterr().out.split()
        assert status == "exact"
        assert float(planarity) < 1e-13


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_designs_in_the_docs_become_exact_also_as_varied_there(page):
    for text in blocks(page, "toml"):
        recipe = tomllib.loads(text)
        assert plisse.design(recipe).status == "exact"
        if "surface" in recipe:
            continue
        for name, value in re.findall(r"--set pattern\.(\w+)=(\S+)", page.read_text(encoding="utf-8")):
            varied = {**recipe, "pattern": {**recipe["pattern"], name: float(value)}}
            assert plisse.design(varied).status == "exact", (name, value)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_named_in_the_docs_exist(page):
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\((?!http)([^)#]+)\)", text):
        assert (page.parent / target).exists(), target
    rooms = "geometry|structure|measure|layout|solve|leastsquares|transform|io|draw|cli"
    for name in re.findall(rf"`((?:{rooms})/[\w/]+\.py)", text):
        assert (ROOT / "src" / "plisse" / name).exists(), name


def test_commands_of_the_tutorial_do_what_it_says(tmp_path, monkeypatch):
    """Every plisse command exits with 0 and writes the file that it names; light is not cast, which is slow."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("plisse.draw.light.can_cast", lambda: False)
    monkeypatch.setattr("plisse.io.page.STILL", (150, 100))
    tutorial = ROOT / "docs" / "tutorial.md"
    (design,) = blocks(tutorial, "toml")
    (tmp_path / "shell.toml").write_text(design, encoding="utf-8")
    commands = [line for block in blocks(tutorial, "sh") for line in block.splitlines()]
    assert len(commands) >= 8
    for command in commands:
        name, *tokens = shlex.split(command)
        assert name == "plisse" and main(tokens) == 0, command
        for flag, target in pairwise(tokens):
            assert flag != "-o" or (tmp_path / target).exists(), command


def test_every_page_has_its_place_in_the_site():
    nav = ROOT.joinpath("mkdocs.yml").read_text(encoding="utf-8")
    for page in (ROOT / "docs").glob("*.md"):
        assert f": {page.name}" in nav, f"docs/{page.name} is missing in the nav of mkdocs.yml"


def test_readme_has_one_test_command_that_ci_can_find():
    marked = ROOT.joinpath("README.md").read_text(encoding="utf-8").split("<!-- test command -->")[1]
    command = re.search(r"```sh\n(.*?)\n```", marked, re.DOTALL)[1]
    assert command.count("\n") == 0
    assert "pytest" in command


def test_the_package_docstring_example_runs():
    lines = [line[4:] for line in plisse.__doc__.splitlines() if line.startswith("    ")]
    scope = {}
    exec("\n".join(lines), scope)
    assert scope["result"].status == "exact"
