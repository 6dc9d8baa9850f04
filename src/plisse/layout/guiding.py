"""The pattern of guiding curves that a design asks for, and the notes it deserves."""

from dataclasses import dataclass, field

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.curves import seed_sampler
from plisse.layout.evolve import default_smoothing, evolution_nodes, evolve
from plisse.layout.paper_evolution import evolve_literally
from plisse.layout.widths import strip_widths
from plisse.recipe import Curve
from plisse.recipe import Pattern as PatternRecipe
from plisse.structure.pattern import Pattern

__all__ = ["Guiding", "guiding"]

NARROWER = (0.97, 0.94, 0.91, 0.88, 0.85)


@dataclass(frozen=True, eq=False)
class Guiding:
    """A pattern at the resolution of its evolution, samples and amplitude to solve with, sentences about compromises."""

    pattern: Pattern
    samples: int
    amplitude: float
    notes: list[str] = field(default_factory=list)


def guiding(curve: Curve, recipe: PatternRecipe, smoothing_factor: float = 1.0) -> Guiding:
    """Pattern for the curve and pattern sections of a design.

    Strips are narrowed by up to 15 % where they would just run into the focal set, and a note says so. Raises Infeasible
    where the pattern collapses even so, InvalidDesign for straight seeds.
    """
    try:
        return Guiding(_evolved(curve, recipe, 1.0, smoothing_factor), recipe.samples, recipe.amplitude)
    except Infeasible as error:
        collapse = error
    for scale in NARROWER:
        try:
            pattern = _evolved(curve, recipe, scale, smoothing_factor)
        except Infeasible:
            continue
        note = (f"pattern.width was narrowed to {100 * scale:.0f} % because otherwise {collapse}")
        return Guiding(pattern, recipe.samples, recipe.amplitude, [note])
    raise collapse


def _evolved(curve: Curve, recipe: PatternRecipe, scale: float, smoothing_factor: float) -> Pattern:
    closed = curve.closed
    theta = np.radians(np.broadcast_to(np.asarray(recipe.theta, float), recipe.creases))
    seed_of = seed_sampler(curve)
    nodes = evolution_nodes(seed_of(200), closed)
    seed = seed_of(nodes)
    parameters = np.linspace(0, 1, nodes, endpoint=not closed)
    widths = scale * strip_widths(recipe.width, theta, recipe.amplitude, parameters, closed=closed,
                                  spacing=recipe.spacing)
    if recipe.method == "paper":
        return evolve_literally(seed, theta, widths, closed=closed)
    smoothing = default_smoothing(seed, closed) if recipe.smoothing is None else recipe.smoothing
    return evolve(seed, theta, widths, closed=closed, smoothing=min(smoothing_factor * smoothing, 1.0))
