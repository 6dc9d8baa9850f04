"""plisse: design, solve, check and make curve-pleated structures.

    import plisse
    result = plisse.design({"curve": {"kind": "arc", "radius": 100, "angle": 90},
                            "pattern": {"theta": 20, "creases": 8, "width": 5, "amplitude": 3}})
    result.status                # "exact"
    result.structure.vertices    # (V, 3), folded
    result.structure.development # (V, 2), flat
"""

from typing import TYPE_CHECKING

__version__ = "0.1.0"

if TYPE_CHECKING:
    from plisse.errors import Infeasible, InvalidDesign, InvalidStructure, PlisseError
    from plisse.pipeline import design
    from plisse.recipe import Design
    from plisse.result import Report, Result
    from plisse.session import Session
    from plisse.structure.pleated import PleatedStructure

__all__ = ["Design", "Infeasible", "InvalidDesign", "InvalidStructure", "PleatedStructure", "PlisseError", "Report",
           "Result", "Session", "__version__", "design"]

_HOMES = {"Design": "plisse.recipe", "PleatedStructure": "plisse.structure.pleated", "Report": "plisse.result",
          "Result": "plisse.result", "Session": "plisse.session", "design": "plisse.pipeline",
          **dict.fromkeys(("Infeasible", "InvalidDesign", "InvalidStructure", "PlisseError"), "plisse.errors")}


def __getattr__(name: str):
    """Public names on first use, so that importing plisse costs nothing."""
    if name not in _HOMES:
        raise AttributeError(f"module 'plisse' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOMES[name]), name)
