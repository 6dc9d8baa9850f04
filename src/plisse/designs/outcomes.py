"""What a result says of attempts that were not chosen, and of designs that broke down."""

import numpy as np

from plisse.layout.guiding import Guiding
from plisse.recipe import Recipe
from plisse.result import Report, Result
from plisse.solve.portfolio import Outcome
from plisse.stopwatch import Stopwatch
from plisse.structure.pleated import PleatedStructure

__all__ = ["broken_down", "way_of"]


def way_of(outcome: Outcome) -> dict:
    """The entries of a report that tell how its structure came about."""
    attempt = outcome.best.attempt
    return {"method": attempt.method, "iterations": attempt.iterations, "tried": _said_of(outcome),
            "history": [float(value) for value in attempt.history]}


def _said_of(outcome: Outcome) -> list[str]:
    """One line per attempt that was not chosen."""
    lines = []
    for judged in outcome.tried:
        if judged is outcome.best:
            continue
        verdict = judged.verdict
        what = judged.attempt.message if verdict is None else (
            f"planarity {verdict.planarity:.1e}, angles {max(verdict.angle, verdict.principal):.1e}, smallest sector "
            f"{np.degrees(verdict.regularity.min_sector):.1f}°, deviation {verdict.deviation:.2f} amplitudes")
        lines.append(": ".join(part for part in (judged.attempt.method, judged.start.label, what) if part))
    return lines


def broken_down(recipe: Recipe, reasons: list[str], watch: Stopwatch,
                guide: Guiding | None = None, zigzagged: PleatedStructure | None = None) -> Result:
    """The result of a design that came to nothing, with the reasons."""
    report = Report(status="infeasible", reasons=reasons, seconds=watch.stop(), units=recipe.units,
                    design=recipe.to_dict())
    return Result(recipe, report, guide.pattern if guide else None, zigzagged)
