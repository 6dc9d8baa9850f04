"""Crease patterns along asymptotic curves, with or without singularities (§2.6, Figs 18 and 22)."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.chart import Chart
from plisse.layout.asymptotic.bends import Bends
from plisse.layout.asymptotic.curves import Leaf, Limits, trace_both_ways
from plisse.layout.asymptotic.directions import Directions
from plisse.layout.asymptotic.labels import Labels, labelled
from plisse.layout.asymptotic.legs import kept_columns
from plisse.layout.asymptotic.overlay import Net, overlay
from plisse.layout.asymptotic.rays import Ray, crossings, rays
from plisse.layout.asymptotic.singularities import Singularity, singularities
from plisse.layout.asymptotic.spacing import Spacing, evenly, spaced
from plisse.structure.topology import Topology

__all__ = ["AsymptoticLayout", "Sizes", "lay_out", "room_in_the_middle"]

STEP = 1 / 50  # of the domain's diagonal
PATCH = 2.0  # widths through which curves pass without asymptotic directions
CIRCLE = 1e-3  # of the diagonal, around a singularity
FIRST_CREASE = 1.5  # widths from a singularity


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


@dataclass(frozen=True, eq=False)
class AsymptoticLayout:
    """A net along asymptotic curves with all that it came from; `width` and `hub` as they were used.

    With `hubs_cut` the polygons around singularities are no faces.
    """

    directions: Directions
    hubs: tuple[Singularity, ...]
    legs: tuple[Ray, ...]
    bisectors: tuple[Ray, ...]
    limits: Limits
    width: float
    hub: float
    net: Net
    hubs_cut: bool = False

    @cached_property
    def topology(self) -> Topology:
        """The faces: those of the net, or its quads alone."""
        whole = self.net.topology
        return Topology(whole.vertex_count, whole.quads) if self.hubs_cut else whole

    @property
    def chart(self) -> Chart:
        """The surface."""
        return self.directions.chart

    @cached_property
    def points(self) -> np.ndarray:
        """Feet (V, 3) of the vertices on the surface."""
        return self.chart.positions(self.net.places)

    @cached_property
    def normals(self) -> np.ndarray:
        """Unit normals (V, 3) of the surface."""
        return self.chart.at(self.net.places).normals

    @cached_property
    def bends(self) -> Bends:
        """How creases bend and twist."""
        return Bends.of(self.net, self.chart)

    @cached_property
    def labels(self) -> Labels:
        """Mountains and valleys; raises Infeasible where there are none that agree."""
        return labelled(self.net, self.points, self.bends)

    def cut_along_legs(self, most_twist: float) -> "AsymptoticLayout":
        """Without the columns where creases beside legs have τ/κ above `most_twist`; the same where there are no legs.

        Raises Infeasible where nothing is left.
        """
        if not self.legs:
            return self
        kept = kept_columns(self.net, self.points, self.bends, self.legs, self.bisectors, most_twist)
        if not kept.any():
            raise Infeasible("the surface twists too much beside the legs of its singularities, from the first columns on; "
                             "give a flatter surface, or a smaller part of it with a smaller pattern.width")
        return self._with_columns([leaf for leaf, stays in zip(self.net.columns, kept, strict=True) if stays])

    def refined(self) -> "AsymptoticLayout":
        """With a column between any two along the legs, and one more in front of the first where there is room."""
        columns = list(self.net.columns)
        gaps: dict[tuple[int, int], complex] = {}
        for number, line in enumerate([leg.leaf for leg in self.legs] or [self._spine]):
            reached = crossings(line, columns)
            order = np.argsort(reached)[:np.isfinite(reached).sum()]
            hub = self.legs[number].hub if self.legs else -1
            marks = crossings(line, [ray.leaf for ray in self.bisectors if ray.hub != hub])
            if self.legs and len(order) > 1 and not (marks < reached[order[0]]).any():
                # near a singularity curves are as far apart as powers K/2 of their distances from it
                power = 0.5 * self.hubs[hub].sectors
                first, second = reached[order[:2]] ** power
                if first > 0.5 * (second - first):
                    gaps[-1 - number, int(order[0])] = complex(line.place_at((0.5 * first) ** (1 / power)))
            for one, other in zip(order[:-1].tolist(), order[1:].tolist(), strict=True):
                if not ((marks > reached[one]) & (marks < reached[other])).any():
                    middle = 0.5 * (reached[one] + reached[other])
                    gaps.setdefault((min(one, other), max(one, other)), complex(line.place_at(middle)))
        return self._with_columns(columns + list(trace_both_ways(self.directions, np.array(list(gaps.values())), "columns",
                                                                 self.limits)))

    @cached_property
    def _spine(self) -> Leaf:
        """The crease with most vertices: without legs, columns are counted along it."""
        return self.net.creases[int(np.argmax(np.bincount(self.net.crease)))]

    def _with_columns(self, columns: list[Leaf]) -> "AsymptoticLayout":
        return replace(self, net=overlay(list(self.net.creases), columns, self.net.hubs))


def lay_out(chart: Chart, family: int, sizes: Sizes) -> AsymptoticLayout:
    """Creases along a family of asymptotic curves, 1 or 2, and columns orthogonal to them.

    Raises Infeasible where singularities leave no room, or where the curves make no faces.
    """
    directions = Directions(chart, family)
    low, high = chart.domain
    hubs = singularities(chart)
    limits = Limits(2 * abs(high - low), STEP * abs(high - low), np.inf)
    return _around_hubs(directions, hubs, sizes, limits) if hubs else _regular(directions, sizes, limits)


def _around_hubs(directions: Directions, hubs: tuple[Singularity, ...], sizes: Sizes, limits: Limits) -> AsymptoticLayout:
    low, high = directions.chart.domain
    radius = CIRCLE * abs(high - low)
    legs = rays(directions, hubs, "creases", limits, radius)
    bisectors = rays(directions, hubs, "columns", limits, radius)
    room = min(ray.leaf.length for ray in bisectors)
    width = room / (sizes.creases + FIRST_CREASE - 0.5) if sizes.width is None else sizes.width
    if FIRST_CREASE * width > room:
        raise Infeasible(f"the first creases, {FIRST_CREASE * width:.3g} from the singularity, leave the surface, which "
                         f"reaches {room:.3g} from there; give a smaller pattern.width or a larger surface")
    limits = replace(limits, patch=PATCH * width)
    span = (sizes.creases + FIRST_CREASE - 1) * width
    reach = min(max(ray.leaf.length for ray in legs), 1.2 * span) if sizes.reach is None else sizes.reach
    hub = max(0.12 * reach, room_in_the_middle(hubs) * width) if sizes.hub is None else sizes.hub
    gap = (reach - hub) / max(sizes.columns - 1, 1)
    creases = spaced(directions, "creases", bisectors, legs, Spacing(FIRST_CREASE * width, width, span), limits)
    columns = spaced(directions, "columns", legs, bisectors, Spacing(hub, gap, reach), limits)
    net = overlay(creases, columns, tuple(single.place for single in hubs))
    return AsymptoticLayout(directions, hubs, legs, bisectors, limits, width, hub, net)


def room_in_the_middle(hubs: tuple[Singularity, ...]) -> float:
    """Distance of the first columns from singularities, in widths: more sectors need more room."""
    return 0.4 * max(hub.sectors for hub in hubs) - 0.7


def _regular(directions: Directions, sizes: Sizes, limits: Limits) -> AsymptoticLayout:
    low, high = directions.chart.domain
    middle = np.array([0.5 * (low + high)])
    spine = trace_both_ways(directions, middle, "creases", limits)[0]
    across = trace_both_ways(directions, middle, "columns", limits)[0]
    width = across.length / (sizes.creases + 1) if sizes.width is None else sizes.width
    reach = spine.length if sizes.reach is None else 2 * sizes.reach
    creases = evenly(directions, "creases", across, sizes.creases, width, limits)
    columns = evenly(directions, "columns", spine, sizes.columns, reach / (sizes.columns + 1), limits)
    return AsymptoticLayout(directions, (), (), (), limits, width, 0.0, overlay(creases, columns, ()))
