"""Files that appear whole or not at all: written aside, then moved into place."""

import os
import re
import secrets
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from plisse.errors import PlisseError

__all__ = ["numbered_files", "require_writable", "written", "written_together"]

ASIDE = re.compile(r"^\.(.+)\.[0-9]+-[0-9a-f]{8}$")


@contextmanager
def written(path: str | Path) -> Iterator[Path]:
    """A path to write to, which becomes `path` at the end; after an exception nothing has changed.

    Raises PlisseError where the place cannot be written.
    """
    path = Path(path)
    aside = _aside(path)
    with _sentence(path):
        try:
            if path.is_dir():
                raise IsADirectoryError(None, "it is a directory")
            yield aside
            aside.replace(path)
        finally:
            aside.unlink(missing_ok=True)


@contextmanager
def written_together(directory: str | Path, owned: Iterable[str] = ()) -> Iterator[Path]:
    """A directory to write files into, which are moved into `directory` together at the end.

    `owned` names files that belong to the set: those of an earlier run that this one does not write are
    removed, so that no old file stands beside a new report. After an exception or Ctrl-C everything is as it
    was before. Raises PlisseError where the place cannot be written.
    """
    directory = Path(directory)
    with _sentence(directory), _staging(directory) as stage:
        yield stage
        _move_in(stage, directory, owned)


def numbered_files(directory: str | Path, prefix: str, suffix: str) -> list[str]:
    """Names of the files in a directory that are `prefix`, digits and `suffix` and nothing else; none if it is not there."""
    directory = Path(directory)
    name = re.compile(re.escape(prefix) + "[0-9]+" + re.escape(suffix))
    files = [file for file in directory.iterdir() if name.fullmatch(file.name)] if directory.is_dir() else []
    return sorted(file.name for file in files if file.is_file())


def require_writable(directory: str | Path, names: Iterable[str] = ()) -> None:
    """Nothing; raises PlisseError where `directory` or files in it cannot be written, before work has gone into it."""
    directory = Path(directory)
    for name in names:
        if (directory / name).is_dir():
            raise PlisseError(f"{directory / name} is a directory where a file must go; remove it or choose another place")
    with _sentence(directory), _staging(directory) as stage:
        stage.joinpath("probe").touch()
        if directory.exists() and not os.access(directory, os.W_OK):
            raise PermissionError(None, "permission denied")


@contextmanager
def _staging(directory: Path) -> Iterator[Path]:
    """An empty directory beside `directory`; it and the parents made for it vanish where they stay empty."""
    if directory.exists() and not directory.is_dir():
        raise NotADirectoryError(None, "it is a file")
    parents = [parent for parent in directory.absolute().parents if not parent.exists()]
    stage = _aside(directory.absolute())
    try:
        stage.mkdir(parents=True)
        yield stage
    finally:
        shutil.rmtree(stage, ignore_errors=True)
        for parent in parents:
            _remove_if_empty(parent)


def _move_in(stage: Path, directory: Path, owned: Iterable[str]) -> None:
    if not directory.exists():
        stage.replace(directory)
        return
    names = sorted(file.name for file in stage.iterdir())
    for name in names:
        (stage / name).replace(directory / name)
    for name in set(owned) - set(names):
        (directory / name).unlink(missing_ok=True)


def _aside(path: Path) -> Path:
    """A hidden name beside `path` that nobody else uses."""
    return path.with_name(f".{path.name or 'files'}.{os.getpid()}-{secrets.token_hex(4)}")


def _wanted(path: Path) -> Path:
    """The path that a hidden one beside it stands for."""
    return Path(*(ASIDE.sub(r"\1", part) for part in path.parts))


def _remove_if_empty(directory: Path) -> None:
    try:
        directory.rmdir()
    except OSError:
        return


@contextmanager
def _sentence(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = (error.strerror or type(error).__name__).lower()
        raise PlisseError(f"{_wanted(path)} cannot be written ({reason}); choose another place") from None
