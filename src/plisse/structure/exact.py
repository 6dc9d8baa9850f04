"""Ground truth: structures whose exactness follows from closed formulas, free of any solver.

All lengths are in model units, all angles in radians; vertex (l, i) of every structure is row l·columns + i.
"""

import numpy as np

from plisse.geometry.vectors import angle_between, norm, unit
from plisse.structure.cut import cut_along
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure

__all__ = ["alternating_cones", "conic_creases", "conical_vertex", "folded_grid", "marched", "miura"]


def alternating_cones(creases: int = 6, columns: int = 24, *, radius: float = 1.0, width: float = 0.2,
                      slope: float = 0.8, sector: float = 2.0, closed: bool = False) -> PleatedStructure:
    """Strips of cones that rise and fall with equal slope: the pleated annulus, exact and principal.

    Creases are regular polygons of radii R + l·width at heights 0, width·slope, 0, …; δ = sector/(columns −
    1) is the angle of one edge, 2π/columns if `closed`. Slopes of rulings are ±atan `slope` = ±β, so the base
    angles of the trapezoids obey cos α = cos β sin(δ/2) in every strip, and α, α, π − α, π − α meet in a
    vertex. All crease edges fold by 2 atan(slope / cos(δ/2)). The development is concentric, its radii are
    stretched by 1/cos β and its angles δ' obey sin(δ'/2) = cos β sin(δ/2).
    """
    step = 2 * np.pi / columns if closed else sector / (columns - 1)
    angle = -step * np.arange(columns)
    rings = radius + width * np.arange(creases)
    height = width * slope * (np.arange(creases) % 2)
    vertices = np.stack(np.broadcast_arrays(rings[:, None] * np.cos(angle), rings[:, None] * np.sin(angle),
                                            height[:, None]), axis=-1)
    topology = grid(creases, columns, closed_creases=closed)
    cosine = 1 / np.hypot(1, slope)
    flat_step = 2 * np.arcsin(cosine * np.sin(step / 2))
    flat_angle = -flat_step * np.arange(columns + closed)
    flat = rings[:, None, None] * np.stack([np.cos(flat_angle), np.sin(flat_angle)], axis=-1) / cosine
    if not closed:
        return PleatedStructure(topology, vertices.reshape(-1, 3), development=flat.reshape(-1, 2))
    cut = cut_along(topology, topology.rulings[0])
    # faces of the last column hold the copies beyond the cut
    beyond = cut.topology.quads.reshape(creases - 1, columns, 4)
    number = np.empty((creases, columns + 1), np.int64)
    number[:-1, :-1], number[:-1, 1:] = beyond[:, :, 0], beyond[:, :, 1]
    number[-1, :-1], number[-1, 1:] = beyond[-1, :, 3], beyond[-1, :, 2]
    development = np.empty((len(cut.source), 2))
    development[number] = flat
    return PleatedStructure(topology, vertices.reshape(-1, 3), cut, development)


def miura(creases: int = 5, columns: int = 8, *, edge: float = 1.0, ruling: float = 1.3, sector: float = 1.1,
          fold: float = 0.9) -> PleatedStructure:
    """The Miura-ori: parallelograms with angle `sector` = γ between crease edges and rulings, principal.

    The creases are the zigzags, every one a mountain or a valley along its whole length. `fold` = θ in [0,
    π/2) is the angle of all faces against the ground; creases fold by 2θ, and θ = 0 is flat.
    """
    rise = ruling * np.sin(fold) * np.sin(sector)
    run = ruling * np.sqrt(1 - (np.sin(fold) * np.sin(sector)) ** 2)
    stretch = np.sqrt(1 + (np.cos(fold) * np.tan(sector)) ** 2)
    along, aside = edge * np.cos(fold) * np.tan(sector) / stretch, edge / stretch
    level, column = np.mgrid[:creases, :columns]
    vertices = np.stack([column * along, level * run + (column % 2) * aside, (level % 2) * rise], axis=-1)
    flat_aside = (column % 2) * edge * np.cos(sector)
    flat = np.stack([column * edge * np.sin(sector), level * ruling + flat_aside], axis=-1)
    return PleatedStructure(grid(creases, columns), vertices.reshape(-1, 3), development=flat.reshape(-1, 2))


