"""Where commands on structures write: not over their source, and in a format for structures."""

from collections.abc import Callable
from pathlib import Path

__all__ = ["refuse_source", "structure_writer"]


def refuse_source(target: Path, structure: Path) -> None:
    """Nothing; raises PlisseError where the target is the structure that was read."""
    from plisse.errors import PlisseError

    if target.exists() and structure.exists() and target.samefile(structure):
        raise PlisseError(f"{target} is the structure itself; choose another file with -o")


def structure_writer(target: Path) -> Callable[..., None]:
    """The writer for the target's extension; raises PlisseError for others than .fold and .obj."""
    from plisse.errors import PlisseError
    from plisse.io.fold import write_fold
    from plisse.io.obj import write_obj

    writers: dict[str, Callable[..., None]] = {".fold": write_fold, ".obj": write_obj}
    if target.suffix.lower() not in writers:
        raise PlisseError(f"{target.name} is neither a .fold nor an .obj file; give one of these")
    return writers[target.suffix.lower()]
