"""The command line as a whole: its commands and what their exit codes mean.

0 exact · 1 bad input, one line on stderr · 2 wrong usage · 3 finished, but not exact or not regular · 130
interrupted.
"""

import sys
from collections.abc import Sequence

import cyclopts

from plisse.cli.check import check
from plisse.cli.export import export
from plisse.cli.flex import flex
from plisse.cli.gallery import gallery
from plisse.cli.layout import layout
from plisse.cli.make import make
from plisse.cli.offset import offset
from plisse.cli.parallel import parallel
from plisse.cli.plates import plates
from plisse.cli.render import render
from plisse.cli.report import report
from plisse.cli.sheets import sheets
from plisse.cli.strips import strips
from plisse.cli.studio import studio
from plisse.cli.study import study
from plisse.cli.table import table
from plisse.errors import PlisseError
from plisse.threads import bind_threads

__all__ = ["EXACT", "INEXACT", "app", "main"]

EXACT, BAD_INPUT, USAGE, INEXACT, INTERRUPTED = 0, 1, 2, 3, 130


def _version() -> str:
    from importlib.metadata import version

    return version("plisse")


app = cyclopts.App(
    name="plisse", version=_version, suppress_keyboard_interrupt=False,
    help="Design, solve, check and make surfaces folded along curves.\n\n"
         "Exit codes: 0 exact, 1 bad input, 2 usage, 3 finished but not exact or not regular.")
app.command(make)
app.command(check)
app.command(export)
app.command(sheets)
app.command(render)
app.command(report)
app.command(gallery)
app.command(layout)
app.command(table)
app.command(study)
app.command(flex)
app.command(offset)
app.command(plates)
app.command(parallel)
app.command(strips)
app.command(studio)


def main(tokens: Sequence[str] | None = None) -> int:
    """Exit code of one command; what a user can mend is said in one line on stderr."""
    bind_threads()
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")  # consoles that cannot show ° or θ
    try:
        code = app(tokens, exit_on_error=False, print_error=False, result_action="return_value")
        sys.stdout.flush()
    except cyclopts.CycloptsError as error:
        return _complain(f"{error}; see `plisse --help`", USAGE)
    except PlisseError as error:
        return _complain(str(error), BAD_INPUT)
    except (MemoryError, RecursionError):
        return _complain("this design needs more memory than there is; lower pattern.samples or pattern.creases", BAD_INPUT)
    except OSError as error:
        return _complain(f"output failed ({(error.strerror or type(error).__name__).lower()})", BAD_INPUT)
    except KeyboardInterrupt as error:
        return _complain(str(error) or "interrupted, nothing was written", INTERRUPTED)
    return code if isinstance(code, int) else EXACT


def _complain(message: str, code: int) -> int:
    print("plisse: " + " ".join(message.replace(".; see", "; see").split()), file=sys.stderr)
    return code
