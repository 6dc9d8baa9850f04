"""The pages made from benchmarks.json: docs/benchmarks.md with its pictures, docs/table.md, and a block of README.md."""

import re
from importlib import import_module
from pathlib import Path

from plots import saved

__all__ = ["publish"]

BEGIN, END = "<!-- benchmarks -->", "<!-- /benchmarks -->"
MADE_BY = "`python benchmarks/run.py`"


def publish(found: dict, order: tuple[str, ...], root: Path) -> None:
    """Write everything below `root`, the subjects of `found` in this order."""
    docs = root / "docs"
    docs.mkdir(parents=True, exist_ok=True)
    subjects = {name: found["subjects"][name] for name in order if name in found["subjects"]}
    _write(docs / "benchmarks.md", _page(found["machine"], subjects, docs / "pictures"))
    if "figure21" in subjects:
        _write(docs / "table.md", _table(found["machine"], subjects["figure21"]))
    readme = root / "README.md"
    if readme.is_file():
        _write(readme, _with_block(readme.read_text(encoding="utf-8"), _block(found["machine"], subjects)))


def _page(machine: dict, subjects: dict, pictures: Path) -> str:
    out = ["# Benchmarks", "", f"Made by {MADE_BY} from `benchmarks.json` alone. {_where(machine)} Linear algebra runs in "
           "one thread, every subject in a process of its own. Ratios come from runs of both sides in the same process, in "
           "processor seconds where not said otherwise. *One factorisation* is that of J Jᵀ of the exact conditions of the "
           "same design: no Newton method on its vertices can be faster.", "", *_headlines(subjects)]
    for name, entry in subjects.items():
        subject = import_module(name)
        out += ["", f"## {subject.TITLE}", "", *subject.lines(entry["found"])]
        if hasattr(subject, "draw"):
            saved(subject.draw(entry["found"]), pictures / f"benchmark-{name}.png")
            out += ["", f"![{subject.TITLE}](pictures/benchmark-{name}.png)"]
        out += ["", f"`benchmarks/{name}.py`, {entry['date']}, {entry['seconds']:.0f} s, load average before {entry['load']}"
                f"{', small cases only' if entry['quick'] else ''}."]
    return "\n".join(out) + "\n"


def _headlines(subjects: dict) -> list[str]:
    """One sentence for each subject that has one."""
    sentences = []
    for name, entry in subjects.items():
        subject = import_module(name)
        if hasattr(subject, "headline") and (sentence := subject.headline(entry["found"])):
            sentences.append(f"- {sentence}")
    return sentences


def _table(machine: dict, entry: dict) -> str:
    return "\n".join([
        "# Fig. 21 again", "", f"The output of `plisse table --markdown`, written by {MADE_BY} on {entry['date']}. "
        f"{_where(machine)} *Paper* is what was printed in 2019 beside what comes out here; seconds are optimisation only, "
        "defects are the largest.", "", import_module("figure21").markdown(entry["found"])])


def _block(machine: dict, subjects: dict) -> str:
    return "\n".join([*_headlines(subjects), "", f"{_where(machine)} [docs/benchmarks.md](docs/benchmarks.md) has all "
                      "numbers and what they compare; [docs/table.md](docs/table.md) the paper's table beside ours."])


def _with_block(readme: str, block: str) -> str:
    """README with what stands between the markers replaced; as it is where it has none."""
    return re.sub(f"{BEGIN}.*{END}", lambda _: f"{BEGIN}\n{block}\n{END}", readme, flags=re.DOTALL)


def _where(machine: dict) -> str:
    return (f"{machine['system']}, {machine['processor']}, {machine['cores']} cores, {machine['memory_gib']} GiB; "
            f"Python {machine['python']}, NumPy {machine['numpy']}, SciPy {machine['scipy']}, rslab {machine['rslab']}, "
            f"plisse {machine['plisse']}.")


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")
