"""A study from its file to its pictures: plan, sweep, table, contact sheet, map."""

import csv
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from numbers import Integral
from pathlib import Path

from plisse.draw.contact_sheet import MOST, Frame, write_contact_sheet
from plisse.draw.region import Place, places, write_region
from plisse.errors import InvalidDesign, PlisseError
from plisse.io.atomic import require_writable, written
from plisse.study.best import best, described, write_best
from plisse.study.crew import Crew, crew, require_address
from plisse.study.outcome import OUTCOMES
from plisse.study.plan import Map, Plan, read_plan
from plisse.study.samples import Sample, samples, value_at
from plisse.study.store import COLUMNS, STORE, Row, Store, locked

__all__ = ["FILES", "Row", "Study", "run"]

AGAIN = ("timeout", "memory", "failed")
FILES = (STORE, "results.csv", "contact-sheet.png", "map.png")
Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Study:
    """A directory with the store of a study, and its rows as they were read.

    `others` counts designs of earlier studies in the same store: they are kept there, and count nowhere else.
    """

    directory: Path
    rows: list[Row]
    others: int = 0

    @classmethod
    def load(cls, directory: str | Path, keys: Iterable[str] | None = None) -> "Study":
        """The study in a directory, finished or not, of the designs with these keys in their order, or of all.

        Nothing is written. Raises PlisseError where there is none.
        """
        directory = Path(directory)
        if not (directory / STORE).is_file():
            raise PlisseError(f"there is no study in {directory} ({STORE} is missing); run `plisse study STUDY.toml` first")
        with Store(directory, reading=True) as store:
            rows = store.rows()
        by_key = {row.key: row for row in rows}
        own = rows if keys is None else [by_key[key] for key in keys if key in by_key]
        return cls(directory, own, len(rows) - len(own))

    @property
    def counts(self) -> dict[str, int]:
        """How many designs have which outcome, in the order of OUTCOMES; "waiting" for those without."""
        states = [row.status if row.status in OUTCOMES else "waiting" for row in self.rows]
        return {status: states.count(status) for status in (*OUTCOMES, "waiting") if status in states}

    @property
    def is_complete(self) -> bool:
        """Whether every design has its outcome."""
        return all(row.status in OUTCOMES for row in self.rows)

    def best(self, count: int | None = None, *, by: str = "regularity") -> list[Row]:
        """Rows of exact designs by regularity, deviation, opening or sheet_area, the best first."""
        return best(self.rows, by, count)

    def write_best(self, count: int, *, by: str = "regularity", progress: Progress | None = None) -> list[Path]:
        """TOML files of the best designs in the folder `best`, each beside a picture."""
        return write_best(self.best(count, by=by), self.directory / "best", progress=progress)

    def write_csv(self, path: str | Path) -> None:
        """Write one line per row: key, varied values, outcome, reasons, numbers."""
        keys = list(dict.fromkeys(key for row in self.rows for key in row.parameters))
        facts = ("status", "reasons", "attempts", "seconds", "memory_mb", "worker", "finished")
        with written(path) as aside, aside.open("w", newline="", encoding="utf-8") as stream:
            table = csv.writer(stream)
            table.writerow(["key", *keys, *facts, *COLUMNS])
            for row in self.rows:
                said = {name: getattr(row, name) for name in facts} | {"reasons": "; ".join(row.reasons)}
                values = [value_at(row.recipe, key) for key in keys]
                table.writerow([row.key, *values, *said.values(), *row.numbers.values()])

    def places(self, axes: Map) -> list[Place]:
        """Points of the map: every row of the study at the values of its keys."""
        x, y = axes.keys
        return places((None if axes.panels is None else value_at(row.recipe, axes.panels), value_at(row.recipe, x),
                       value_at(row.recipe, y), row.status) for row in self.rows)

    def write_map(self, path: str | Path, axes: Map) -> None:
        """Write the map of outcomes over two keys, with a panel for each value of a third one."""
        with written(path) as aside:
            write_region(self.places(axes), aside, labels=(axes.keys[0], axes.keys[1]), panels=axes.panels,
                         outcomes=OUTCOMES, title=self.directory.resolve().name)

    def write_contact_sheet(self, path: str | Path, *, by: str = "regularity") -> None:
        """Write small pictures of all designs; of too many for a page the best ones, or the first where none is exact."""
        shown, title = self.rows, f"{self.directory.resolve().name}: {len(self.rows)} designs"
        if len(shown) > MOST:
            exact = self.best(MOST, by=by)
            shown = exact or shown[:MOST]
            title += f", the best {len(shown)} by {by.replace('_', ' ')}" if exact else f", the first {len(shown)}"
        with Store(self.directory, reading=True) as store:
            pictures = store.pictures(row.key for row in shown)
        frames = [Frame(pictures.get(row.key), described(row), _verdict(row), row.status) for row in shown]
        with written(path) as aside:
            write_contact_sheet(frames, aside, title=title)


