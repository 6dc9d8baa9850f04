"""What notebooks show of structures and results: status, a few numbers, and a picture."""

from base64 import b64encode
from html import escape
from io import BytesIO

from plisse.draw.page_numbers import entries, summary
from plisse.draw.picture import Style, write_picture
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect
from plisse.result import Result
from plisse.structure.pleated import PleatedStructure

__all__ = ["result_html", "structure_html"]

SIZE = (720, 480)
SHOWN = ("faces", "planarity", "angle sum", "smallest angle", "opening angles", "off the surface", "coverage", "sheet")
COLOURS = {"exact": "#2b6a57", "approximate": "#8a5a12", "infeasible": "#9b3023"}


def structure_html(structure: PleatedStructure) -> str:
    """A picture of the structure and what it consists of, as HTML."""
    topology, vertices = structure.topology, structure.vertices
    rows = [("vertices, faces", f"{topology.vertex_count:,}, {topology.face_count:,}"),
            ("planarity", f"{planarity_defect(topology, vertices).max():.1e}"),
            ("angle sum", f"{abs(angle_defect(topology, vertices)).max():.1e}"),
            ("development", "none yet" if structure.development is None else f"in {structure.cut.topology.components} pieces"
             if structure.cut.topology.components > 1 else "in one piece")]
    return _card("PleatedStructure", "", rows, _image(structure))


def result_html(result: Result) -> str:
    """Status, numbers, sentences and a picture of a result, as HTML."""
    report = result.report
    badge = (f'<span style="background:{COLOURS[report.status]};color:#fff;padding:1px 10px;border-radius:99px">'
             f"{report.status}</span> {escape(summary(report))}")
    rows = [(entry.name, entry.shown) for entry in entries(report) if entry.name in SHOWN] if report.faces else []
    notes = "".join(f"<li>{escape(note)}</li>" for note in (*report.reasons, *report.warnings))
    picture = "" if result.structure is None else _image(result.structure)
    return _card(badge, f"<ul>{notes}</ul>" if notes else "", rows, picture)


def _image(structure: PleatedStructure) -> str:
    out = BytesIO()
    write_picture(structure, out, style=Style(size=SIZE, ambient=False))
    return (f'<img style="width:100%;max-width:{SIZE[0] // 2}px" alt="the folded structure" '
            f'src="data:image/png;base64,{b64encode(out.getvalue()).decode()}">')


def _card(head: str, notes: str, rows: list[tuple[str, str]], picture: str) -> str:
    table = "".join(f"<tr><td>{escape(name)}</td><td>{escape(value)}</td></tr>" for name, value in rows)
    return (f'<div style="display:flex;flex-wrap:wrap;gap:16px;align-items:center">{picture}<div><p>{head}</p>{notes}'
            f"<table>{table}</table></div></div>")
