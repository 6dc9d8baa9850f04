"""Mistakes in a study file in words: what was expected, and what the key takes."""

import re

import msgspec

from plisse.io.mistakes import WORDS

__all__ = ["expected", "hint"]


def expected(message: str) -> str:
    """A validation message with kinds of values in words: "expected text or a table, got a whole number"."""
    if "field `" not in message:  # there the ticks hold a key
        message = re.sub(r"`([^`]*)`", lambda match: _kinds(match[1].split(" | ")), message)
    return message[0].lower() + message[1:]


def hint(struct: type[msgspec.Struct], name: str) -> str:
    """What a key of a struct takes, from the description that its type carries; empty where there is none."""
    field = next((field for field in msgspec.structs.fields(struct) if field.name == name), None)
    return _description(msgspec.inspect.type_info(field.type)) if field else ""


def _kinds(names: list[str]) -> str:
    needless = {"null", "int"} if "float" in names else {"null"}
    return " or ".join(WORDS.get(name, name) for name in names if name not in needless)


def _description(info: msgspec.inspect.Type) -> str:
    if isinstance(info, msgspec.inspect.Metadata):
        return (info.extra_json_schema or {}).get("description", "")
    if isinstance(info, msgspec.inspect.UnionType):
        return next((text for text in map(_description, info.types) if text), "")
    return ""
