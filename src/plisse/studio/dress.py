"""How the structure is shown: in a state of its motion, as plates or an offset, in colours, or as plain paper."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from plisse.recipe import Recipe
from plisse.studio.requests import Colour, Found, Pose, Request, Solid, Solve
from plisse.studio.scene import Scene
from plisse.studio.view import Tint
from plisse.transform.collisions import DESIGNED

__all__ = ["Dress", "Look"]

SHEET = "", 0.0  # neither plates nor an offset


class Look(NamedTuple):
    """A percentage of the motion, a kind of solid with its length, and the name of a colour map.

    Only the structure as it was designed is solid or painted; the default is plain paper as it was designed.
    """

    percent: float = DESIGNED
    solid: tuple[str, float] = SHEET
    colour: str = ""

    @property
    def visible(self) -> Look:
        """What there is to see of it: a state of the motion is neither solid nor painted."""
        return self if self.percent == DESIGNED else Look(self.percent)

    def request(self, recipe: Recipe) -> Pose | Solid | Colour | None:
        """What has to be asked for; None for plain paper as it was designed, which is there."""
        if self.percent != DESIGNED:
            return Pose(recipe, self.percent)
        if self.solid[0]:
            return Solid(recipe, *self.solid)
        return Colour(recipe, self.colour) if self.colour else None


class Dress:
    """The look that is `chosen`, and the one on screen, to which what is refused goes back.

    `is_carried` says that nothing was chosen since a new design came, so that nobody asked for this look of it.
    """

    def __init__(self, scene: Scene, ask: Callable[[Request], None], show_scale: Callable[[Tint | None], None]):
        self._scene, self._ask, self._show_scale = scene, ask, show_scale
        self.chosen = self._on_screen = Look()
        self._asked: Request | None = None
        self.is_carried = False

    def pose(self, percent: float) -> None:
        """Choose a state of the motion."""
        self._choose(self.chosen._replace(percent=percent))

    def solidify(self, kind: str, length: float) -> None:
        """Choose plates or an offset, which have no colours; the sheet for the empty kind."""
        self._choose(Look(solid=(kind, length)) if kind else self.chosen._replace(solid=SHEET))

    def thicken(self, length: float) -> None:
        """Choose another thickness or distance of plates or an offset."""
        self._choose(self.chosen._replace(solid=(self.chosen.solid[0], length)))

    def paint(self, name: str) -> None:
        """Choose a colour map, which only the sheet has; plain paper for the empty name."""
        self._choose(Look(colour=name) if name else self.chosen._replace(colour=""))

    def carry(self) -> None:
        """Another design is asked for, to which what is chosen is carried over."""
        self.is_carried = True

    def put_on(self, found: Found | None, recipe: Recipe) -> None:
        """Show what was found as it is chosen, or ask for what that needs; what is pale stays as it is."""
        if found is None or found.folded is None:
            return
        request = self.chosen.request(recipe)
        needs_sheet = isinstance(request, Colour) and self._on_screen._replace(colour="") != Look()
        if request is None or needs_sheet:
            self._scene.show(found)
            self._scene.follow()
            self._has_become(Look(), None)
        if request is not None:
            self._asked = request
            self._ask(request)

    def put_on_new(self, found: Found, request: Solve) -> None:
        """Show what was found for the first time, as it was designed, in the colours that were asked for with it.

        A state of the motion is not carried over. Where there is no structure, what was on screen is pale, or gives way to
        the surface that is to be covered.
        """
        if self.is_carried:
            self.chosen = self.chosen._replace(percent=DESIGNED)
        if found.folded is None and not (request.framed and found.reference is not None):
            return self.pale()
        self._scene.show(found)
        tint = None if self.chosen.solid[0] else found.tint
        if tint is not None:
            self._scene.tint(tint)
        return self._has_become(Look(colour="" if tint is None else request.colour), tint)

    def complete(self, found: Found, request: Solve) -> None:
        """Go on from what is new to all that is chosen; a colour that it was asked for and does not have is none."""
        if found.folded is not None and self.chosen.colour == request.colour and found.tint is None:
            self.chosen = self.chosen._replace(colour="")
        if self.chosen != self._on_screen:
            self.put_on(found, request.recipe)

    def pale(self) -> None:
        """Show that there is no structure any more."""
        self._scene.pale()
        self._has_become(Look(), None)

    def awaits(self, request: Request) -> bool:
        """Whether it is what was asked for last, and still wanted."""
        return request is self._asked

    def take_in(self, request: Request, value: Any) -> None:
        """Show what was asked for."""
        is_colour = isinstance(request, Colour)
        (self._scene.tint if is_colour else self._scene.pose)(value)
        self._has_become(self.chosen, value if is_colour else None)

    def go_back(self) -> None:
        """Choose what is on screen, for what was asked for is refused."""
        self.chosen, self._asked = self._on_screen, None

    def _choose(self, look: Look) -> None:
        self.chosen, self.is_carried = look, False

    def _has_become(self, look: Look, tint: Tint | None) -> None:
        """This is on screen now, and nothing else is awaited."""
        self._on_screen, self._asked = look, None
        self._show_scale(tint)
