"""One page that shows a structure and proves it: a turning view, the sheet, numbers, history, recipe; no network."""

from base64 import b64encode
from html import escape
from io import BytesIO
from string import Template

import numpy as np

from plisse.draw.camera import Camera, best_view
from plisse.draw.colour_maps import ColourMap, colour_maps
from plisse.draw.page_numbers import Entry, entries, summary
from plisse.draw.page_plots import history_svg, key_svg, measured, sheet_svg
from plisse.draw.picture import Style, picture
from plisse.draw.scene import scene_json
from plisse.draw.viewer import resource
from plisse.io.toml import toml_text
from plisse.result import Report
from plisse.structure.pleated import PleatedStructure

__all__ = ["report_page"]

STILL = (1200, 800)


def report_page(structure: PleatedStructure, report: Report, *, title: str = "structure",
                deviation: ColourMap | None = None) -> str:
    """The page as HTML. `deviation` is the map of distances from the surface or pattern, where somebody knows them."""
    maps, camera = colour_maps(structure, deviation), best_view(structure)
    return Template(resource("page.html")).substitute(
        title=escape(title or "structure"), style=resource("page.css"), script=resource("viewer.js"),
        status=report.status, summary=escape(summary(report)), notes=_notes(report),
        still=_still(structure, camera), choices=_choices(maps), scales="\n".join(_scale(found) for found in maps.values()),
        numbers="\n".join(_row(entry) for entry in entries(report)), sections=_sections(structure, report),
        scene=scene_json(structure, camera, maps.values()), footer=_footer(report))


def _notes(report: Report) -> str:
    if not report.reasons and not report.warnings:
        return ""
    items = "".join(f"<li>{escape(_sentence(note))}</li>" for note in (*report.reasons, *report.warnings))
    head = "What is wrong, and what helps" if report.reasons else "Worth knowing"
    return f'<section class="notes"><h2>{head}</h2><ul>{items}</ul></section>'


def _sentence(note: str) -> str:
    return note[:1].upper() + note[1:] + ("" if note.endswith(".") else ".")


def _still(structure: PleatedStructure, camera: Camera) -> str:
    from PIL import Image

    out = BytesIO()
    image = Image.fromarray(picture(structure, camera=camera, style=Style(size=STILL))).convert("RGB")
    image.quantize(255, dither=Image.Dither.FLOYDSTEINBERG).save(out, format="PNG", optimize=True)
    return b64encode(out.getvalue()).decode()


def _choices(maps: dict[str, ColourMap]) -> str:
    words = {"paper": "paper"} | {name: found.label for name, found in maps.items()}
    return "\n".join(f'<label><input type="radio" name="map" value="{name}"{" checked" if name == "paper" else ""}> '
                     f"{escape(word)}</label>" for name, word in words.items())


def _scale(found: ColourMap) -> str:
    shares = np.linspace(0, 1, 13)
    stops = found.colours(found.scale.values(shares))
    gradient = ", ".join("#" + "".join(f"{round(255 * part):02x}" for part in stop) for stop in stops.tolist())
    ticks = "".join(f'<span style="left:{100 * place:.1f}%">{escape(label)}</span>' for place, label in found.scale.ticks())
    return (f'<div class="scale" data-map="{found.name}" hidden><p class="soft">{escape(found.title)}; here '
            f'{found.smallest:.3g} to {found.largest:.3g}</p><div class="bar-holder"><div class="bar" '
            f'style="background:linear-gradient(to right, {gradient})"></div></div><div class="ticks">{ticks}</div></div>')


def _row(entry: Entry) -> str:
    data = "".join(f'<data value="{value!r}"></data>' for value in entry.values)
    return (f'<tr><th scope="row">{escape(entry.name)}</th><td class="number">{data}{escape(entry.shown)}</td>'
            f'<td class="limit">{escape(entry.limit)}</td><td class="meaning">{escape(entry.meaning)}</td></tr>')


def _sections(structure: PleatedStructure, report: Report) -> str:
    sheet, history = sheet_svg(structure, report.units), _history(report)
    parts = []
    if sheet:
        parts.append(f'<section><h2>The flat sheet</h2>{sheet}<p class="soft">Mountains {key_svg("mountain")}'
                     f'dash-dotted, valleys {key_svg("valley")}dashed, rulings thin. '
                     "<code>plisse sheets</code> makes files to cut and print at 1:1.</p></section>")
    recipe = ""
    if report.design:
        recipe = ('<section class="long"><div class="head"><h2>The recipe</h2><button type="button" id="copy">copy</button>'
                  f'</div><pre id="recipe">{escape(toml_text(report.design))}</pre><p class="soft">Saved as design.toml, '
                  "<code>plisse make design.toml</code> makes this structure again.</p></section>")
    parts.append(f'<div class="two">{history}{recipe}</div>' if history and recipe else history or recipe)
    return "\n".join(parts)


def _history(report: Report) -> str:
    chart = history_svg(report.history)
    tried = "".join(f"<li>{escape(line)}</li>" for line in report.tried)
    if not chart and not tried and not report.method:
        return ""
    steps = f", {report.iterations} steps in all" if report.iterations else ""
    seconds = f", {report.seconds['total']:.2f} s" if "total" in report.seconds else ""
    words = f"<p>Method: {escape(report.method)}{steps}{seconds}.</p>" if report.method else ""
    if chart:
        chart += f'<p class="soft">{_reading(len(measured(report.history)), report.method == "paper")}</p>'
    if tried:
        tried = f"<p>Also tried:</p><ul>{tried}</ul>"
    return f"<section><h2>How it was found</h2>{words}{chart}{tried}</section>"


def _reading(points: int, paper: bool) -> str:
    if paper:
        return f"The {points} values of functional (5) of the paper: at the start and after every step."
    return (f"The largest residual, measured {points} times: before the first and after every step towards the exact shape; "
            "steps that only relax the shape beforehand are not measured. 1e-9 counts as exact. A jump upwards is a "
            "refinement of the mesh or a condition that was added.")


def _footer(report: Report) -> str:
    from importlib.metadata import version

    return (f"Made by plisse {version('plisse')} after <i>Curve-pleated Structures</i> (Jiang, Mundilova, Rist, Wallner, "
            f"Pottmann, 2019). Lengths in {escape(report.units)}.")
