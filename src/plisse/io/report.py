"""report.json: the numbers that prove a result."""

from pathlib import Path

import msgspec

from plisse.errors import InvalidStructure
from plisse.io.atomic import written
from plisse.result import Report

__all__ = ["read_report", "report_beside", "report_json", "write_report"]


def report_json(report: Report) -> str:
    """The report as indented JSON with every key of the contract; what is unknown or not finite is null."""
    return msgspec.json.format(msgspec.json.encode(report), indent=2).decode() + "\n"


def write_report(report: Report, path: str | Path) -> None:
    """Write the report; raises PlisseError where the file cannot be written."""
    with written(path) as aside:
        aside.write_text(report_json(report), encoding="utf-8", newline="\n")


def read_report(path: str | Path) -> Report:
    """The report in a file; raises InvalidStructure where there is none or it is not one of ours."""
    path = Path(path)
    try:
        return msgspec.json.decode(path.read_bytes(), type=Report)
    except FileNotFoundError:
        raise InvalidStructure(f"there is no file {path}; give a report.json that plisse wrote") from None
    except OSError as error:
        raise InvalidStructure(f"{path} cannot be read ({error.strerror})") from None
    except msgspec.DecodeError as error:
        raise InvalidStructure(f"{path} is not a report that plisse wrote ({error}); give another one") from None


def report_beside(structure: str | Path, vertices: int, faces: int) -> Report | None:
    """The report.json in the directory of a structure's file, if it is about one with so many vertices and faces."""
    try:
        report = read_report(Path(structure).with_name("report.json"))
    except InvalidStructure:
        return None
    return report if (report.vertices, report.faces) == (vertices, faces) else None
