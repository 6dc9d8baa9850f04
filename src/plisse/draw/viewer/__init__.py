"""The page that shows a structure to anyone with a browser: its template, style and script."""

from importlib.resources import files

__all__ = ["resource"]


def resource(name: str) -> str:
    """The text of a file of this package."""
    return (files(__name__) / name).read_text(encoding="utf-8")
