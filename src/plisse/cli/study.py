"""`plisse study`: many variants of a design, on all cores or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter, Token

from plisse.cli.limits import Threads, bound

if TYPE_CHECKING:
    from plisse.study import Study

__all__ = ["study"]

LINE_EVERY = 60.0  # seconds


def _whole(kind: type, tokens: Sequence[Token]) -> int:
    try:
        return int(tokens[0].value)
    except ValueError:
        raise ValueError(f'"{tokens[0].value}" is no whole number') from None


Whole = Annotated[int | None, Parameter(converter=_whole)]


def study(
    study: Path | None = None,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    scheduler: str | None = None,
    workers: Whole = None,
    retry: Annotated[bool, Parameter(negative=())] = False,
    best: Whole = None,
    by: Literal["regularity", "deviation", "opening", "sheet_area"] | None = None,
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
    threads: Threads = None,
) -> int:
    """Make all designs of a study and map where they succeed; start it again to go on after an interruption.

    Parameters
    ----------
    study
        A study file (TOML): a base design, and the keys to vary.
    output
        Directory for the store, the table and the pictures; the study's name if left out.
    scheduler
        Address of a running Dask scheduler, for example tcp://10.0.0.1:8786.
    workers
        How many designs are made at the same time on this machine; one per core if left out. A scheduler has its own.
    retry
        Try designs again that took too long or too much memory, or failed.
    best
        Add nothing to the study; write so many of the best designs that are done to DIR/best, each with a picture, for which
        it is solved again.
    by
        What is best: regularity, deviation, opening or sheet_area.
    json
        Print the outcomes as JSON instead of a summary.
    quiet
        Print nothing.
    """
    bound(threads)
    from plisse.errors import PlisseError
    from plisse.study import run

    _refuse_contradictions(scheduler, workers, retry, best)
    if best is not None:
        return _copy_best(study, output, best, by, json, quiet)
    if study is None:
        raise PlisseError("no study is named; give a study file (TOML)")
    if by is not None:
        raise PlisseError("--by says how --best chooses; give --best 10 as well")
    directory = Path(study.stem) if output is None else output
    if output is None and directory.is_file():
        raise PlisseError(f"{directory} is a file, and results go to a directory of that name; name another one with -o")
    try:
        with _progress(quiet or json) as advance:
            found = run(study, directory, scheduler=scheduler, workers=workers, retry=retry, progress=advance)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; what is done is kept in {directory}, the same command goes on") from None
    if json:
        _print_json(found, [])
    elif not quiet:
        _summarise(found)
    return 0 if found.counts.get("exact") else 3


def _refuse_contradictions(scheduler: str | None, workers: int | None, retry: bool, best: int | None) -> None:
    """Nothing; raises PlisseError where options do not go together."""
    from plisse.errors import PlisseError

    if workers is not None and workers < 1:
        raise PlisseError(f"--workers is {workers}; give a number from 1")
    if scheduler is not None and workers is not None:
        raise PlisseError("--workers counts processes on this machine, --scheduler names others; leave one out")
    if best is None:
        return
    for name, is_given in (("--scheduler", scheduler is not None), ("--workers", workers is not None), ("--retry", retry)):
        if is_given:
            raise PlisseError(f"--best adds nothing to a study, and {name} says how designs are added; leave one out")


def _copy_best(study: Path | None, output: Path | None, count: int, by: str | None, json: bool, quiet: bool) -> int:
    import sys

    from plisse.cli.console import progress
    from plisse.errors import PlisseError
    from plisse.study import Study
    from plisse.study.plan import read_plan
    from plisse.study.samples import samples

    if count < 1:
        raise PlisseError(f"--best is {count}; give a number from 1")
    directory = Path(study.stem) if study is not None and output is None else output
    if directory is None:
        raise PlisseError("no study is named; give a study file, or its directory with -o")
    plan = None if study is None else read_plan(study)
    by = by or ("regularity" if plan is None else plan.by)
    found = Study.load(directory, None if plan is None else [sample.key for sample in samples(plan)])
    there = len(found.best(by=by))
    if not there:
        raise PlisseError(f"no design in {found.directory} is exact and has a {by.replace('_', ' ')}; widen the study")
    if there < count and not (quiet or json):
        print(f"only {there} design{'s are' if there > 1 else ' is'} exact and can be chosen by {by.replace('_', ' ')}",
              file=sys.stderr)
    with progress(quiet or json) as advance:
        files = found.write_best(count, by=by, progress=advance)
    if json:
        _print_json(found, files)
    elif not quiet:
        for file in files:
            print(file)
    return 0


def _print_json(found: Study, files: list[Path]) -> None:
    import msgspec

    seconds = sum(row.seconds or 0.0 for row in found.rows)
    told = {"directory": str(found.directory), "designs": len(found.rows), "others": found.others, "outcomes": found.counts,
            "seconds_of_designs": seconds, "best": [str(file) for file in files]}
    print(msgspec.json.format(msgspec.json.encode(told)).decode())


def _summarise(found: Study) -> None:
    """Print the outcomes, the most frequent reasons of those that are not exact, and the files."""
    from rich.console import Console
    from rich.text import Text

    from plisse.cli.console import STYLES

    console = Console(highlight=False)
    outcomes = [Text(f"{count} {status}", STYLES.get(status, "bold")) for status, count in found.counts.items()]
    console.print(Text(f"{len(found.rows)} designs: ", "bold") + Text(", ").join(outcomes))
    alike: dict[tuple[str, str], list[str]] = {}
    for row in found.rows:
        if row.reasons:
            alike.setdefault((row.status, _kind(row.reasons[0])), []).append(row.reasons[0])
    for (status, _), reasons in sorted(alike.items(), key=lambda entry: -len(entry[1]))[:5]:
        console.print(Text(f"· {len(reasons)} {status}{', for example' * (len(reasons) > 1)}: {reasons[0]}"))
    if found.others:
        console.print(Text(f"· {found.others} designs of earlier studies are kept in the store, they are not counted"))
    for file in sorted(file for file in found.directory.iterdir() if file.is_file() and not file.name.startswith(".")):
        console.print(Text(str(file), "dim"))


def _kind(reason: str) -> str:
    """What a reason says without its numbers and remedies."""
    import re

    return re.sub(r"[-+]?\d[\d.,]*(e[-+]?\d+)?", "…", re.split(r"[;:] | at | \(limit", reason)[0])


@contextmanager
def _progress(quiet: bool) -> Iterator[Callable[[str, float], None]]:
    """A bar on a terminal, a line a minute elsewhere, and what is no count at once: studies run overnight."""
    import sys
    from time import monotonic

    from plisse.cli.console import progress

    last, said = monotonic(), ""

    def line(stage: str, fraction: float) -> None:
        nonlocal last, said
        news = stage != said and not stage[:1].isdigit()
        if not quiet and (news or monotonic() - last > LINE_EVERY):
            last, said = monotonic(), stage
            print(stage, file=sys.stderr, flush=True)

    with progress(quiet) as bar:
        yield bar if sys.stderr.isatty() else line
