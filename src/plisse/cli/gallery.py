"""`plisse gallery`: the designs that come with plisse."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

__all__ = ["gallery"]


def gallery(
    name: str | None = None,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
) -> int:
    """List the shipped designs, or copy one to NAME.toml to change it.

    Parameters
    ----------
    name
        The design to copy; without it all are listed.
    output
        File to copy to instead.
    """
    from plisse.cli.console import list_designs
    from plisse.errors import PlisseError
    from plisse.io.atomic import written
    from plisse.shipped import description, shipped_design, shipped_names

    if name is None and output is not None:
        raise PlisseError("-o names a file to copy to, but no design is named; give one that `plisse gallery` lists")
    if name is None:
        list_designs({known: description(known) for known in shipped_names()})
        return 0
    text = shipped_design(name).read_text(encoding="utf-8")
    target = Path(f"{name}.toml") if output is None else output
    if target.exists():
        raise PlisseError(f"{target} exists already; remove it or choose another file with -o")
    with written(target) as aside:
        aside.write_text(text, encoding="utf-8", newline="\n")
    print(target)
    return 0
