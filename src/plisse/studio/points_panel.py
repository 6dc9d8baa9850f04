"""Control points of the seed curve: choose, add, remove, snap, or type their coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plisse.geometry.curves import seed_curve
from plisse.recipe import Design
from plisse.studio.fields import DIGITS
from plisse.studio.framing import is_narrow
from plisse.studio.handles import MOST_POINTS, control_points_of, snapped, with_point_after, without_point

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["PointsPanel"]

POINTS = 7
FREE = "anywhere"
COORDINATES = "coordinates"


class PointsPanel:
    """What can be done to control points, with the keyboard too."""

    def __init__(self, tab: Tab):
        self._tab, gui = tab, tab.client.gui
        self._folder = gui.add_folder("Control points")
        with self._folder:
            self._show = gui.add_checkbox("show control points", not is_narrow(tab.client.camera),
                                          hint="Balls on the curve that can be pulled")
            self._number = gui.add_slider("point", 1, 2, 1, 1, hint="Which control point has the arrows")
            self._place = gui.add_vector3(COORDINATES, (0.0, 0.0, 0.0), step=0.1, hint="Where it is: x, y and z")
            self._place.precision = DIGITS
            self._plane = gui.add_dropdown("points lie", (FREE, "in a plane xy", "in a plane xz", "in a plane yz"),
                                           hint="A plane brings all points into it, and keeps them there when pulled")
            self._edit = gui.add_button_group("points", ("add", "remove"),
                                              hint="A point after the one with the arrows, or without that one")
        self._convert = gui.add_button("Make control points of this curve", icon="vector-spline",
                                       hint="The curve becomes a spline through points that can be pulled")
        self._show.on_update(self._switched)
        self._number.on_update(self._numbered)
        self._place.on_update(self._typed)
        self._plane.on_update(self._snapped)
        self._edit.on_click(self._edited)
        self._convert.on_click(self._converted)

    @property
    def wanted(self) -> bool:
        """Whether handles are to be seen."""
        return self._show.value

    def move(self, index: int, place: np.ndarray) -> None:
        """Move a point, if there is one of that number, in digits that a hand can tell apart."""
        points = self._points()
        if points is not None and index < len(points):
            points[index] = self._rounded(place)
            self._tab.change({"curve.points": points.tolist()})

    def choose(self, index: int) -> None:
        """Show another point."""
        self._number.value = index + 1
        self.refresh()

    def refresh(self) -> None:
        """Bring the controls to the design on the desk."""
        points, recipe = self._points(), self._tab.desk.recipe
        self._folder.visible = points is not None
        self._convert.visible = points is None and isinstance(recipe, Design) and None not in (recipe.curve, recipe.pattern)
        if points is not None:
            if self._number.max != len(points):
                self._number.max = len(points)
            self._number.value = min(self._number.value, len(points))
            self._place.label = f"{COORDINATES} ({recipe.units})"
            self._place.value = tuple(points[self._number.value - 1].tolist())

    def _points(self) -> np.ndarray | None:
        return control_points_of(self._tab.desk.recipe)

    def _rounded(self, position: np.ndarray) -> np.ndarray:
        """A position to four digits of the curve's size, in the plane where one is chosen."""
        points = self._points()
        digits = 3 if points is None else int(np.clip(4 - np.floor(np.log10(np.ptp(points, axis=0).max())), 0, 12))
        return np.round(self._in_plane(position), digits)

    def _in_plane(self, position: np.ndarray) -> np.ndarray:
        """A position in the plane of the points, where one is chosen."""
        points = self._points()
        if points is None or self._plane.value == FREE:
            return position
        return snapped(np.vstack([points, position]), self._plane.value[-2:])[-1]

    @property
    def _closed(self) -> bool:
        return bool(getattr(getattr(self._tab.desk.recipe, "curve", None), "closed", False))

    def _set(self, points: np.ndarray) -> None:
        self._tab.change({"curve.points": points.tolist()})
        self._tab.show_handles()

    async def _switched(self, _event) -> None:
        self._tab.show_handles()

    async def _numbered(self, event) -> None:
        if event.client is not None:
            self._tab.handles.choose(self._number.value - 1)
            self.refresh()

    async def _typed(self, event) -> None:
        points = self._points()
        if event.client is not None and points is not None:
            points[self._number.value - 1] = self._in_plane(np.array(self._place.value))
            self._set(points)

    async def _snapped(self, event) -> None:
        points = self._points()
        if event.client is not None and points is not None and self._plane.value != FREE:
            self._set(snapped(points, self._plane.value[-2:]))

    async def _edited(self, event) -> None:
        points, index = self._points(), self._number.value - 1
        if event.client is None or points is None:
            return
        if event.target.value == "add" and len(points) >= MOST_POINTS:
            self._tab.refuse(f"a curve has at most {MOST_POINTS} control points; remove one first")
        elif event.target.value == "add":
            self._set(with_point_after(points, index, self._closed))
        else:
            self._set(without_point(points, index))

    async def _converted(self, event) -> None:
        recipe = self._tab.desk.recipe
        if event.client is None or not isinstance(recipe, Design) or recipe.curve is None:
            return
        points = seed_curve(recipe.curve, POINTS + 4 * recipe.curve.closed)
        points = np.array([self._rounded(point) for point in points]).tolist()
        self._tab.change({"curve": {"kind": "spline", "points": points, "closed": recipe.curve.closed}})
