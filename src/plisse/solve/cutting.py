"""Where to cut a closed structure so that it can be laid flat."""

import numpy as np

from plisse.solve.flatten import laid_out, unfold
from plisse.structure.cut import Cut, cut_along, cut_apart, cut_open, uncut
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline, Topology

__all__ = ["best_cut"]

CANDIDATES = 8


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
        return _smallest(structure, [topology.creases[0]]) if _is_tube(topology) else cut_open(topology)
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
    from plisse.measure.overlap import development_overlap

    sheets = []
    for line in lines:
        cut = cut_along(structure.topology, line)
        flat = laid_out(cut.topology, unfold(cut.topology, structure.vertices[cut.source]))
        sheets.append((float(np.prod(np.ptp(flat, axis=0))), cut, flat))
    sheets.sort(key=lambda sheet: sheet[0])
    return next((cut for _, cut, flat in sheets if not development_overlap(cut.topology, flat).overlaps), sheets[0][1])
