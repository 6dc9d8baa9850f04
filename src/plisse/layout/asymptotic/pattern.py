"""Crease patterns along asymptotic curves, with or without singularities (§2.6, Figs 18 and 22)."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.chart import Chart
from plisse.layout.asymptotic.beginning import beginning
from plisse.layout.asymptotic.bends import Bends
from plisse.layout.asymptotic.crossings import Crossings
from plisse.layout.asymptotic.curves import Limits, trace_both_ways
from plisse.layout.asymptotic.directions import Directions
from plisse.layout.asymptotic.labels import Labels, labelled
from plisse.layout.asymptotic.leaf import Leaf
from plisse.layout.asymptotic.legs import kept_columns
from plisse.layout.asymptotic.overlay import Net, overlay
from plisse.layout.asymptotic.rays import Ray, crossings, rays
from plisse.layout.asymptotic.singularities import Singularity, singularities
from plisse.layout.asymptotic.sizing import FIRST_CREASE, Sizes, lengths_around
from plisse.layout.asymptotic.spacing import Spacing, evenly, spaced
from plisse.structure.topology import Topology

__all__ = ["AsymptoticLayout", "lay_out"]

STEP = 1 / 50  # of the domain's diagonal
PATCH = 2.0  # widths through which curves pass without asymptotic directions
CIRCLE = 1e-3  # of the diagonal, around a singularity
SMALLEST = 2e-5  # of the surface, that creases are apart


@dataclass(frozen=True, eq=False)
class AsymptoticLayout:
    """A net along asymptotic curves with all that it came from; `width` and `hub` as they were used.

    Around `closed_hubs` of the singularities there is room for a polygon. With `hubs_cut` polygons are no faces.
    """

    directions: Directions
    hubs: tuple[Singularity, ...]
    legs: tuple[Ray, ...]
    bisectors: tuple[Ray, ...]
    limits: Limits
    width: float
    hub: float
    net: Net
    closed_hubs: int = 0
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
        return self._over(self.net.crossings.only(kept))

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
        more = trace_both_ways(self.directions, np.array(list(gaps.values())), "columns", self.limits)
        return self._over(self.net.crossings.with_columns(more))

    @cached_property
    def _spine(self) -> Leaf:
        """The crease with most vertices: without legs, columns are counted along it."""
        return self.net.creases[int(np.argmax(np.bincount(self.net.crease)))]

    def _over(self, crossings: Crossings) -> "AsymptoticLayout":
        return replace(self, net=overlay(crossings, self.net.hubs))


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
    radius = max(CIRCLE * abs(high - low), *(2 * hub.spread for hub in hubs))
    legs = rays(directions, hubs, "creases", limits, radius)
    bisectors = rays(directions, hubs, "columns", limits, radius)
    lengths = lengths_around(hubs, legs, bisectors, sizes)
    width, hub = lengths.width, lengths.hub
    _refuse_specks(directions.chart, width)
    limits = replace(limits, patch=PATCH * width)
    gap = (lengths.reach - hub) / max(sizes.columns - 1, 1)
    creases = spaced(directions, "creases", bisectors, legs, Spacing(FIRST_CREASE * width, width, lengths.span), limits)
    columns = spaced(directions, "columns", legs, bisectors, Spacing(hub, gap, lengths.reach), limits)
    net = overlay(Crossings.of(creases, columns), tuple(single.place for single in hubs))
    return AsymptoticLayout(directions, hubs, legs, bisectors, limits, width, hub, net, int(lengths.closed.sum()))


def _regular(directions: Directions, sizes: Sizes, limits: Limits) -> AsymptoticLayout:
    middle = np.array([beginning(directions.chart)])
    limits = replace(limits, patch=limits.step)
    spine = trace_both_ways(directions, middle, "creases", limits)[0]
    across = trace_both_ways(directions, middle, "columns", limits)[0]
    if not min(spine.length, across.length) > 0:
        raise Infeasible("the asymptotic curve through the middle of the surface ends at once: the surface is too narrow "
                         "there, or it has a hole; give another part of it, or close the hole")
    width = across.length / (sizes.creases + 1) if sizes.width is None else sizes.width
    _refuse_specks(directions.chart, width)
    limits = replace(limits, patch=PATCH * width)
    reach = spine.length if sizes.reach is None else 2 * sizes.reach
    creases = evenly(directions, "creases", across, sizes.creases, width, limits)
    columns = evenly(directions, "columns", spine, sizes.columns, reach / (sizes.columns + 1), limits)
    return AsymptoticLayout(directions, (), (), (), limits, width, 0.0, overlay(Crossings.of(creases, columns), ()))


def _refuse_specks(chart: Chart, width: float) -> None:
    low, high = chart.domain
    size = float(np.ptp(chart.positions(np.array([low, high, complex(low.real, high.imag), complex(high.real, low.imag)])),
                        axis=0).max())
    if width < SMALLEST * size:
        raise Infeasible(f"creases {width:.2g} apart are specks on a surface {size:.2g} large: curvature cannot be told "
                         "there; give a larger pattern.width, or fewer creases")
