"""Cutting a closed structure open so that it can be laid flat (§4, Figs 9 and 26)."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from plisse.structure.lines import edge_keys
from plisse.structure.topology import Polyline, Topology

__all__ = ["Cut", "cut_along", "cut_apart", "cut_open", "uncut"]


@dataclass(frozen=True, eq=False)
class Cut:
    """A topology cut open and, for each of its vertices, the vertex it comes from."""

    topology: Topology
    source: np.ndarray

    @property
    def is_trivial(self) -> bool:
        """Whether nothing was cut."""
        return len(self.source) == len(np.unique(self.source))


def uncut(topology: Topology) -> Cut:
    """The topology itself, for structures that are simply connected already."""
    return Cut(topology, np.arange(topology.vertex_count))


def cut_along(topology: Topology, *lines: Polyline) -> Cut:
    """The topology with both copies of every vertex inside the lines; faces and their order stay the same."""
    key = edge_keys(topology.edges.vertices, topology.vertex_count)
    return _severed(topology, np.isin(key, np.concatenate([_line_keys(line, topology.vertex_count) for line in lines])))


def cut_apart(topology: Topology) -> Cut:
    """The topology parted along its seams, and every part cut open into a disk."""
    edges = edge_keys(topology.edges.vertices, topology.vertex_count)
    parted = _severed(topology, np.isin(edges, edge_keys(topology.seams, topology.vertex_count)))
    opened = cut_open(parted.topology)
    return Cut(opened.topology, parted.source[opened.source])


def cut_open(topology: Topology) -> Cut:
    """Any topology cut open into disks, one per piece, along a short graph of edges that joins its holes and handles.

    Faces are joined along breadth-first trees; of the edges that the trees do not cross those remain severed that
    lead somewhere, because loose ends are closed again.
    """
    edges = topology.edges
    inner = np.flatnonzero(~edges.is_boundary)
    link = coo_array((np.ones(len(inner)), edges.faces[inner].T), shape=(topology.face_count,) * 2).tocsr()
    roots = np.unique(topology.piece_of_faces, return_index=True)[1]
    parent = np.max([breadth_first_order(link, root, directed=False)[1] for root in roots], axis=0)
    first, second = edges.faces[:, 0], edges.faces[:, 1]
    joined = ~edges.is_boundary & ((parent[first] == second) | (parent[second] == first))
    severed = ~joined
    while True:
        degree = np.bincount(edges.vertices[severed].ravel(), minlength=topology.vertex_count)
        loose = severed & ~edges.is_boundary & (degree[edges.vertices] == 1).any(axis=1)
        if not loose.any():
            break
        severed &= ~loose
    return _severed(topology, severed & ~edges.is_boundary)


def _severed(topology: Topology, severed: np.ndarray) -> Cut:
    """The topology with the faces at severed edges (mask over edges) parted."""
    corners, count = topology.corners, np.int64(topology.vertex_count)
    touched = np.zeros(count, bool)
    touched[topology.edges.vertices[severed]] = True
    near = np.flatnonzero(touched[corners.vertex])
    # around a vertex, a corner meets another where the edge that leaves one face arrives in the other
    leaving, arriving = (corners.vertex[near] * count + ends[near] for ends in (corners.next, corners.previous))
    apart = topology.edges.vertices[severed]
    apart = np.concatenate([apart[:, 0] * count + apart[:, 1], apart[:, 1] * count + apart[:, 0]])
    shared, first, second = np.intersect1d(leaving, arriving, assume_unique=True, return_indices=True)
    links = np.stack([first, second])[:, ~np.isin(shared, apart)]
    graph = coo_array((np.ones(links.shape[1]), links), shape=(len(near),) * 2)
    return _relabel(topology, near, connected_components(graph, directed=False)[1])


def _relabel(topology: Topology, near: np.ndarray, label: np.ndarray) -> Cut:
    """Number the classes of the corners `near` cuts so that vertices keep their numbers and copies come last."""
    corner = topology.corners.vertex.copy()
    _, first = np.unique(label, return_index=True)
    source = corner[near[first]]
    order = np.lexsort((first, source))
    copies = order[1:][np.diff(source[order]) == 0]
    number = source.copy()
    number[copies] = topology.vertex_count + np.arange(len(copies))
    corner[near] = number[label]
    quads = corner[: topology.quads.size].reshape(-1, 4)
    sizes = np.cumsum([len(hub) for hub in topology.hubs])
    hubs = tuple(np.split(corner[topology.quads.size:], sizes[:-1])) if topology.hubs else ()
    all_sources = np.concatenate([np.arange(topology.vertex_count), source[copies]])
    ordering = None if topology.ordering is None else topology.ordering[all_sources]
    return Cut(Topology(len(all_sources), quads, hubs, ordering), all_sources)


def _line_keys(line: Polyline, vertex_count: int) -> np.ndarray:
    vertices = line.path
    return edge_keys(np.stack([vertices[:-1], vertices[1:]], axis=1), vertex_count)
