"""A recipe as TOML text: the inverse of reading a design file."""

import json
import re
from collections.abc import Iterator, Mapping

__all__ = ["toml_text"]

BARE = re.compile(r"[A-Za-z0-9_-]+")
WIDEST = 100


def toml_text(design: Mapping) -> str:
    """The TOML that says what a nested dictionary of numbers, words, truth values and lists says; None is left out."""
    return "\n".join(_lines(design, ())).strip() + "\n"


def _lines(table: Mapping, path: tuple[str, ...]) -> Iterator[str]:
    """Plain keys first, then tables with their full names."""
    known = {key: value for key, value in table.items() if value is not None}
    for key, value in known.items():
        if not isinstance(value, Mapping):
            yield f"{_key(key)} = {_value(value)}"
    for key, value in known.items():
        if isinstance(value, Mapping):
            yield ""
            yield f"[{'.'.join(map(_key, (*path, key)))}]"
            yield from _lines(value, (*path, key))


def _key(key: str) -> str:
    return key if BARE.fullmatch(key) else _word(key)


def _word(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _word(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, list | tuple):
        parts = [_value(part) for part in value]
        short = f"[{', '.join(parts)}]"
        return short if len(short) <= WIDEST else "[\n    " + ",\n    ".join(parts) + ",\n]"
    if isinstance(value, float):
        return repr(float(value))  # inf and nan are words of TOML too
    return str(value)
