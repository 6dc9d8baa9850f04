"""A design as TOML text: what `plisse make` reads, without what goes without saying."""

from collections.abc import Iterator

import msgspec

from plisse.io.toml import toml_text
from plisse.recipe import Recipe

__all__ = ["design_text"]


def design_text(recipe: Recipe, *, title: str = "") -> str:
    """The design as text without keys that have their default; it reads back as the same design."""
    return toml_text({"units": recipe.units, **_concise(recipe)}, comment=title)


def _concise(struct: msgspec.Struct) -> dict:
    """Keys whose value is not the default, as plain data."""
    plain: dict = msgspec.to_builtins(struct)
    kind = struct.__struct_config__.tag_field
    out = {} if kind is None else {kind: plain[kind]}
    for name, default in _defaults(struct):
        value = getattr(struct, name)
        if value is None or value == default:
            continue
        if isinstance(value, list) and value and isinstance(value[0], msgspec.Struct):
            out[name] = [_concise(item) for item in value]
        else:
            out[name] = _concise(value) if isinstance(value, msgspec.Struct) else _whole(plain[name])
    return out


def _defaults(struct: msgspec.Struct) -> Iterator[tuple[str, object]]:
    """Names of all fields with their defaults, NODEFAULT where there is none."""
    for field in msgspec.structs.fields(type(struct)):
        made = field.default is msgspec.NODEFAULT and field.default_factory is not msgspec.NODEFAULT
        yield field.name, field.default_factory() if made else field.default


def _whole(value):
    """The same value, whole numbers without a decimal point."""
    if isinstance(value, list | tuple):
        return [_whole(item) for item in value]
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e15 else value
