"""Mistakes in a study file in words: what was expected."""

import re

from plisse.io.mistakes import WORDS

__all__ = ["expected"]


def expected(message: str) -> str:
    """A validation message with kinds of values in words: "expected text or a table, got a whole number"."""
    if "field `" not in message:  # there the ticks hold a key
        message = re.sub(r"`([^`]*)`", lambda match: _kinds(match[1].split(" | ")), message)
    return message[0].lower() + message[1:]


def _kinds(names: list[str]) -> str:
    needless = {"null", "int"} if "float" in names else {"null"}
    return " or ".join(WORDS.get(name, name) for name in names if name not in needless)
