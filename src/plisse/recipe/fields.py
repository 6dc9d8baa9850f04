"""Kinds of values in a recipe, with the words that a mistake is answered with."""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

__all__ = ["MILLIMETRES", "Inclination", "Length", "Point", "Range", "Strict", "Units", "without_none"]

Length = Annotated[float, Meta(ge=1e-9, le=1e9, description="a length in model units from 1e-9 to 1e9")]
Inclination = Annotated[float, Meta(ge=0, lt=90, description="degrees from 0 up to, not including, 90")]
Units = Annotated[Literal["mm", "cm", "m", "in", "ft"], Meta(description="mm, cm, m, in or ft")]
Range = Annotated[tuple[float, float], Meta(description="two rising numbers")]
Point = Annotated[list[float], Meta(min_length=3, max_length=3, description="three coordinates [x, y, z]")]

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}


class Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A struct that refuses keys it does not know."""


def without_none(value):
    """A tree of dictionaries without the keys whose value is None."""
    if isinstance(value, dict):
        return {key: without_none(item) for key, item in value.items() if item is not None}
    return value
