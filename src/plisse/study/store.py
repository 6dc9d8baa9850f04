"""study.sqlite: one row per design, written when its outcome is known; what is committed stays, whatever happens then."""

import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path

import msgspec

from plisse.errors import PlisseError
from plisse.study.numbers import NUMBERS
from plisse.study.outcome import Outcome
from plisse.study.samples import Sample

__all__ = ["LOCK", "STORE", "Row", "Store", "locked"]

STORE, LOCK = "study.sqlite", ".study.lock"
WAITING, RUNNING = "waiting", "running"
COLUMNS = (*NUMBERS, "hopeful", "min_ruling_deg")
FACTS = ("key", "parameters", "recipe", "status", "reasons", "attempts", "seconds", "memory_mb", "worker", "finished")
SCHEMA = f"""
CREATE TABLE IF NOT EXISTS designs (
  key TEXT PRIMARY KEY, parameters TEXT NOT NULL, recipe TEXT NOT NULL, status TEXT NOT NULL, reasons TEXT NOT NULL,
  attempts INTEGER NOT NULL DEFAULT 0, seconds REAL, memory_mb REAL, worker TEXT, finished TEXT,
  {", ".join(COLUMNS)});
CREATE TABLE IF NOT EXISTS pictures (key TEXT PRIMARY KEY REFERENCES designs (key), png BLOB NOT NULL);
"""


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """One design of a study: its key, the varied values, its whole recipe, what became of it, and its numbers."""

    key: str
    parameters: dict
    recipe: dict
    status: str
    reasons: list[str]
    attempts: int
    seconds: float | None
    memory_mb: float | None
    worker: str | None
    finished: str | None
    numbers: dict


