"""Controls for the numbers of a design, made from its recipe, and the design as text."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from plisse.studio.fields import DIGITS, Field, fields_of
from plisse.studio.series import fitted
from plisse.studio.waiting import Later, put_away
from plisse.studio.words import TITLES

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["DesignPanel"]

LIST = "a number, or a list: one value per crease or strip"
WIDE = 4.0  # times the range of the field is too wide
HAND = 2.0  # seconds after which a slider was let go


class DesignPanel:
    """One control per field, rebuilt where another kind of design lies on the desk."""

    def __init__(self, tab: Tab):
        self._tab, self._gui = tab, tab.client.gui
        self._place = self._gui.add_folder("Numbers")
        self._folders: list = []
        self._controls: dict[tuple[str, str], object] = {}
        self._shape: list = []
        self._held = ""  # the key of the control on which somebody's hand may be
        self._rest = Later(asyncio.get_running_loop(), HAND)

    def refresh(self) -> None:
        """Bring the controls to the design on the desk."""
        fields = fields_of(self._tab.desk.recipe)
        shape = [(field.key, field.kind, field.label) for field in fields]
        if shape != self._shape:
            self._shape = shape
            self._build(fields)
            return
        for field in fields:
            control = self._controls[field.key, field.kind]
            with self._tab.client.atomic():
                if field.kind in ("slider", "whole") and self._has_outgrown(control, field):
                    self._fit(control, field)
                shown = field.shown
                if control.value != shown:  # type: ignore[attr-defined]
                    control.value = shown  # type: ignore[attr-defined]

    def _has_outgrown(self, slider, field: Field) -> bool:
        """Whether a slider ends before the value, or is far too wide for it while nobody's hand is on it."""
        assert field.low is not None and field.high is not None
        is_wide = slider.max - slider.min > WIDE * (field.high - field.low)
        return not slider.min <= field.value <= slider.max or (is_wide and self._held != field.key)

    def _hold(self, key: str) -> None:
        """Keep the ends of a slider as they are for as long as it is moved."""
        self._held = key
        self._rest.begin(self._let_go)

    def _let_go(self) -> None:
        self._held = ""
        if self._tab.is_open:
            self.refresh()

    def _fit(self, slider, field: Field) -> None:
        """Bring the ends of a slider to those of the field."""
        whole = int if field.kind == "whole" else float
        slider.min, slider.max, slider.step = whole(field.low), whole(field.high), whole(field.step)  # type: ignore

    def _build(self, fields: list[Field]) -> None:
        put_away(self._folders)
        self._folders, self._controls = [], {}
        sections = list(dict.fromkeys(field.section for field in fields))
        with self._place:
            for section in sections:
                folder = self._gui.add_folder(TITLES[section], expand_by_default=section != "solve")
                self._folders.append(folder)
                with folder:
                    for field in fields:
                        if field.section == section:
                            self._add(field)

    def _add(self, field: Field) -> None:
        make = {"slider": self._slider, "whole": self._slider, "number": self._number, "switch": self._switch,
                "choice": self._choice, "list": self._list}[field.kind]
        control = make(field)
        self._controls[field.key, field.kind] = control
        control.on_update(self._changed(field))

    def _slider(self, field: Field):
        whole = int if field.kind == "whole" else float
        slider = self._gui.add_slider(field.label, whole(field.low), whole(field.high), whole(field.step),  # type: ignore
                                      field.value, hint=field.words.hint)
        if field.kind == "slider":
            slider.precision = DIGITS
        return slider

    def _number(self, field: Field):
        return self._gui.add_number(field.label, field.value, min=int(field.low), max=int(field.high), step=1,  # type: ignore
                                    hint=field.words.hint)

    def _switch(self, field: Field):
        return self._gui.add_checkbox(field.label, bool(field.value), hint=field.words.hint)

    def _choice(self, field: Field):
        return self._gui.add_dropdown(field.label, field.shown_choices, initial_value=str(field.shown),
                                      hint=field.words.hint)

    def _list(self, field: Field):
        return self._gui.add_text(field.label, str(field.value), hint=". ".join(filter(None, (field.words.hint, LIST))))

    def _changed(self, field: Field):
        async def changed(event) -> None:
            if event.client is None:
                return
            value = event.target.value
            self._hold(field.key)
            self._tab.act(lambda: self._tab.desk.change(fitted(self._tab.desk.recipe, {field.key: field.meant(value)})))

        return changed
