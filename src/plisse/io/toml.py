"""Nested dictionaries as TOML."""

import json
from pathlib import Path

from plisse.io.atomic import written

__all__ = ["toml_text", "write_toml"]


def toml_text(data: dict, *, comment: str = "") -> str:
    """The TOML text of a design or another tree two levels deep, after a comment line; it reads back to the same tree."""
    values = {key: value for key, value in data.items() if not isinstance(value, dict)}
    tables = {key: value for key, value in data.items() if isinstance(value, dict)}
    lines = [f"# {' '.join(comment.split())}"] if comment else []
    lines += [f"{_key(key)} = {_value(value)}" for key, value in values.items()]
    for name, table in tables.items():
        lines += ["", f"[{_key(name)}]", *(f"{_key(key)} = {_value(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def write_toml(data: dict, path: str | Path, *, comment: str = "") -> None:
    """Write the tree; raises PlisseError where the file cannot be written."""
    with written(path) as aside:
        aside.write_text(toml_text(data, comment=comment), encoding="utf-8", newline="\n")


def _key(name: str) -> str:
    return name if name.isascii() and name.replace("_", "").replace("-", "").isalnum() else json.dumps(name)


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items()) + " }"
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
