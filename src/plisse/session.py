"""A design under one's hand: change a number, get the exact structure, on patterns that are kept."""

from collections.abc import Callable
from pathlib import Path

from plisse.errors import InvalidDesign
from plisse.io.designs import checked_design, design_from_dict
from plisse.pipeline import design
from plisse.recipe import Recipe
from plisse.result import Result
from plisse.solve.workspace import Workspace

__all__ = ["Session", "changed"]

Progress = Callable[[str, float], None]


class Session:
    """A design, its latest result, and the patterns of linear systems that designs of its size share.

    Every answer is what `plisse.design` gives for the same recipe, whatever was tried before. One session belongs to one
    thread. Raises InvalidDesign for impossible recipes; the session then stays as it was.
    """

    def __init__(self, recipe: Recipe | dict | str | Path, *, progress: Progress | None = None):
        self._workspace = Workspace()
        self.open(recipe, progress=progress)

    def update(self, changes: dict | None = None, /, *, progress: Progress | None = None, **values) -> Result:
        """The structure after changes: keys as in a design (`theta=30`, `width=5`), or `{"section.key": value}`.

        A value None brings a key's default back. Keys that stand in one section only need not name it.
        """
        return self.open(changed(self.recipe, changes or {}, **values), progress=progress)

    def open(self, recipe: Recipe | dict | str | Path, *, progress: Progress | None = None) -> Result:
        """The structure of another recipe, on the patterns that are kept."""
        recipe = checked_design(recipe)
        result = design(recipe, progress=progress, workspace=self._workspace)
        self.recipe, self.result = recipe, result
        return result


def changed(recipe: Recipe, changes: dict, /, **values) -> Recipe:
    """The checked recipe after changes, named as in `Session.update`; raises InvalidDesign where there is none."""
    if not isinstance(changes, dict):
        raise InvalidDesign(f'changes are {changes!r}; give a dictionary as in {{"pattern.theta": 30}}, or theta=30')
    data, seen = recipe.to_dict(), set()
    for name, value in [*changes.items(), *values.items()]:
        section, key = _place(recipe, name)
        if (section, key) in seen:
            raise InvalidDesign(f"{key} is changed twice; give it once")
        seen.add((section, key))
        place = data if section is None else data.get(section, {})
        if not isinstance(place, dict):
            raise InvalidDesign(f"{section} is {place!r}, which has no key {key}; give a table of keys and values")
        if value is None:
            place.pop(key, None)
        else:
            place[key] = value
            data.update({} if section is None else {section: place})
    return design_from_dict(data)


def _place(recipe: Recipe, name: str) -> tuple[str | None, str]:
    """Section and key that a name means."""
    if not isinstance(name, str):
        raise InvalidDesign(f"a change is named {name!r}; names are words as in pattern.theta or theta")
    section, dot, key = name.partition(".")
    sections = [field for field in type(recipe).__struct_fields__ if field != "units"]
    if dot:
        if section not in sections:
            raise InvalidDesign(f"{name} names no section of a design of this kind; its sections are {', '.join(sections)}")
        present = getattr(recipe, section)
        if present is not None and key not in _keys(present):
            raise InvalidDesign(f"{section} has no key {key}; its keys are {', '.join(sorted(_keys(present)))}")
        return section, key
    if name in (*sections, "units"):
        return None, name
    fitting = [section for section in sections if name in _keys(getattr(recipe, section, None))]
    if len(fitting) == 1:
        return fitting[0], name
    if fitting:
        raise InvalidDesign(f"{name} stands in the sections {' and '.join(fitting)}; say which, as in "
                            f"update({{\"{fitting[0]}.{name}\": …}})")
    known = sorted({key for section in sections for key in _keys(getattr(recipe, section, None))})
    raise InvalidDesign(f"a design of this kind has no key {name}; its keys are {', '.join(known)}")


def _keys(section) -> tuple[str, ...]:
    return getattr(section, "__struct_fields__", ())
