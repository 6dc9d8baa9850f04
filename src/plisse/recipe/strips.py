"""What a design asks for of rectifying strips along its guiding curves (Fig. 6)."""

from typing import Annotated, Literal

from msgspec import Meta

from plisse.recipe.fields import Length, Strict

__all__ = ["Strips"]


class Strips(Strict, kw_only=True, frozen=True):
    """Strips instead of pleats: of `width` along every guiding curve, both sides of it together, and of `thickness`.

    Over a surface the curves are pseudo-geodesics of inclination `theta`, shot from the guide at distances of `spacing`;
    strips make the angle 90° − theta with the surface. `lean` says to which side, `side` on which side of their curves
    they lie: both, above or below the surface. Along an evolution they follow the curves of the pattern.
    """

    width: Length
    thickness: Length | None = None
    side: Literal["both", "above", "below"] = "both"
    theta: Annotated[float, Meta(ge=1, le=90, description="degrees from 1 to 90")] | None = None
    spacing: Length | None = None
    lean: Literal["left", "right"] = "left"
    samples: Annotated[int, Meta(ge=8, le=20_000, description="a whole number from 8 to 20000")] = 120
