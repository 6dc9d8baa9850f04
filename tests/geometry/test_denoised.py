"""Noise is smoothed away, shapes are not."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from plisse.errors import Infeasible
from plisse.geometry.denoised import SMOOTHINGS, denoised_graph
from plisse.geometry.graph import GraphSurface, facing_up
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.thinned import thinned


def scattered(noise, count=350):
    """A wavy graph over scattered points of a disk, with noise along z."""
    rng = np.random.default_rng(3)
    places = rng.uniform(-1, 1, (count, 2))
    places = places[np.hypot(*places.T) < 1]
    height = 0.2 * np.sin(2 * places[:, 0]) * np.cos(1.5 * places[:, 1]) + noise * rng.standard_normal(len(places))
    triangles = Delaunay(places).simplices
    a, b, c = places[triangles].transpose(1, 0, 2)
    turned = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0] < 0
    triangles[turned] = triangles[turned][:, ::-1]
    sides = np.stack([a - b, b - c, c - a])
    triangles = triangles[np.hypot(*sides.transpose(2, 0, 1)).max(axis=0) < 0.25]  # without slivers along the rim
    return ReferenceMesh(np.column_stack([places, height]), triangles)


def test_noisy_meshes_are_smoothed_more_than_exact_ones():
    exact, noisy = denoised_graph(scattered(0.0)), denoised_graph(scattered(2e-3))
    assert noisy.smoothing > exact.smoothing
    assert noisy.smoothing in SMOOTHINGS


def test_second_derivatives_are_nearer_to_the_truth_than_without_smoothing():
    mesh = scattered(2e-3)
    places = np.array([[0.1, 0.2], [-0.4, 0.1], [0.3, -0.4], [-0.2, -0.3]])

    def error(graph):
        at = graph.project(np.column_stack([places, np.full(len(places), 0.2)])).bending[:, 0, 0]
        return np.abs(at + 0.8 * np.sin(2 * places[:, 0]) * np.cos(1.5 * places[:, 1])).max()

    assert error(denoised_graph(mesh)) < 0.5 * error(denoised_graph(mesh, 0.4))


def test_a_smoothing_that_is_asked_for_is_taken():
    assert denoised_graph(scattered(0.0), 2.5).smoothing == 2.5


def test_large_meshes_are_thinned_to_means_that_lie_nearer_to_the_truth_than_their_vertices():
    mesh = scattered(2e-3, count=27_000)
    thin = thinned(mesh)
    assert 4500 < len(thin.vertices) < 6500
    assert len(thin.vertices) - len(thin.edges) + len(thin.triangles) == 1
    assert thin.area == pytest.approx(mesh.area, rel=0.3)  # noise makes faces steep, and the rim loses half a cell
    assert (thin.face_vectors[:, 2] > 0).all()

    def miss(points):
        x, y, z = points.T
        return np.sqrt(np.mean((z - 0.2 * np.sin(2 * x) * np.cos(1.5 * y)) ** 2))

    assert miss(thin.vertices) < 0.85 * miss(mesh.vertices)


def test_single_faces_that_lean_over_do_not_keep_a_noisy_mesh_from_being_smoothed():
    mesh = scattered(0.0)
    vertices = mesh.vertices.copy()
    vertices[mesh.triangles[7, 0], :2] += 2.2 * (vertices[mesh.triangles[7, 1:]].mean(axis=0)
                                               - vertices[mesh.triangles[7, 0]])[:2]
    leaning = ReferenceMesh(vertices, mesh.triangles)
    assert 0.99 < facing_up(leaning) < 0.9999
    with pytest.raises(Infeasible, match="give a flatter part of it"):
        GraphSurface(leaning)
    assert denoised_graph(leaning).smoothing in SMOOTHINGS