def conical_vertex(first: float = 1.2, second: float = 1.5, fold: float = 1.0) -> PleatedStructure:
    """One developable conical vertex with sector angles ω1, ω2, π − ω1, π − ω2 (Figs 8 and 10).

    Both crease edges fold by `fold` = φ1, the two rulings by ±φ2 with
    tan(φ2/2) / tan(φ1/2) = sin((ω2 − ω1)/2) / sin((ω2 + ω1)/2), ω1 and ω2 on both sides of a crease edge.
    """
    # sectors in turn from the forward crease edge: ω1, ω2, π − ω1, π − ω2; the first and last lie beside it
    direction = np.array([0.0, first, first + second, np.pi + second])
    forward, up, backward, down = np.stack([np.cos(direction), np.sin(direction)], axis=1)
    column, level = [backward, 0 * up, forward], [down, 0 * up, up]
    flat = np.array([[a + b for a in column] for b in level])
    ratio = np.sin((np.pi - second - first) / 2) / np.sin((np.pi - second + first) / 2)
    ruling_fold = 2 * np.arctan(np.tan(fold / 2) * ratio)
    return folded_grid(flat, [fold], [ruling_fold])


def conic_creases(creases: int = 5, columns: int = 24, *, eccentricity: float = 0.45, growth: float = 1.12,
                  fold: float = 1.2, start: float = 1.0, step: float = 0.09) -> PleatedStructure:
    """A principal structure of cones whose creases develop into similar ellipses with shared foci (Fig. 5).

    On the first ellipse (half axes 1 and √(1 − e²)) vertices are the bounces of a billiard ball from
    eccentric angle `start`, the first bounce `step` further: edges reflect in the true normals, as the rays
    between the foci do, and that is ω1 + ω3 = π. Every next ellipse is the last one enlarged by `growth` from
    one of its foci, alternately: it inherits that focus and the rulings of the strip run through it. With ν
    the angle of edges and μ that of focal rays against the normal, cos ν / cos μ = J along a billiard path
    (Joachimsthal), hence tan(φ_r/2) = J tan(φ_c/2): all creases fold by `fold`, all rulings by one and the
    same angle, and everything closes.
    """
    short = np.sqrt(1 - eccentricity**2)
    points, joachimsthal = _billiard(short, start, step, columns)
    focus, other = np.array([eccentricity, 0.0]), np.array([-eccentricity, 0.0])
    ellipses = [points]
    for _ in range(creases - 1):
        ellipses.append(focus + growth * (ellipses[-1] - focus))
        focus, other = focus + growth * (other - focus), focus
    signs = (-1.0) ** np.arange(creases - 2)
    ruling_fold = -2 * np.arctan(joachimsthal * np.tan(fold / 2))
    return folded_grid(np.array(ellipses), fold * signs, np.full(columns - 2, ruling_fold))


def _billiard(short: float, start: float, step: float, count: int) -> tuple[np.ndarray, float]:
    """Bounces (count, 2) in the ellipse x² + y²/short² = 1, clockwise, and Joachimsthal's invariant."""
    form = np.array([1.0, short**-2])
    points = [np.array([np.cos(angle), short * np.sin(angle)]) for angle in (start + step, start)]
    ray = unit(points[1] - points[0])
    invariant = float(np.abs(points[0] * form @ ray))
    while len(points) < count:
        normal = unit(form * points[-1])
        ray = unit(ray - 2 * (ray @ normal) * normal)
        points.append(points[-1] - 2 * (points[-1] * form @ ray) / (ray * form @ ray) * ray)
    return np.array(points), invariant


def folded_grid(flat: np.ndarray, crease_folds, ruling_folds) -> PleatedStructure:
    """What a flat pattern (m, n, 2) becomes with given fold angles, valleys positive.

    `crease_folds` (m − 2,) are the folds of inner creases, `ruling_folds` (n − 2,) those of the rulings of
    the first strip; both must fit the pattern, for faces are placed along one tree and nothing is averaged.
    """
    flat3 = np.concatenate([flat, np.zeros((*flat.shape[:2], 1))], axis=-1)
    rotation, shift = [np.eye(3)], [np.zeros(3)]
    for i, fold in enumerate(ruling_folds, start=1):
        turn = _rotation(unit(flat3[0, i] - flat3[1, i]), np.asarray(fold))
        rotation.append(rotation[-1] @ turn)
        hinge = flat3[0, i]
        shift.append(shift[-1] + rotation[-2] @ hinge - rotation[-1] @ hinge)
    strip = np.array(rotation), np.array(shift)
    strips = [strip]
    for level, fold in enumerate(crease_folds, start=1):
        hinge = flat3[level, :-1]
        turned = strip[0] @ _rotation(unit(flat3[level, 1:] - flat3[level, :-1]), np.asarray(fold))
        strip = turned, strip[1] + _apply(strip[0], hinge) - _apply(turned, hinge)
        strips.append(strip)
    rows = [strips[0], *strips]
    vertices = np.array([_apply(r[[0, *range(len(r))]], flat3[level]) + s[[0, *range(len(s))]]
                         for level, (r, s) in enumerate(rows)])
    topology = grid(*flat.shape[:2])
    return PleatedStructure(topology, vertices.reshape(-1, 3), development=flat.reshape(-1, 2))


