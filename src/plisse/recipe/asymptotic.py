"""The recipe of a pattern along asymptotic curves."""

from typing import Annotated, Literal

from msgspec import Meta

from plisse.recipe.fields import Length, Range, Strict, Units, without_none

__all__ = ["AsymptoticDesign", "AsymptoticPattern", "AsymptoticSurface", "WeierstrassData"]

Formula = Annotated[str, Meta(description="a formula in z and i, such as \"z**2\"")]


class WeierstrassData(Strict, kw_only=True, frozen=True):
    """A minimal surface: g and f of X = Re ∫ (f (1 − g²)/2, i f (1 + g²)/2, f g) dz."""

    g: Formula
    f: Formula = "1"


class AsymptoticSurface(Strict, tag_field="kind", tag="asymptotic", kw_only=True, frozen=True):
    """A surface of negative curvature: a mesh `file`, the `formula` of a height over the rectangle x × y, or `weierstrass`
    data over the rectangle x × y of the complex plane.

    Creases follow the first or the second `family` of asymptotic curves. The polygon around a singularity is a face of
    the sheet ("closed") or is left out ("cut"). Meshes are smoothed over `smoothing` edge lengths; left out, over as
    many as their noise asks for.
    """

    file: str | None = None
    formula: str | None = None
    weierstrass: WeierstrassData | None = None
    x: Range = (-1.0, 1.0)
    y: Range = (-1.0, 1.0)
    family: Annotated[Literal[1, 2], Meta(description="1 or 2")] = 1
    hub: Annotated[Literal["closed", "cut"], Meta(description="closed or cut")] = "closed"
    smoothing: Annotated[float, Meta(ge=0.1, le=20, description="edge lengths from 0.1 to 20")] | None = None


class AsymptoticPattern(Strict, kw_only=True, frozen=True):
    """Creases and columns: `creases` along the bisector of every sector around a singularity, `columns` along every leg.

    Without singularities these are all creases and all columns. `width` is the distance of neighbouring creases,
    `amplitude` that from the surface, half the width if left out. Columns begin at the distance `hub_size` from a
    singularity and end at `reach`, all measured on the surface; where creases hardly bend there are fewer.
    """

    creases: Annotated[int, Meta(ge=2, le=200, description="a whole number from 2 to 200")] = 9
    columns: Annotated[int, Meta(ge=4, le=2000, description="a whole number from 4 to 2000")] = 40
    width: Length | None = None
    amplitude: Length | None = None
    hub_size: Length | None = None
    reach: Length | None = None


class AsymptoticDesign(Strict, kw_only=True, frozen=True):
    """The recipe of upright pleats along asymptotic curves, with singularities or without (§2.6)."""

    surface: AsymptoticSurface
    pattern: AsymptoticPattern = AsymptoticPattern()
    units: Units = "mm"

    @property
    def strips(self) -> None:
        """Strips along curves are another kind of design."""

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them; keys that are not set are left out."""
        import msgspec

        return without_none(msgspec.to_builtins(self))
