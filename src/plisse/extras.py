"""Optional libraries, asked for where they are used."""

from importlib import import_module
from types import ModuleType

from plisse.errors import MissingExtra

__all__ = ["optional"]


def optional(module: str, *, extra: str, purpose: str) -> ModuleType:
    """The imported module; raises MissingExtra, which says how to install it, where it is missing.

    `extra` is the group of pyproject that brings it, `purpose` what needs it: "DXF files".
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] != module.split(".")[0]:
            raise
        raise MissingExtra(f'{purpose} need {module.split(".")[0]}, which is not installed; '
                           f'pip install "plisse[{extra}]"') from None