class Store:
    """The store of a study in a directory, made where there is none; with `reading` the file is not touched.

    Raises PlisseError where the file is no store, and leaves it as it is.
    """

    def __init__(self, directory: Path, *, reading: bool = False):
        self.directory, self._file = directory, directory / STORE
        with self._sentence():
            if reading or self._holds_tables():
                self._base = self._opened_to_read()
                self._check()
            if not reading:
                self._base = sqlite3.connect(self._file, timeout=30, isolation_level=None)
                self._base.execute("PRAGMA journal_mode=WAL")
                self._base.executescript(SCHEMA)
                self._check()

    def _opened_to_read(self) -> sqlite3.Connection:
        """A connection that writes nothing; a file without a log beside it is whole, and may lie where nobody can write."""
        log = self._file.with_name(f"{STORE}-wal")
        whole = "" if log.exists() and log.stat().st_size else "&immutable=1"
        return sqlite3.connect(f"{self._file.absolute().as_uri()}?mode=ro{whole}", uri=True, timeout=30,
                               isolation_level=None)

    def _holds_tables(self) -> bool:
        if not self._file.exists():
            return False
        with closing(self._opened_to_read()) as base:
            return base.execute("SELECT count(*) FROM sqlite_master").fetchone()[0] > 0

    def _check(self) -> None:
        """Raise where the table of designs is not ours."""
        try:
            self._base.execute(f"SELECT {', '.join((*FACTS, *COLUMNS))} FROM designs LIMIT 0")
        except sqlite3.Error:
            self._base.close()
            raise

    def __enter__(self) -> "Store":
        return self

    def __exit__(self, *error: object) -> None:
        self._base.close()

    def plan(self, samples: Iterable[Sample], *, again: Iterable[str] = ()) -> None:
        """Take in new designs; those done are kept, those that were under way or end as one of `again` wait once more.

        Which values vary is what these samples say, for designs that were there already as well.
        """
        samples = list(samples)
        with self._together() as base:
            base.execute("UPDATE designs SET status = ? WHERE status = ?", (WAITING, RUNNING))
            base.execute("CREATE TEMP TABLE planned (key TEXT PRIMARY KEY)")
            base.executemany("INSERT INTO planned VALUES (?)", ((sample.key,) for sample in samples))
            base.execute("DELETE FROM designs WHERE status = ? AND key NOT IN (SELECT key FROM planned)", (WAITING,))
            base.executemany("UPDATE designs SET status = ?, reasons = '[]' WHERE status = ? "
                             "AND key IN (SELECT key FROM planned)", ((WAITING, status) for status in again))
            base.execute("DROP TABLE planned")
            base.executemany("INSERT INTO designs (key, parameters, recipe, status, reasons) VALUES (?, ?, ?, ?, ?) "
                             "ON CONFLICT (key) DO UPDATE SET parameters = excluded.parameters", map(_planned, samples))

    def waiting(self) -> list[tuple[str, dict]]:
        """Keys and recipes of designs without outcome, in the order of the plan."""
        with self._sentence():
            rows = self._base.execute("SELECT key, recipe FROM designs WHERE status = ? ORDER BY rowid", (WAITING,))
            return [(key, msgspec.json.decode(recipe)) for key, recipe in rows]

    def begun(self, key: str) -> None:
        """Count one more attempt at a design."""
        with self._sentence():
            self._base.execute("UPDATE designs SET status = ?, attempts = attempts + 1 WHERE key = ?", (RUNNING, key))

    def done(self, key: str, outcome: Outcome) -> None:
        """Commit the outcome of a design."""
        found = {name: value for name, value in outcome.numbers.items() if name in COLUMNS}
        facts = {"status": outcome.status, "reasons": _text(outcome.reasons), "seconds": outcome.seconds,
                 "memory_mb": outcome.memory_mb, "worker": outcome.worker,
                 "finished": datetime.now(UTC).isoformat(timespec="seconds"), **found}
        with self._together() as base:
            base.execute(f"UPDATE designs SET {', '.join(f'{name} = ?' for name in facts)} WHERE key = ?",
                         (*facts.values(), key))
            if outcome.picture is not None:
                base.execute("INSERT OR REPLACE INTO pictures VALUES (?, ?)", (key, outcome.picture))

    def rows(self) -> list[Row]:
        """All designs in the order in which they were planned."""
        with self._sentence():
            found = self._base.execute(f"SELECT {', '.join((*FACTS, *COLUMNS))} FROM designs ORDER BY rowid")
            return [_row(values) for values in found]

    def statuses(self) -> dict[str, str]:
        """The status of every design by its key."""
        with self._sentence():
            return dict(self._base.execute("SELECT key, status FROM designs"))

    def pictures(self, keys: Iterable[str]) -> dict[str, bytes]:
        """PNG of those designs that have one."""
        found = {}
        with self._sentence():
            for key in keys:
                for (png,) in self._base.execute("SELECT png FROM pictures WHERE key = ?", (key,)):
                    found[key] = png
        return found

    @contextmanager
    def _together(self) -> Iterator[sqlite3.Connection]:
        """All changes, or none."""
        with self._sentence():
            self._base.execute("BEGIN IMMEDIATE")
            try:
                yield self._base
            except BaseException:
                self._base.execute("ROLLBACK")
                raise
            self._base.execute("COMMIT")

    @contextmanager
    def _sentence(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            if _is_busy(error):
                raise PlisseError(f"another program works with {self._file}; wait until it is done or close it, then run "
                                  "the same command again") from None
            raise PlisseError(f"{self._file} is not the store of a study, or cannot be read or written ({error}); choose "
                              "another directory with -o") from None


@contextmanager
def locked(directory: Path) -> Iterator[None]:
    """Nobody else runs a study in this directory meanwhile; raises PlisseError where somebody does.

    The lock is SQLite's on an empty file: it works on every system and goes with the process that holds it. Where no study
    has begun, the file goes too.
    """
    lock = None
    try:
        lock = sqlite3.connect(directory / LOCK, timeout=0, isolation_level=None)
        lock.execute("BEGIN EXCLUSIVE")
    except sqlite3.Error as error:
        if lock is not None:
            lock.close()
        if _is_busy(error):
            raise PlisseError(f"another study works in {directory}; wait until it is done, or choose another directory with "
                              "-o") from None
        raise PlisseError(f"{directory / LOCK} cannot be locked ({error}); remove it, or choose another directory with "
                          "-o") from None
    try:
        with closing(lock):
            yield
    finally:
        if not (directory / STORE).exists():
            (directory / LOCK).unlink(missing_ok=True)


def _is_busy(error: sqlite3.Error) -> bool:
    """Whether somebody else holds the file."""
    return getattr(error, "sqlite_errorcode", 0) & 0xFF in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)


def _planned(sample: Sample) -> tuple[str, ...]:
    return (sample.key, _text(sample.parameters), _text(sample.recipe), "invalid" if sample.mistake else WAITING,
            _text([sample.mistake] if sample.mistake else []))


def _text(value: object) -> str:
    return msgspec.json.encode(value).decode()


def _row(values: tuple) -> Row:
    facts = dict(zip(FACTS, values, strict=False))
    decoded = {name: msgspec.json.decode(facts[name]) for name in ("parameters", "recipe", "reasons")}
    return Row(**{**facts, **decoded}, numbers=dict(zip(COLUMNS, values[len(FACTS):], strict=True)))
