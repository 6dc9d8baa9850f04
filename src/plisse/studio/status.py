"""The words that always stand on screen: status, the report's sentences, the numbers that matter."""

import math
from dataclasses import dataclass, replace
from html import escape

from plisse.result import Report
from plisse.studio.requests import Found
from plisse.studio.words import spoken
from plisse.transform.collisions import FreeRange

__all__ = ["Status", "broken", "numbers_of", "refused", "remark", "searching", "size_text", "solved",
           "working"]

MARKS = {"exact": ("✔", "#1f6b4a"), "approximate": ("≈", "#8a5a00"), "infeasible": ("✖", "#9b2f24"),
         "draft": ("…", "#4d463f")}
STYLE = "font-size:0.86em;line-height:1.35;padding:0.3em 0.7em"
MOST_SENTENCES = 6
METRES = 10_000.0  # mm from which sizes are in metres


@dataclass(frozen=True)
class Status:
    """What is to be said, in full as HTML, and in a few words."""

    html: str
    brief: str

    def under(self, refusal: str) -> "Status":
        """The same, where in a few words only what was refused is said."""
        return replace(self, brief=f"{MARKS['infeasible'][0]} not done · {spoken(refusal)}")


def solved(found: Found, title: str, above: str = "") -> Status:
    """Status, numbers and sentences of a solved design; those of a draft say that they are of a draft."""
    report = found.report
    sentences = [spoken(sentence) for sentence in (*report.reasons, *report.warnings)]
    more = [f"and {len(sentences) - MOST_SENTENCES} more; the report has them all"] * (len(sentences) > MOST_SENTENCES)
    listed = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences[:MOST_SENTENCES] + more)
    note = f"coarse while you pull: {report.vertices:,} vertices" if found.drafted else title
    return _status("draft" if found.drafted else report.status, "", note,
                   f"{_table(report)}<ul style='margin:0.3em 0;padding-left:1.2em'>{listed}</ul>", above)


def remark(is_pale: bool, percent: float, free: FreeRange | None) -> str:
    """What holds for the picture and not for the design, as HTML: that it is an old one, or a pose that collides."""
    if is_pale:
        return "<div>Pale is what was there before.</div>"
    if free is None or percent in free:
        return ""
    return _alert("colliding at this pose", f"{percent:g} %, and free is {free.low:.4g} to {free.high:.4g} %")


def refused(sentence: str) -> str:
    """Why something was not done, as HTML."""
    return _alert("not done", spoken(sentence))


def searching(stage: str, fraction: float) -> str:
    """How far a search for layouts has come, as HTML."""
    return f"<div>searching for layouts: {escape(stage)} ({100 * fraction:.0f} %)</div>"


def broken(sentence: str, before: Found | None, above: str = "") -> Status:
    """Why a design has no structure; the pale numbers are those of the design before, which is pale on screen."""
    return _status("infeasible", "not done", spoken(sentence), "" if before is None else _pale(before), above)


def working(stage: str, fraction: float, before: Found | None, above: str = "") -> Status:
    """What is being done; the numbers of the design before are pale, for they are not those of this one."""
    return _status("draft", "working", f"{stage} ({100 * fraction:.0f} %)", "" if before is None else _pale(before), above)


def numbers_of(report: Report) -> list[tuple[str, str]]:
    """Names and values of the numbers that matter."""
    rows = [("vertices, faces", f"{report.vertices:,}, {report.faces:,}")]
    for name, spread in (("planarity", report.planarity), ("angle sum", report.angle_defect),
                         ("principal defect", report.principal_defect)):
        if spread is not None:
            rows.append((name, f"{spread.max:.1e} at most"))
    if report.min_sector_angle_deg is not None:
        rows.append(("smallest sector", f"{report.min_sector_angle_deg:.1f}°"))
    if report.opening_angle_deg is not None:
        rows.append(("openings", f"{report.opening_angle_deg.min:.1f}° to {report.opening_angle_deg.max:.1f}°"))
    if report.development is not None:
        width, height = report.development.size_mm
        rows.append(("sheet", size_text(width, height) + ", overlaps itself" * report.development.overlaps))
    if report.coverage is not None:
        rows.append(("coverage", f"{100 * report.coverage:.1f} %"))
    if report.deviation is not None:
        rows.append(("deviation", f"{report.deviation.mean_amplitudes:.2f} amplitudes on average"))
    if "total" in report.seconds:
        seconds = report.seconds["total"]
        rows.append(("solved in", f"{1000 * seconds:.0f} ms" if seconds < 10 else f"{seconds:.0f} s"))
    return rows


def size_text(width: float, height: float) -> str:
    """A size in millimetres to three digits, in metres where that is easier to read."""
    metre, unit = (1000.0, "m") if max(width, height) >= METRES else (1.0, "mm")
    return " × ".join(_digits(length / metre) for length in (width, height)) + f" {unit}"


def _digits(length: float) -> str:
    """A length to three digits, or to all that stand before the point."""
    places = max(0, 2 - math.floor(math.log10(length))) if length > 0 else 0
    return f"{length:.{places}f}".rstrip("0").rstrip(".") if places else f"{length:.0f}"


def _alert(word: str, sentence: str) -> str:
    return (f"<div role='alert' style='border-left:0.3em solid {MARKS['infeasible'][1]};padding-left:0.5em;"
            f"margin-bottom:0.4em'><b>{word}:</b> {escape(sentence)}</div>")


def _pale(found: Found) -> str:
    return f"<div style='opacity:0.4'>{_table(found.report)}</div>"


def _status(status: str, word: str, note: str, below: str = "", above: str = "") -> Status:
    mark, colour = MARKS[status]
    badge = (f"<span id='plisse-status' style='background:{colour};color:white;border-radius:0.3em;padding:0.1em 0.5em'>"
             f"{mark} {word or status}</span>")
    return Status(f"<div role='status' aria-live='polite' style='{STYLE}'>{above}{badge} {escape(note)}{below}</div>",
                  f"{mark} {word or status} · {note}")


def _table(report: Report) -> str:
    rows = "".join(f"<tr><td style='opacity:0.75;padding-right:1em'>{escape(name)}</td><td>{escape(value)}</td></tr>"
                   for name, value in numbers_of(report))
    return f"<table style='font-variant-numeric:tabular-nums'>{rows}</table>"