def _apply(matrices: np.ndarray, points: np.ndarray) -> np.ndarray:
    return np.einsum("...ij,...j->...i", matrices, points)


def _rotation(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Rotations (…, 3, 3) about unit axes (…, 3)."""
    x, y, z = np.moveaxis(axis, -1, 0)
    zero = np.zeros_like(x)
    skew = np.moveaxis(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]), (0, 1), (-2, -1))
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def marched(creases: int = 4, columns: int = 16, *, width: float = 0.15, bend: float = 0.8,
            reach: float = 0.6, fold: float | None = None) -> PleatedStructure:
    """A general, not principal, structure that begins with a strip of the unit cylinder.

    Given a strip, any crease q on its rulings and the fold at the first crease edge, the next strip follows
    vertex by vertex: with b, f unit vectors to q[i−1], q[i+1], S = 2π − ω1 − ω2 and h the unit direction of
    the new face i − 1 orthogonal to b, the ruling is cos x b + sin x h with tan x = (b·f − cos S) / (sin S −
    h·f). The second crease has distance `width` + `bend` s²/2 from the circle where the cylinder begins, s
    its arc length from −`reach` to `reach`; later creases have distance `width`. Without `fold` the first
    edge folds so that rulings do not alternate, close to where the osculating plane mirrors the faces, as it
    does on smooth creases.
    """
    arc = np.linspace(-reach, reach, columns)
    start = np.stack([np.sin(arc), -np.cos(arc), 0 * arc], axis=1)
    rulings = np.broadcast_to([0.0, 0.0, 1.0], start.shape)
    rows = [start, start + (width + bend * arc**2 / 2)[:, None] * rulings]
    for _ in range(creases - 2):
        rulings = _next_rulings(rows[-1], -rulings, fold)
        rows.append(rows[-1] + width * rulings)
    return PleatedStructure(grid(creases, columns), np.concatenate(rows))


def _next_rulings(crease: np.ndarray, back: np.ndarray, fold: float | None) -> np.ndarray:
    """Rulings (n, 3) beyond a crease (n, 3) with unit rulings `back` into the strip before it."""
    edge = unit(np.diff(crease, axis=0))
    sectors = angle_between(back[1:-1], -edge[:-1]) + angle_between(back[1:-1], edge[1:])
    known = unit(back[0] - (back[0] @ edge[0]) * edge[0])

    def folded(angle: float) -> np.ndarray:
        inward = -np.cos(angle) * known + np.sin(angle) * np.cross(edge[0], known)
        return _around(edge, 2 * np.pi - sectors, inward)

    if fold is not None:
        return folded(fold)
    angle = _mirrored_fold(edge, known)
    for reach in (0.2, 0.01, 5e-4, 2.5e-5):
        options = angle + np.linspace(-reach, reach, 81)
        angle = options[np.argmin([_unevenness(folded(option)) for option in options])]
    return folded(angle)


def _around(edge: np.ndarray, left: np.ndarray, inward: np.ndarray) -> np.ndarray:
    """Rulings (n, 3) for sector sums `left` (n − 2,) beyond a crease; `inward` lies in the first new face."""
    rulings = []
    for i, remaining in enumerate(left):
        b, f = -edge[i], edge[i + 1]
        x = np.arctan2(b @ f - np.cos(remaining), np.sin(remaining) - inward @ f) % np.pi
        ruling = np.cos(x) * b + np.sin(x) * inward
        inward = unit(ruling - (ruling @ f) * f)
        rulings.append(ruling)
    return np.array([_end(rulings[:3], edge[0]), *rulings, _end(rulings[:-4:-1], edge[-1])])


def _end(rulings: list[np.ndarray], edge: np.ndarray) -> np.ndarray:
    """A free ruling in the plane of the end's edge and the nearest of three rulings, the turn continued."""
    nearest, second, third = rulings
    turn = 2 * angle_between(nearest, second) - angle_between(second, third)
    away = unit(nearest - (nearest @ edge) * edge)
    sign = np.sign((nearest - second) @ edge)
    angle = np.arctan2(nearest @ away, nearest @ edge) - sign * turn
    return np.cos(angle) * edge + np.sin(angle) * away


def _mirrored_fold(edge: np.ndarray, known: np.ndarray) -> float:
    """Fold at the first edge under which the osculating plane there mirrors the faces on both sides."""
    osculating = unit(np.cross(edge[:-1], edge[1:]))
    normal = 1.5 * osculating[0] - 0.5 * osculating[1]
    normal = unit(normal - (normal @ edge[0]) * edge[0])
    across = np.cross(edge[0], known)
    return float(np.pi - 2 * np.arctan2(normal @ across, normal @ known))


def _unevenness(rulings: np.ndarray) -> float:
    """How much rulings alternate: third differences."""
    return float(norm(np.diff(rulings[1:-1], n=3, axis=0)).sum())
