"""How the structure is shown: lines, colours, plates, the camera."""

from __future__ import annotations

import asyncio
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from plisse.draw import colours
from plisse.draw.colour_maps import NAMES
from plisse.draw.dashes import SHARE
from plisse.studio.dress import Look
from plisse.studio.fields import DIGITS
from plisse.studio.framing import seen_by
from plisse.studio.view import Tint

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["LookPanel", "legend_html", "scale_html"]

PAPER, SHEET = "paper", "sheet"
SOLID_HINT = "Of the structure as it was designed; plates and offsets have no colours"
SWITCHES = (("rulings", "rulings"), ("creases", "creases"), ("sheet", "flat sheet beside"), ("seed", "seed curve"),
            ("reference", "reference surface"))
LINES = ((colours.MOUNTAIN, False, "mountain"), (colours.VALLEY, True, "valley"), (colours.EDGE, False, "edge"))
STROKE = 10  # pixels from dash to dash in the legend
END = 0.02  # of the colour bar
THIN = 0.006  # plates, in radii of the structure
TURN, FRAMES = 2 * np.pi / 12, 25  # radians and pictures per second


def scale_html(tint: Tint) -> str:
    """A colour bar with its ticks."""
    stops = ",".join(f"rgb({red},{green},{blue})" for red, green, blue in tint.bar.tolist())
    marks = "".join(_tick(place, label) for place, label in tint.ticks)
    return (f"<div style='font-size:0.8em;padding:0 1.5em'>{escape(tint.title)}"
            f"<div style='height:0.8em;background:linear-gradient(to right,{stops});border:1px solid #7b7268'></div>"
            f"<div style='position:relative;height:1.4em'>{marks}</div></div>")


def _tick(place: float, label: str) -> str:
    """A label in the middle below its place, or within the bar where that is an end of it."""
    share = 0 if place < END else 100 if place > 1 - END else 50
    return (f"<span style='position:absolute;white-space:nowrap;transform:translateX(-{share}%);left:{100 * place:.1f}%'>"
            f"{escape(label)}</span>")


def legend_html(scale_of_sheet: float) -> str:
    """What lines mean, and how large the sheet is beside the structure (0 for none)."""
    lines = " &ensp;".join(f"<span style='white-space:nowrap'>{_stroke(ink, is_dashed)} {words}</span>"
                           for ink, is_dashed, words in LINES)
    ratio = f"1 : {1 / scale_of_sheet:.0f}" if scale_of_sheet else ""
    sheet = f"<br>flat sheet at {ratio} of the structure" if scale_of_sheet else ""
    return f"<div style='font-size:0.86em;padding:0 1em'>{lines}{sheet}</div>"


def _stroke(ink: str, is_dashed: bool) -> str:
    """A short line as it is drawn in the scene."""
    gaps = f" stroke-dasharray='{STROKE * SHARE:g} {STROKE * (1 - SHARE):g}'" if is_dashed else ""
    return (f"<svg width='{3 * STROKE}' height='8' aria-hidden='true' style='vertical-align:middle'><line x1='0' y1='4' "
            f"x2='{3 * STROKE}' y2='4' stroke='{ink}' stroke-width='2'{gaps}/></svg>")


