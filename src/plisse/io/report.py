"""report.json: the numbers that prove a result."""

from pathlib import Path

import msgspec

from plisse.io.atomic import written
from plisse.result import Report

__all__ = ["report_json", "write_report"]


def report_json(report: Report) -> str:
    """The report as indented JSON with every key of the contract; what is unknown or not finite is null."""
    return msgspec.json.format(msgspec.json.encode(report), indent=2).decode() + "\n"


def write_report(report: Report, path: str | Path) -> None:
    """Write the report; raises PlisseError where the file cannot be written."""
    with written(path) as aside:
        aside.write_text(report_json(report), encoding="utf-8", newline="\n")
