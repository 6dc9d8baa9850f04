"""A structure as it comes from a file: with its unit and its title."""

from dataclasses import dataclass

from plisse.structure.pleated import PleatedStructure

__all__ = ["Model"]


@dataclass(frozen=True, eq=False)
class Model:
    """A structure, the unit of its lengths (mm where the file does not say), and a title of one line, perhaps empty."""

    structure: PleatedStructure
    units: str = "mm"
    title: str = ""

    def __post_init__(self):
        words = "".join(c if c.isprintable() else " " for c in self.title).split()
        object.__setattr__(self, "title", " ".join(words))
