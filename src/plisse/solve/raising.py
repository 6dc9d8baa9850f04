"""Ways to a pattern with singularities, and its refinement along the creases (§2.6, Figs 18 and 22)."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from plisse.layout.asymptotic.pattern import AsymptoticLayout
from plisse.measure.intersection import intersecting_faces
from plisse.measure.regularity import Regularity, regularity
from plisse.solve.singular import Hold, Solved, Zigzag, polished, relaxed, smoothed
from plisse.solve.workspace import Workspace

__all__ = ["Raised", "Way", "finer", "raised", "zigzag_over"]

CONVERGED = 1e-11
COMFORTABLE = np.radians(15.0)
HOLD, STRONGER, LOOSE = Hold(0.3, 0.25), Hold(0.3, 1.0), Hold(0.1, 0.25, 2)
STEPS = (0.5, 0.65, 0.8, 0.9, 1.0)
BEFORE = 4  # vertices of a crease from which displacements are interpolated by cubics


@dataclass(frozen=True)
class Way:
    """How a structure is sought: the heights of the surface on the way up, what holds it, and the share of the amplitude
    that is left in a singularity."""

    heights: tuple[float, ...] = (1.0,)
    hold: Hold = HOLD
    taper: float = 1.0

    @property
    def name(self) -> str:
        """The way in words."""
        return ("at once" if len(self.heights) == 1 else f"raised in {len(self.heights)} steps") + \
            (f", amplitude {self.taper:g} times as large in the middle" if self.taper < 1 else "") + \
            f", held by {self.hold.closeness:g} and {self.hold.height:g}"


WAYS = (Way(), Way(hold=STRONGER), Way(hold=LOOSE), Way(STEPS), Way(STEPS, STRONGER), Way(STEPS, LOOSE),
        Way(STEPS, taper=0.4), Way(STEPS, STRONGER, 0.4))


@dataclass(frozen=True, eq=False)
class Raised:
    """A structure over a layout: the zigzag it started from, what was solved, on which way and up to which height."""

    layout: AsymptoticLayout
    zigzag: Zigzag
    solved: Solved
    way: Way
    height: float

    @cached_property
    def regularity(self) -> Regularity:
        """Sector and opening angles."""
        return regularity(self.zigzag.topology, self.solved.vertices)

    @property
    def is_exact(self) -> bool:
        """Whether the minimum-norm steps converged."""
        return self.solved.defect < CONVERGED

    @property
    def is_sound(self) -> bool:
        """Whether it is exact, regular, folded as labelled and at the height asked for."""
        return bool(self.height == 1 and self.is_exact and self.regularity.is_regular
                    and not self.zigzag.against_labels(self.solved.vertices).any())

    @property
    def comfort(self) -> float:
        """The smallest angle in radians that keeps the structure regular: of sectors, and of folds from flat and shut."""
        return min(self.regularity.min_sector, self.regularity.min_opening, np.pi - self.regularity.max_opening)

    @property
    def rank(self) -> tuple:
        """Sort key: soundness, exactness and height, then comfort."""
        return self.is_sound, self.is_exact, self.height, self.comfort if self.is_exact else -self.solved.defect

    @property
    def account(self) -> str:
        """One line for the report."""
        return (f"{self.way.name}: height {self.height:g}, residual {self.solved.defect:.1e}, smallest sector "
                f"{np.degrees(self.regularity.min_sector):.1f}°")


def zigzag_over(layout: AsymptoticLayout, amplitude: float, taper: float = 1.0) -> Zigzag:
    """Creases moved off the surface by the amplitude, to the side that their labels say.

    With `taper` below 1 the amplitude grows from that share of it in the singularities to all of it far away.
    """
    net, share = layout.net, np.ones(len(layout.points))
    if taper < 1 and net.hubs:
        away = np.min([np.abs(net.places - hub) for hub in net.hubs], axis=0)
        share = taper + (1 - taper) * np.clip(away / (0.7 * away.max()), 0, 1)
    labels = layout.labels
    return Zigzag(layout.topology, layout.points, layout.normals, labels.of_creases[net.crease], labels.repeats,
                  share * amplitude)


def raised(layout: AsymptoticLayout, amplitude: float, workspace: Workspace) -> tuple[Raised, list[str]]:
    """The best structure over a layout, by the first way that leads to a sound one, and an account of the others."""
    found: list[Raised] = []
    for way in WAYS:
        found.append(_by(way, layout, amplitude, workspace))
        if found[-1].is_sound and found[-1].comfort > COMFORTABLE \
                and not len(intersecting_faces(found[-1].zigzag.topology, found[-1].solved.vertices)):
            break
    best = max(found, key=lambda result: result.rank)
    return best, [result.account for result in found if result is not best]


def _by(way: Way, layout: AsymptoticLayout, amplitude: float, workspace: Workspace) -> Raised:
    whole = zigzag_over(layout, amplitude, way.taper)
    displacement, last = np.zeros_like(whole.feet), None
    for height in way.heights:
        zigzag = whole if height == 1 else whole.raised(height)
        solved = relaxed(zigzag, displacement, way.hold, workspace)
        current = Raised(layout, zigzag, solved, way, height)
        if not (current.is_exact and current.regularity.is_regular):
            return current if last is None or height == 1 else last
        displacement, last = solved.vertices - zigzag.vertices, current
    assert last is not None
    return last


def finer(found: Raised, layout: AsymptoticLayout, workspace: Workspace) -> Raised | None:
    """The same structure with the columns of a finer layout, or None where it does not stay sound.

    Displacements are interpolated along the creases and polished. Beside holes, where nothing holds the creases,
    minimum-norm steps would kink them along a ruling polyline: there displacements are made smooth first. Raises
    Infeasible where the finer layout has no labels.
    """
    zigzag = _relabelled(zigzag_over(layout, float(found.zigzag.amplitude.max()), found.way.taper), layout, found)
    moved = zigzag.vertices + _along_creases(found, layout)
    for start in ((smoothed, _as_it_is) if layout.hubs_cut else (_as_it_is,)):
        solved = polished(zigzag, start(zigzag, moved, workspace), workspace, found.solved.iterations, chord=True)
        after = replace(found, layout=layout, zigzag=zigzag, solved=solved)
        if after.is_sound:
            return after
    return None


def _as_it_is(zigzag: Zigzag, vertices: np.ndarray, workspace: Workspace) -> np.ndarray:
    return vertices


def _relabelled(zigzag: Zigzag, layout: AsymptoticLayout, found: Raised) -> Zigzag:
    """The zigzag with the labels that its creases had before."""
    before = np.zeros(len(layout.net.creases), int)
    before[found.layout.net.crease] = found.zigzag.labels
    kept = before[layout.net.crease]
    sign = 1 if kept @ zigzag.labels >= 0 else -1
    return replace(zigzag, labels=np.where(kept != 0, kept, sign * zigzag.labels))


def _along_creases(found: Raised, layout: AsymptoticLayout) -> np.ndarray:
    """Displacements (V, 3) of the vertices of a finer layout on the same creases."""
    before, after = found.layout.net, layout.net
    displacement, out = found.solved.vertices - found.zigzag.vertices, np.zeros((len(after.places), 3))
    for crease in np.unique(before.crease):
        on = np.flatnonzero(before.crease == crease)
        on = on[np.argsort(before.along[on])]
        at = np.flatnonzero(after.crease == crease)
        along = np.clip(after.along[at], before.along[on[0]], before.along[on[-1]])
        out[at] = CubicSpline(before.along[on], displacement[on])(along) if len(on) >= BEFORE \
            else displacement[on].mean(axis=0)
    return out
