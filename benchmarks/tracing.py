"""Crossings per second of the literal tracer, points per second of the smooth one: python benchmarks/tracing.py."""

import time

import numpy as np

from plisse.geometry.formulas import HeightField, Sphere
from plisse.geometry.graph import GraphSurface
from plisse.geometry.jets import JetSurface
from plisse.layout.trace import trace
from plisse.layout.trace_literal import TOGETHER, LiteralTracer, trace_literal


def literal(mesh, curves: int, theta: float, crossings: int) -> float:
    """Edge crossings per second of the loop alone, in millions."""
    rng = np.random.default_rng(0)
    faces = rng.integers(0, len(mesh.triangles), curves)
    starts = np.einsum("nk,nki->ni", rng.dirichlet([2, 2, 2], curves), mesh.corners[faces])
    tracer, total, begin = LiteralTracer(mesh), 0, time.perf_counter()
    for i in range(0, curves, TOGETHER):
        some = slice(i, i + TOGETHER)
        count = len(starts[some])
        rows, _, _ = tracer.march(starts[some], faces[some], rng.normal(size=(count, 3)), np.full(count, theta),
                                  np.ones(count), np.inf, crossings)
        total += sum(row.shape[1] for row in rows[1:])
    return total / (time.perf_counter() - begin) / 1e6


def main() -> None:
    """Print a small table."""
    sphere = Sphere(1.0).mesh(160)
    wave = HeightField("0.2 * sin(2 * x) * cos(y) + 0.1 * x**2 * y", (-1.5, 1.5), (-1.0, 1.0))
    mesh = wave.mesh(80)
    for name, where, theta in (("sphere", sphere, 60), ("wave", mesh, 60), ("wave, geodesics", mesh, 90)):
        rate = literal(where, 8000, np.radians(theta), 300)
        print(f"literal, {name:16s} {len(where.triangles):6d} faces  {rate:6.2f} million crossings/s")
    starts = np.stack([np.linspace(-1.4, 1.4, 400), np.zeros(400), np.zeros(400)], axis=1)
    many = np.random.default_rng(0).uniform([-1.4, -0.9, 0], [1.4, 0.9, 0], (10_000, 3))
    begin = time.perf_counter()
    curves = trace_literal(mesh, many, [0, 1, 0], np.radians(60))
    points = sum(len(curve.points) for curve in curves)
    print(f"literal, with bookkeeping      {points / (time.perf_counter() - begin) / 1e6:6.2f} million points/s")
    for surface in (wave, GraphSurface(mesh), JetSurface(mesh)):
        surface.project(starts)
        begin = time.perf_counter()
        points = sum(len(curve.points) for curve in trace(surface, starts, [0, 1, 0], np.radians(60)))
        rate = points / (time.perf_counter() - begin) / 1e3
        print(f"smooth, {type(surface).__name__:22s} {rate:6.1f} thousand points/s")


if __name__ == "__main__":
    main()