def run(source: str | Path | dict, directory: str | Path | None = None, *, scheduler: str | None = None,
        workers: int | None = None, retry: bool = False, progress: Progress | None = None) -> Study:
    """The study of a TOML file or dictionary, made as far as it is not made yet, with its table and pictures.

    `directory` is the file's name if left out. Designs are made by `workers` processes of a Dask cluster started here, one
    per core if not said, or by those of the `scheduler` at an address. `retry` tries designs again that ended as timeout,
    memory or failed. Raises InvalidDesign for studies that cannot be, MissingExtra without Dask, PlisseError where another
    study works in the directory.
    """
    if workers is not None and not (isinstance(workers, Integral) and workers >= 1):
        raise InvalidDesign(f"workers is {workers!r}; give a whole number from 1")
    if scheduler is not None:
        require_address(scheduler)
    plan = read_plan(source)
    if directory is None:
        directory = Path("study") if isinstance(source, dict) else Path(Path(source).stem)
    directory = Path(directory)
    planned = samples(plan)
    require_writable(directory, FILES)
    again = AGAIN if retry else ()
    # workers before the store: where there are none, nothing is left behind
    with _held(directory), _workers(_waiting(directory, planned, again), scheduler, workers, progress) as found:
        _make(plan, planned, directory, again, found, progress)
        study = Study.load(directory, [sample.key for sample in planned])
        _write_files(study, plan)
    return study


@contextmanager
def _held(directory: Path) -> Iterator[None]:
    """Nobody else works in the directory; it is made where there is none, and goes again where it stays empty."""
    fresh = [place for place in (directory, *directory.parents) if not place.exists()]
    directory.mkdir(parents=True, exist_ok=True)
    try:
        with locked(directory):
            yield
    finally:
        with suppress(OSError):  # there is something in it
            for place in fresh:
                place.rmdir()


def _waiting(directory: Path, planned: list[Sample], again: Iterable[str]) -> int:
    """How many designs are still to be made."""
    done = set()
    if (directory / STORE).is_file() and (directory / STORE).stat().st_size:
        with Store(directory) as store:
            done = {key for key, status in store.statuses().items() if status in OUTCOMES and status not in again}
    return sum(sample.mistake is None and sample.key not in done for sample in planned)


@contextmanager
def _workers(waiting: int, scheduler: str | None, count: int | None, progress: Progress | None) -> Iterator[Crew | None]:
    """Workers for designs that wait; nobody where there are none."""
    if not waiting:
        yield None
        return
    if progress:
        progress(f"{'starting workers' if scheduler is None else f'asking {scheduler}'} for {waiting} designs", 0.0)
    with crew(scheduler, count, designs=waiting) as found:
        yield found


def _make(plan: Plan, planned: list[Sample], directory: Path, again: Iterable[str], crew: Crew | None,
          progress: Progress | None) -> None:
    from plisse.study.sweep import sweep

    with Store(directory) as store:
        store.plan(planned, again=again)
        if crew is not None:
            sweep(crew, store, plan.limits, forecast=plan.forecast, progress=progress)


def _write_files(study: Study, plan: Plan) -> None:
    study.write_csv(study.directory / "results.csv")
    study.write_contact_sheet(study.directory / "contact-sheet.png", by=plan.by)
    axes = plan.map or _first_keys(study.rows)
    if axes is None:
        (study.directory / "map.png").unlink(missing_ok=True)  # of an earlier plan
    else:
        study.write_map(study.directory / "map.png", axes)


def _first_keys(rows: list[Row]) -> Map | None:
    """The first two keys that vary."""
    keys = list(dict.fromkeys(key for row in rows for key in row.parameters))
    varied = [key for key in keys if len({repr(value_at(row.recipe, key)) for row in rows}) > 1]
    return Map(keys=varied[:2]) if len(varied) > 1 else None


def _verdict(row: Row) -> str:
    angle = row.numbers["min_sector_angle_deg"]
    if row.status == "exact" and angle is not None:
        return f"exact, sectors from {angle:.0f}°"
    return f"{row.status}: {row.reasons[0]}" if row.reasons else row.status
