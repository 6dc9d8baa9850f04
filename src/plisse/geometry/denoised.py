"""Smooth graphs of measured meshes: as smooth as their noise asks for, because pleats follow curvature."""

import numpy as np

from plisse.geometry.graph import GraphSurface
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.thinned import thinned

__all__ = ["SMOOTHINGS", "denoised_graph"]

SMOOTHINGS = (0.4, 0.8, 1.6, 2.4, 3.6, 5.0, 7.0)
FREEDOM = 0.069  # waves that a smoothing over one edge length leaves, per vertex of an even mesh
AS_GOOD = 1.5  # times the error of cross-validation that more smoothing may cost: second derivatives need it
NEGLIGIBLE = 2e-5  # diagonals
STEEP = 0.01  # of the area, that may face away: single faces lean over where there is noise, before it is smoothed away


def denoised_graph(mesh: ReferenceMesh, smoothing: float | None = None) -> GraphSurface:
    """The graph over a mesh, smoothed over `smoothing` edge lengths or over as many as its noise asks for.

    That is the largest number for which generalised cross-validation, distances of the vertices over the share of
    freedom that is left, hardly exceeds its minimum. Large meshes are thinned out first. Raises Infeasible where
    the mesh is no graph.
    """
    edge, mesh = mesh.edge_length, thinned(mesh)
    if smoothing is not None:
        return GraphSurface(mesh, smoothing=max(SMOOTHINGS[0], smoothing * edge / mesh.edge_length), steep=STEEP)
    graphs = [GraphSurface(mesh, smoothing=smooth, steep=STEEP) for smooth in SMOOTHINGS]
    errors = np.array([_distance(graph) / (1 - FREEDOM / graph.smoothing**2) for graph in graphs])
    good = errors <= max(AS_GOOD * errors.min(), NEGLIGIBLE * mesh.diagonal)
    return graphs[int(np.flatnonzero(good)[-1])]


def _distance(graph: GraphSurface) -> float:
    """Root of the mean squared height of the vertices over the graph."""
    plane = graph.to_plane(graph.mesh.vertices)
    return float(np.sqrt(np.mean((graph.heights(plane[:, :2])[0] - plane[:, 2]) ** 2)))
