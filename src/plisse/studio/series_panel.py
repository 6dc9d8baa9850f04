"""Inclinations of single creases and widths of single strips, or along the curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plisse.studio.fields import DIGITS, list_text, value_of_text
from plisse.studio.series import ALONG, EACH, SAME, SERIES, Series, series_of, with_place_after, without_place
from plisse.studio.waiting import put_away

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["SeriesPanel"]

MOST_ROWS = 24
PERCENT = 100


class SeriesPanel:
    """For one key of SERIES: a choice of its kind, and controls for its numbers."""

    def __init__(self, tab: Tab, key: str, words: str):
        self._tab, self._key, self._words = tab, key, words
        self._part, kinds = SERIES[key]
        gui = tab.client.gui
        self._folder = gui.add_folder(f"{words[0].upper()}{words[1:]} of single {self._part}s", expand_by_default=False)
        with self._folder:
            self._kind = gui.add_dropdown(f"{words} is", kinds, hint=f"One number for all, or one for every {self._part}")
            self._rows = gui.add_folder("Values", visible=False)
        self._kind.on_update(self._turned)
        self._controls: list[Any] = []
        self._shape: tuple = ()

    def refresh(self) -> None:
        """Bring the controls to the design on the desk."""
        series = series_of(self._tab.desk.recipe, self._key)
        self._folder.visible = series is not None
        if series is None:
            return
        self._kind.value = series.kind
        shape = (series.kind, len(series.value) if isinstance(series.value, list) else 0, self._tab.desk.recipe.units)
        if shape != self._shape:
            self._shape = shape
            self._build(series)
        elif series.kind == EACH:
            self._fill_rows(series)
        elif series.kind == ALONG:
            self._fill_place(series)

    def _build(self, series: Series) -> None:
        put_away(self._controls)
        self._controls, gui = [], self._tab.client.gui
        self._rows.visible = series.kind != SAME
        if series.kind == SAME:
            return
        with self._rows:
            text = gui.add_text(f"all {self._part}s" if series.kind == EACH else "all places", list_text(series.value),
                                hint="a list; as text it can be taken from a table and given back")
            text.on_update(self._typed)
            self._controls = [text]
            if series.kind == EACH:
                self._build_rows(series)
            else:
                self._build_place(series)

    def _build_rows(self, series: Series) -> None:
        gui, (low, high, step) = self._tab.client.gui, self._limits(series)
        for k, number in enumerate(series.value[:MOST_ROWS]):  # type: ignore[index]
            row = gui.add_slider(f"{self._words}, {self._part} {k + 1} ({self._unit})", low, high, step, float(number))
            row.precision = DIGITS
            row.on_update(self._pulled(k))
            self._controls.append(row)

    @property
    def _unit(self) -> str:
        return "°" if self._key == "pattern.theta" else self._tab.desk.recipe.units

    def _limits(self, series: Series) -> tuple[float, float, float]:
        if self._key == "pattern.theta":
            return 0.0, 89.9, 0.1
        largest = max(series.value)  # type: ignore[arg-type]
        return min(min(series.value), largest / 4), 4.0 * largest, float(f"{largest / 100:.0e}")  # type: ignore[arg-type]

    def _fill_rows(self, series: Series) -> None:
        text, *rows = self._controls
        text.value = list_text(series.value)
        for row, number in zip(rows, series.value, strict=False):  # type: ignore[arg-type]
            row.min, row.max = min(row.min, number), max(row.max, number)
            row.value = float(number)

    def _build_place(self, series: Series) -> None:
        gui, count = self._tab.client.gui, len(series.value)  # type: ignore[arg-type]
        number = gui.add_slider("place", 1, count, 1, 1, hint="Which of the places along the curve is set below")
        place = gui.add_vector2(f"position (%), {self._words} ({self._unit})", (0.0, 0.0), step=0.1,
                                hint="Where along the curve, in percent of its length, and the number there")
        place.precision = DIGITS
        edit = gui.add_button_group("places", ("add", "remove"), hint="A place after this one, or without this one")
        self._controls += [number, place, edit]
        number.on_update(self._numbered)
        place.on_update(self._placed)
        edit.on_click(self._edited)
        self._fill_place(series)

    def _fill_place(self, series: Series) -> None:
        text, number, place, _ = self._controls
        text.value = list_text(series.value)
        position, value = series.value[number.value - 1]  # type: ignore[index]
        place.value = round(PERCENT * position, DIGITS), float(value)

    def _value(self) -> Any:
        series = series_of(self._tab.desk.recipe, self._key)
        return None if series is None else series.value

    def _pulled(self, index: int):
        async def pulled(event) -> None:
            values = self._value()
            if event.client is not None and isinstance(values, list) and index < len(values):
                self._tab.change({self._key: [*values[:index], event.target.value, *values[index + 1:]]})

        return pulled

    async def _turned(self, event) -> None:
        series = series_of(self._tab.desk.recipe, self._key)
        if event.client is not None and series is not None:
            self._tab.change({self._key: series.turned(self._kind.value)})

    async def _typed(self, event) -> None:
        if event.client is not None:
            self._tab.act(lambda: self._tab.desk.change({self._key: value_of_text(event.target.value)}))

    async def _numbered(self, event) -> None:
        if event.client is not None:
            self.refresh()

    async def _placed(self, event) -> None:
        table, index = self._value(), self._controls[1].value - 1
        if event.client is not None and isinstance(table, list) and index < len(table):
            position, number = event.target.value
            self._tab.change({self._key: [*table[:index], [position / PERCENT, number], *table[index + 1:]]})

    async def _edited(self, event) -> None:
        table, index = self._value(), self._controls[1].value - 1
        if event.client is not None and isinstance(table, list):
            edit = with_place_after if event.target.value == "add" else without_place
            self._tab.change({self._key: edit(table, index)})
