"""Noise is smoothed away, shapes are not."""

import numpy as np
from scipy.spatial import Delaunay

from plisse.geometry.denoised import SMOOTHINGS, denoised_graph
from plisse.geometry.mesh import ReferenceMesh


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