class LookPanel:
    """Switches that change the picture and nothing else."""

    def __init__(self, tab: Tab):
        self._tab, gui = tab, tab.client.gui
        self._turning: asyncio.Task | None = None
        self._kept: tuple | None = None
        with gui.add_folder("Show"):
            for name, words in SWITCHES:
                gui.add_checkbox(words, getattr(tab.scene.shown, name)).on_update(self._switched(name))
            self._legend = gui.add_html(legend_html(0.0))
            self._colours = gui.add_dropdown("colours", (PAPER, *NAMES), hint="Of the structure as it was designed")
            self._scale = gui.add_html("", visible=False)
        with gui.add_folder("Thick"):
            self._kind = gui.add_dropdown("as", (SHEET, "plates", "offset"), hint=SOLID_HINT)
            self._length = gui.add_number("thickness or distance", 1.0, step=0.1)
            self._length.precision = DIGITS
            self._words = gui.add_markdown("", visible=False)
        with gui.add_folder("Camera"):
            gui.add_button("Best view").on_click(self._frame)
            self._views = gui.add_button_group("view", ("keep", "go back"))
            self._turntable = gui.add_checkbox("turntable", False)
        self._colours.on_update(self._painted)
        self._kind.on_update(self._solidified)
        self._length.on_update(self._thickened)
        self._views.on_click(self._viewed)
        self._turntable.on_update(self._turned)

    def refresh(self) -> None:
        """Bring the legend and the choices of colours and plates to what is on screen."""
        self._legend.content = legend_html(self._tab.scene.scale_of_sheet)
        self.show_chosen()

    def show_chosen(self) -> None:
        """Bring the choices of colours and plates to what is to be seen of what is chosen."""
        _, (kind, length), colour = self._look
        self._colours.disabled = self._kind.disabled = not self._has_structure
        self._colours.value = colour or PAPER
        self._kind.value = kind or SHEET
        if kind:
            self._length.value = length

    def show_scale(self, tint: Tint | None) -> None:
        """Show what colours mean, or nothing."""
        self._scale.visible = tint is not None
        if tint is not None:
            self._scale.content = scale_html(tint)

    @property
    def _has_structure(self) -> bool:
        found = self._tab.found
        return found is not None and found.folded is not None

    @property
    def _look(self) -> Look:
        """What is to be seen of what is chosen."""
        return self._tab.dress.chosen.visible if self._has_structure else Look()

    @property
    def manner(self) -> dict[str, Any]:
        """How what is taken away is made, as `downloads.Order` has it: as it is seen."""
        percent, (kind, _), colour = self._look
        return {"length": float(self._length.value), "camera": seen_by(self._tab.client.camera), "colour": colour,
                "percent": percent, "solid": kind}

    def fit(self, size: float) -> None:
        """Suggest a thickness for structures of a size (radius), where none was chosen."""
        if self._tab.dress.chosen.solid[0] == "":
            self._length.value = float(f"{size * THIN:.0e}")
            self._length.step = self._length.value / 10

    def forget_offsets(self) -> None:
        """Say nothing about offsets, for the structure is another one."""
        self._words.visible = False

    def show_offsets(self, offsets: tuple[float, float]) -> None:
        """Say how far offsets reach."""
        self._words.visible = True
        self._words.content = f"Offsets exist from {offsets[0]:.4g} to {offsets[1]:.4g} {self._tab.desk.recipe.units}."

    def _switched(self, name: str):
        async def switched(event) -> None:
            setattr(self._tab.scene.shown, name, event.target.value)
            self._tab.scene.redraw()
            self.refresh()

        return switched

    async def _painted(self, event) -> None:
        if event.client is not None:
            self._tab.paint("" if self._colours.value == PAPER else self._colours.value)

    async def _solidified(self, event) -> None:
        if event.client is not None:
            self._tab.solidify("" if self._kind.value == SHEET else self._kind.value, float(self._length.value))

    async def _thickened(self, event) -> None:
        if event.client is not None:
            self._tab.thicken(float(self._length.value))

    async def _frame(self, _event) -> None:
        self._tab.scene.frame()

    async def _viewed(self, event) -> None:
        camera = self._tab.client.camera
        if event.target.value == "keep":
            self._kept = camera.position.copy(), camera.look_at.copy(), camera.up_direction.copy()
        elif self._kept is not None:
            camera.position, camera.look_at, camera.up_direction = self._kept

    async def _turned(self, event) -> None:
        if self._turning is not None:
            self._turning.cancel()
            self._turning = None
        if event.target.value:
            self._turning = asyncio.ensure_future(self._turn())

    async def _turn(self) -> None:
        """Turn the camera around what it looks at, until it is switched off or the tab is closed."""
        from scipy.spatial.transform import Rotation

        camera = self._tab.client.camera
        while self._tab.is_open:
            turn = Rotation.from_rotvec(camera.up_direction * TURN / FRAMES)
            middle = camera.look_at.copy()
            with self._tab.client.atomic():
                camera.position = middle + turn.apply(camera.position - middle)
                camera.look_at = middle  # which goes along with the position
            await asyncio.sleep(1 / FRAMES)
