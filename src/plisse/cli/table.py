"""`plisse table`: Fig. 21 of the paper, computed anew."""

from typing import Annotated

from cyclopts import Parameter

from plisse.cli.limits import Threads, bound

__all__ = ["table"]


def table(*names: str, json: Annotated[bool, Parameter(negative=())] = False,
          markdown: Annotated[bool, Parameter(negative=())] = False,
          quiet: Annotated[bool, Parameter(negative=())] = False, threads: Threads = None) -> int:
    """Solve the examples of the paper's Fig. 21 and print their numbers beside the paper's.

    Parameters
    ----------
    names
        Only these examples, for example fig01d fig19; all of them when none is given.
    json
        Print a list of objects, with all that the paper printed.
    markdown
        Print a Markdown table.
    quiet
        Show no progress.
    """
    bound(threads)
    import msgspec

    from plisse.cli.console import progress, show_table
    from plisse.errors import InvalidDesign, PlisseError
    from plisse.table import PRINTED, as_json, as_markdown
    from plisse.table import table as rows_of

    if json and markdown:
        raise PlisseError("--json and --markdown exclude each other; give one of them")
    unknown = [name for name in names if name not in PRINTED]
    if unknown:
        raise InvalidDesign(f"{unknown[0] or repr(unknown[0])} is no example of Fig. 21; those are {', '.join(PRINTED)}")
    with progress(quiet or json) as report:
        rows = rows_of(dict.fromkeys(names) or None, progress=report)
    if json:
        print(msgspec.json.format(msgspec.json.encode(as_json(rows))).decode())
    elif markdown:
        print(as_markdown(rows), end="")
    else:
        show_table(rows)
    return 0 if all(row.status == "exact" for row in rows) else 3
