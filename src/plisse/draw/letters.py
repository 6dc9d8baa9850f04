"""Letters that the font of pictures does not have."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["letters_as_boxes"]


@contextmanager
def letters_as_boxes() -> Iterator[None]:
    """Draw without a warning for letters that the font does not have: they show as boxes."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=r"Glyph .* missing from")
        yield
