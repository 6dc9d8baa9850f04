"""Mountains and valleys by parity (§2.6).

At a vertex with two creases that fold the same way its two rulings fold oppositely, with a sign that is the product of
label and turning. So neighbouring creases that turn to the same side have opposite labels; where they turn to different
sides, as across a leg of a singularity, the label repeats.
"""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible
from plisse.layout.asymptotic.bends import Bends
from plisse.layout.asymptotic.overlay import Net

__all__ = ["Labels", "labelled", "propagated"]


@dataclass(frozen=True, eq=False)
class Labels:
    """Label ±1 (C,) of every crease of a net, 0 for creases without faces; `repeats` (E,) marks rulings across which the
    label stays the same."""

    of_creases: np.ndarray
    repeats: np.ndarray


def labelled(net: Net, points: np.ndarray, bends: Bends) -> Labels:
    """Labels of the creases of a net at `points` (V, 3).

    The strips that meet in a singularity repeat them; others alternate unless the creases beside them mostly turn to
    different sides. Raises Infeasible where creases would have to be mountain and valley at once.
    """
    topology = net.topology
    edges = topology.edges
    ruling = ~edges.is_crease
    strip = topology.strip_of_faces[edges.faces[:, 0]]
    one, other = edges.vertices.T
    vote = np.bincount(strip[ruling], bends.facing(points, one[ruling], other[ruling]), strip.max() + 1)
    repeating = vote < 0
    repeating[topology.strip_of_faces[len(topology.quads):]] = True
    repeats = ruling & repeating[strip]
    links = np.stack([net.crease[one[ruling]], net.crease[other[ruling]], np.where(repeats[ruling], 1, -1)], axis=1)
    return Labels(propagated(np.unique(links, axis=0), len(net.creases)), repeats)


def propagated(links: np.ndarray, count: int) -> np.ndarray:
    """Labels ±1 (C,) of creases, linked by rows (a, b, sign): sign 1 repeats a label, −1 changes it.

    Creases without links get 0. Raises Infeasible where links contradict each other.
    """
    neighbours: dict[int, list[tuple[int, int]]] = {}
    for a, b, sign in links.tolist():
        neighbours.setdefault(a, []).append((b, sign))
        neighbours.setdefault(b, []).append((a, sign))
    label = np.zeros(count, int)
    for root in neighbours:
        if label[root]:
            continue
        label[root] = 1
        waiting = [root]
        while waiting:
            crease = waiting.pop()
            for beside, sign in neighbours[crease]:
                if label[beside] == 0:
                    label[beside] = sign * label[crease]
                    waiting.append(beside)
                elif label[beside] != sign * label[crease]:
                    raise Infeasible(f"mountains and valleys cannot be assigned: crease {beside + 1} would have to be both, "
                                     f"because strips around it that alternate and strips that do not, beside crease "
                                     f"{crease + 1}, disagree; cut the surface open, or choose a smaller part of it")
    return label
