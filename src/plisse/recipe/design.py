"""The recipe of an evolution, or of a closed form."""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from plisse.recipe.closed_forms import ClosedForm
from plisse.recipe.curves import Curve
from plisse.recipe.fields import Inclination, Length, Strict, Units, without_none
from plisse.recipe.march import March
from plisse.recipe.parallel import Parallel
from plisse.recipe.strips import Strips

__all__ = ["Design", "Pattern", "Solve"]


class Pattern(Strict, kw_only=True, frozen=True):
    """The guiding curves and how far the zigzag leaves them (§3.2, §3.3)."""

    theta: Annotated[Inclination | list[Inclination],
                     Meta(description="degrees from 0 up to, not including, 90: one number or one per crease")] = 0.0
    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")]
    width: Annotated[Length | list[Length | list[float]],
                     Meta(description="one length from 1e-9 to 1e9, one per strip, or a table [[position, width], …]")]
    amplitude: Length
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 200
    spacing: Annotated[Literal["mirror", "uniform"],
                       Meta(description="mirror (widths coupled by Fig. 11) or uniform (the paper's)")] = "mirror"
    method: Annotated[Literal["accurate", "paper"],
                      Meta(description="accurate (Runge–Kutta steps) or paper (one step of Fig. 14 per strip)")] = "accurate"
    smoothing: Annotated[float, Meta(ge=1e-3, le=1, description="a fraction of the curve's length")] | None = None


class Solve(Strict, kw_only=True, frozen=True):
    """How the zigzag becomes exact (§3.4)."""

    principal: bool = False
    method: Annotated[Literal["exact", "paper"], Meta(description="exact or paper")] = "exact"
    weights: Annotated[list[Annotated[float, Meta(ge=0, description="a weight, at least 0")]],
                       Meta(min_length=5, max_length=5,
                            description="five weights: planarity, closeness, isometry, fairness, principal")] | None = None
    iterations: Annotated[int, Meta(ge=1, le=1000, description="a whole number from 1 to 1000")] = 20
    cut: Annotated[float, Meta(ge=0, lt=100, description="percent of the crease's length, from 0 below 100")] | None = None


class Design(Strict, kw_only=True, frozen=True):
    """A whole recipe, as `report.json` repeats it with all defaults: curve and pattern, curve and
    march, or a closed form."""

    curve: Curve | None = None
    pattern: Pattern | None = None
    march: March | None = None
    closed_form: ClosedForm | None = None
    solve: Solve = msgspec.field(default_factory=Solve)
    parallel: Parallel | None = None
    strips: Strips | None = None
    units: Units = "mm"

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them; keys that are not set are left out."""
        return without_none(msgspec.to_builtins(self))

    @property
    def is_closed(self) -> bool:
        """Whether the creases are closed curves."""
        return self.curve is not None and self.curve.closed
