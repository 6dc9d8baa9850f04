"""Crossings per second of the literal tracer, points per second of the smooth one: `python benchmarks/tracing.py`."""

import numpy as np

from clocks import alone, spent
from plisse.geometry.formulas import HeightField, Sphere
from plisse.geometry.graph import GraphSurface
from plisse.geometry.jets import JetSurface
from plisse.geometry.mesh import ReferenceMesh
from plisse.layout.trace import trace
from plisse.layout.trace_literal import TOGETHER, LiteralTracer, trace_literal

TITLE = "Tracing"
WAVE = HeightField("0.2 * sin(2 * x) * cos(y) + 0.1 * x**2 * y", (-1.5, 1.5), (-1.0, 1.0))
INCLINATION = np.radians(60)


def measured(quick: bool = False) -> dict:
    """Rates of edge crossings, of whole literal curves, and of points on smooth surfaces."""
    curves, starts = (500, 40) if quick else (8000, 400)
    mesh = WAVE.mesh(40 if quick else 80)
    where = {"sphere": (Sphere(1.0).mesh(80 if quick else 160), 60), "wave": (mesh, 60), "wave, geodesics": (mesh, 90)}
    crossings = [{"name": name, "faces": len(surface.triangles), **_crossings(surface, curves, np.radians(theta))}
                 for name, (surface, theta) in where.items()]
    many = np.random.default_rng(0).uniform([-1.4, -0.9, 0], [1.4, 0.9, 0], (10_000 if not quick else 1000, 3))
    found, clocks = spent(lambda: trace_literal(mesh, many, [0, 1, 0], INCLINATION))
    return {"crossings": crossings, "curves_per_second": _points(found) / clocks["cpu"],
            "smooth": [_smooth(surface, starts) for surface in (WAVE, GraphSurface(mesh), JetSurface(mesh))]}


def _crossings(mesh: ReferenceMesh, curves: int, theta: float, each: int = 300) -> dict:
    """Edge crossings per second of the loop alone."""
    rng = np.random.default_rng(0)
    faces = rng.integers(0, len(mesh.triangles), curves)
    starts = np.einsum("nk,nki->ni", rng.dirichlet([2, 2, 2], curves), mesh.corners[faces])
    tracer = LiteralTracer(mesh)

    def march() -> int:
        total = 0
        for first in range(0, curves, TOGETHER):
            some = slice(first, first + TOGETHER)
            count = len(starts[some])
            rows, _, _ = tracer.march(starts[some], faces[some], rng.normal(size=(count, 3)), np.full(count, theta),
                                      np.ones(count), np.inf, each)
            total += sum(row.shape[1] for row in rows[1:])
        return total

    total, clocks = spent(march)
    return {"crossings": total, "per_second": total / clocks["cpu"]}


def _smooth(surface, count: int) -> dict:
    starts = np.stack([np.linspace(-1.4, 1.4, count), np.zeros(count), np.zeros(count)], axis=1)
    surface.project(starts)
    found, clocks = spent(lambda: trace(surface, starts, [0, 1, 0], INCLINATION))
    return {"name": type(surface).__name__, "per_second": _points(found) / clocks["cpu"]}


def _points(curves) -> int:
    return sum(len(curve.points) for curve in curves)


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Curves of constant inclination on surfaces, per processor second: from edge to edge of a mesh as in the paper "
           "(the loop alone, and with what makes curves of crossings), and by Runge–Kutta steps on smooth surfaces.", "",
           "| | per second |", "|---|--:|"]
    out += [f"| literal, {row['name']}, {row['faces']:,} faces | {row['per_second'] / 1e6:.2f} million crossings |"
            for row in found["crossings"]]
    out.append(f"| literal, whole curves | {found['curves_per_second'] / 1e6:.2f} million points |")
    return out + [f"| smooth, {row['name']} | {row['per_second'] / 1e3:.0f} thousand points |" for row in found["smooth"]]


if __name__ == "__main__":
    alone(measured)
