"""Lengths of a pattern around singularities: those that are asked for, and those that follow from the surface (§2.6)."""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible
from plisse.layout.asymptotic.rays import Ray
from plisse.layout.asymptotic.singularities import Singularity

__all__ = ["FIRST_CREASE", "Lengths", "Sizes", "lengths_around", "room_in_the_middle"]

FIRST_CREASE = 1.5  # widths from a singularity
NARROW = 1 / 3  # of the longest bisector, from which on a sector decides how wide strips are
FEWEST = 0.5  # widths along a leg that columns must have


@dataclass(frozen=True)
class Sizes:
    """What a layout is asked for: `creases` on every bisector, `width` apart, and `columns` on every leg.

    Without singularity these are all creases and all columns. `hub` is the distance of the first column from a
    singularity, `reach` that of the last; all lengths in space. What is None follows from the surface.
    """

    creases: int
    columns: int
    width: float | None = None
    reach: float | None = None
    hub: float | None = None


@dataclass(frozen=True)
class Lengths:
    """`width` of the strips, `span` of the creases on a bisector, first (`hub`) and last (`reach`) column on a leg, and
    the mask `closed` of the singularities with room for creases and columns in all their sectors."""

    width: float
    span: float
    hub: float
    reach: float
    closed: np.ndarray


def lengths_around(hubs: tuple[Singularity, ...], legs: tuple[Ray, ...], bisectors: tuple[Ray, ...],
                   sizes: Sizes) -> Lengths:
    """Lengths that leave room for creases and columns; raises Infeasible where there are none.

    The narrowest sector decides the width, but for those that hardly reach into the surface: they get fewer creases,
    and none at all where a singularity is nearer to the boundary than its first crease.
    """
    rooms, reaches = (np.array([ray.leaf.length for ray in some]) for some in (bisectors, legs))
    room = float(rooms[rooms >= NARROW * rooms.max()].min())
    width = room / (sizes.creases + FIRST_CREASE - 0.5) if sizes.width is None else sizes.width
    if FIRST_CREASE * width > rooms.max():
        raise Infeasible(f"the first creases, {FIRST_CREASE * width:.3g} from the singularity, leave the surface, which "
                         f"reaches {rooms.max():.3g} from there; give a smaller pattern.width or a larger surface")
    span = (sizes.creases + FIRST_CREASE - 1) * width
    longest = float(reaches.max())
    if sizes.reach is not None and sizes.reach > longest:
        raise Infeasible(f"pattern.reach is {sizes.reach:.4g}, but the legs of the singularities leave the surface after "
                         f"{longest:.4g}; give no more than that, or leave it out")
    reach = min(longest, 1.2 * span) if sizes.reach is None else sizes.reach
    hub = max(0.12 * reach, room_in_the_middle(hubs) * width) if sizes.hub is None else sizes.hub
    if hub + FEWEST * width > reach:
        of_hub, of_reach = ("" if size is None else f" (pattern.{name})" for name, size in
                            (("hub_size", sizes.hub), ("reach", sizes.reach)))
        raise Infeasible(f"columns would begin {hub:.3g} from the singularity{of_hub} and end at {reach:.3g}{of_reach}, "
                         f"which leaves no room for them between creases {width:.3g} apart; give a larger pattern.reach, or "
                         "a smaller pattern.hub_size or pattern.width")
    first = np.full(len(hubs), np.inf)
    np.minimum.at(first, [ray.hub for ray in bisectors], rooms / FIRST_CREASE / width)
    np.minimum.at(first, [ray.hub for ray in legs], reaches / hub)
    return Lengths(width, span, hub, reach, first > 1)


def room_in_the_middle(hubs: tuple[Singularity, ...]) -> float:
    """Distance of the first columns from singularities, in widths: more sectors need more room."""
    return 0.4 * max(hub.sectors for hub in hubs) - 0.7
