"""Where to cut a closed structure so that it can be laid flat."""

from itertools import pairwise

import numpy as np

from plisse.geometry.vectors import norm
from plisse.solve.flatten import smallest_box, unfold
from plisse.structure.chains import boundary_loops
from plisse.structure.cut import Cut, cut_along, cut_apart, cut_open, uncut
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline, Topology

__all__ = ["best_cut"]

CANDIDATES = 8
EQUAL = 6  # digits to which areas differ, or the first line is as good


def best_cut(structure: PleatedStructure, percent: float | None = None) -> Cut:
    """The transverse polyline along which a closed structure opens into the smallest sheet without overlap.

    `percent` of the crease's length names the cut instead. Simply connected structures are not cut; structures whose
    family closes are cut along a crease, others with holes along a short graph of edges. Seams part a structure anyway.
    """
    topology = structure.topology
    if len(topology.seams):
        return cut_apart(topology)
    if topology.euler_characteristic >= 1:
        return uncut(topology)
    if not all(line.closed for line in (topology.creases if percent is None else topology.creases[:1])):
        return cut_along(topology, topology.creases[0]) if _is_tube(topology) else cut_open(topology)
    lines = [line for line in topology.rulings if not line.closed]
    along = topology.creases[0].vertices
    rank = {int(vertex): k for k, vertex in enumerate(along)}
    lines = sorted((line for line in lines if int(line.vertices[0]) in rank), key=lambda line: rank[int(line.vertices[0])])
    if percent is not None:
        return cut_along(topology, lines[round(percent / 100 * len(lines)) % len(lines)])
    chosen = [lines[k] for k in np.unique(np.linspace(0, len(lines), CANDIDATES, endpoint=False).astype(int))]
    return _smallest(structure, chosen)


def _is_tube(topology: Topology) -> bool:
    """Whether rulings close and creases run from one end to the other."""
    return topology.euler_characteristic == 0 and all(line.closed for line in topology.rulings)


def _smallest(structure: PleatedStructure, lines: list[Polyline]) -> Cut:
    """The best of the cuts along lines that follow each other around a ring."""
    from shapely import linearrings

    outlines = _outlines(structure, lines)
    areas = np.array([np.prod(norm(smallest_box(outline))) for outline in outlines])
    order = np.argsort(np.round(areas / areas.min(), EQUAL), kind="stable")
    best = next((k for k in order if linearrings(outlines[k]).is_simple), order[0])
    return cut_along(structure.topology, lines[best])


def _outlines(structure: PleatedStructure, lines: list[Polyline]) -> list[np.ndarray]:
    """Outlines (N, 2) of the sheets for all cuts, from one of them that is continued beyond its end."""
    cut = cut_along(structure.topology, lines[0])
    flat = unfold(cut.topology, structure.vertices[cut.source]) @ [1, 1j]
    outer, inner, start, end = _sides(cut, lines[0].vertices)
    middles = flat[start].mean(), flat[end].mean()
    turn = np.vdot(flat[start] - middles[0], flat[end] - middles[1])
    again = middles[1] + turn / abs(turn) * (flat - middles[0])
    outlines = []
    for line in lines:
        path = start if line is lines[0] else line.vertices
        rims = []
        for rim, vertex in ((outer, line.vertices[0]), (inner, line.vertices[-1])):
            place = int(np.argmax(cut.source[rim] == vertex))
            rims.append(np.concatenate([flat[rim[place:]], again[rim[1:place + 1]]]))
        outline = np.concatenate([rims[0], again[path[1:-1]], rims[1][::-1], flat[path[-2:0:-1]]])
        outlines.append(np.stack([outline.real, outline.imag], axis=1))
    return outlines


def _sides(cut: Cut, line: np.ndarray) -> tuple[np.ndarray, ...]:
    """Vertices along both rims of a ring that is cut along a line, from one of its copies to the other, and both copies."""
    loop = boundary_loops(cut.topology)[0]
    loop = np.roll(loop, -int(np.argmax(cut.source[loop] == line[0])))
    if cut.source[loop[1]] == line[1]:
        loop = np.roll(loop[::-1], 1)
    turns = np.flatnonzero(np.isin(cut.source[loop], line[[0, -1]]))
    outer, end, inner = (loop[first:last + 1] for first, last in pairwise(turns))
    return outer, inner[::-1], np.roll(loop[::-1], 1)[:len(line)], end
