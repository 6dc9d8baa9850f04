"""`exact` beside `scipy.optimize.least_squares` on the same conditions and start: `python benchmarks/scipy_solver.py`.

SciPy gets the exact conditions as residuals with their analytic sparse Jacobian on a kept pattern, built before its clock
starts, and the zigzag; its clock stops as soon as the largest residual is below 1e-12. Tolerances are at round-off, so
that nothing else stops it.
"""

import time
from contextlib import suppress

import numpy as np
from scipy.optimize import least_squares

from cases import HELIX, helix, shipped
from clocks import alone, spent, staged
from plisse.measure.sectors import sector_angles
from plisse.recipe import Design
from plisse.solve.constraints import Constraints
from plisse.solve.polish import polish
from plisse.structure.pleated import PleatedStructure
from plots import COLOURS, MARKERS, logarithmic, panels
from systems import System, one_factorisation

TITLE = "Exact against SciPy's least_squares"
TARGET = 1e-12
PATIENCE = 15.0  # processor seconds
BESIDE = 5  # solves beside each run of SciPy, of which the median counts: the smallest take milliseconds
NEAR = 1e-3  # how far vertices are moved from an exact structure, in edges
TIGHT = {"atol": 1e-10, "btol": 1e-10, "maxiter": 5000, "regularize": False}
SETTINGS = {"lsmr": {"tr_solver": "lsmr"},
            "lsmr to 1e-10": {"tr_solver": "lsmr", "tr_options": TIGHT},
            "lsmr to 1e-10, x_scale jac": {"tr_solver": "lsmr", "tr_options": TIGHT, "x_scale": "jac"}}
DENSE = "dense SVD"


class Stopped(Exception):
    """Ends SciPy's iteration where it has reached the target or run out of time."""


def measured(quick: bool = False) -> dict:
    """Seconds of both from the zigzag, and from vertices near an exact structure."""
    small = helix(6, 24 if quick else 40)
    cases = [_case("helix 6 × 24" if quick else "helix 6 × 40", small, {**SETTINGS, DENSE: {"tr_solver": "exact"}})]
    if not quick:
        cases += [_case(HELIX, shipped(HELIX), SETTINGS), _case("fig01d", shipped("fig01d"), SETTINGS)]
    return {"target": TARGET, "patience": PATIENCE, "cases": cases}


def _case(name: str, design: Design, settings: dict) -> dict:
    staged(design)  # imports
    runs, exact = [], []
    for setting, options in settings.items():
        few = [staged(design) for _ in range(BESIDE)]
        result = few[0][0]
        exact += [(result, spans["solve"]) for result, spans in few]
        system = System(result.zigzagged, design.solve.principal)
        runs.append({"setting": setting, **_scipy(system, result.structure.topology, options)})
    result, clocks = sorted(exact, key=lambda run: run[1]["cpu"])[len(exact) // 2]
    solved = System(result.structure, design.solve.principal)
    return {"name": name, "vertices": result.report.vertices, "unknowns": solved.unknowns, "conditions": solved.conditions,
            "exact": {**clocks, "residual": np.abs(solved.residual(solved.start)).max(),
                      "sector_deg": result.report.min_sector_angle_deg},
            "limit": one_factorisation(result.structure, design.solve.principal), "scipy": runs, **_compared(runs, clocks),
            "near": _near(result.structure, design.solve.principal)}


def _scipy(system: System, topology, options: dict) -> dict:
    """One run, with the largest residual after every evaluation."""
    _ = system.jacobian(system.start)  # its pattern
    trail: list[tuple[float, float]] = []
    last = [system.start]
    dense = options["tr_solver"] == "exact"
    begun = time.process_time()

    def residual(x):
        value = system.residual(x)
        trail.append((time.process_time() - begun, float(np.abs(value).max())))
        last[0] = x
        if trail[-1][1] < TARGET or trail[-1][0] > PATIENCE:
            raise Stopped
        return value

    def jacobian(x):
        return system.jacobian(x).toarray() if dense else system.jacobian(x)

    def run():
        with suppress(Stopped):
            least_squares(residual, system.start, jacobian, ftol=1e-15, xtol=1e-15, gtol=1e-15, max_nfev=1000, **options)

    clocks = spent(run)[1]
    return {**clocks, "reached": trail[-1][1] < TARGET, "residual": trail[-1][1], "evaluations": len(trail),
            "sector_deg": np.degrees(sector_angles(topology, system.vertices(last[0])).min()),
            "trail": [[seconds, worst] for seconds, worst in trail[:: max(1, len(trail) // 60)]]}


def _compared(runs: list[dict], exact: dict) -> dict:
    """SciPy's fastest run over `exact`; where none has arrived, what all had is a lower bound."""
    arrived = [run["cpu"] for run in runs if run["reached"]]
    return {"ratio": (min(arrived) if arrived else max(run["cpu"] for run in runs)) / exact["cpu"], "arrived": bool(arrived)}


def _near(structure: PleatedStructure, principal: bool) -> dict:
    """Both from an exact structure whose vertices were moved at random: linear algebra alone."""
    system = System(structure, principal)
    moved = system.start + NEAR * np.random.default_rng(0).normal(size=len(system.start))
    vertices = np.ascontiguousarray((system.vertices(moved) / structure.mean_edge).T)
    found, exact = spent(lambda: polish(Constraints(structure.topology, principal), vertices))
    system.start = moved
    runs = [_scipy(system, structure.topology, options) for options in SETTINGS.values()]
    return {"exact": {**exact, "residual": found.defect}, **_compared(runs, exact)}


def headline(found: dict) -> str:
    """One sentence."""
    return ("SciPy's sparse `least_squares` on the same conditions from the same start takes "
            + ", ".join(f"{_ratio(case)} times as long on {case['name']}" for case in found["cases"]) + ".")


def _ratio(case: dict) -> str:
    return ("" if case["arrived"] else "more than ") + f"{case['ratio']:.0f}"


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["The conditions (planarity, angle sums, flat-foldability where principal) as residuals of the 3V coordinates, "
           "with their analytic sparse Jacobian, from the zigzag. `method=\"trf\"`, tolerances at round-off; SciPy's clock "
           f"stops when the largest residual falls below {found['target']:.0e}, at the latest after {found['patience']:.0f} "
           "s; its sparsity pattern is built before. `exact` is charged with its whole solve, patterns included; the median "
           "of several beside each run counts. *Near* starts from an exact structure whose vertices were moved by a "
           "thousandth of an edge: one polish against SciPy. The dense trust region (`tr_solver=\"exact\"`) is for "
           "small designs only.", "",
           "| design | conditions × unknowns | solver | s | largest residual | evaluations | sector | / exact |",
           "|---|---|---|--:|--:|--:|--:|--:|"]
    for case in found["cases"]:
        exact = case["exact"]
        out.append(f"| {case['name']} | {case['conditions']} × {case['unknowns']} | **exact** (one factorisation "
                   f"{case['limit']:.4f} s) | {exact['cpu']:.3f} | {exact['residual']:.0e} | | "
                   f"{exact['sector_deg']:.0f}° | 1 |")
        out += [f"| | | {run['setting']} | {run['cpu']:.2f} | {run['residual']:.0e} | {run['evaluations']} | "
                f"{run['sector_deg']:.0f}° | {'' if run['reached'] else '> '}{run['cpu'] / exact['cpu']:.0f} |"
                for run in case["scipy"]]
        near = case["near"]
        out.append(f"| | | near: polish, and SciPy's fastest | {near['exact']['cpu']:.3f} | {near['exact']['residual']:.0e} "
                   f"| | | {_ratio(near)} |")
    return out


def draw(found: dict):
    """Largest residual over seconds."""
    figure, axes = panels(len(found["cases"]))
    for panel, case in zip(axes, found["cases"], strict=True):
        for run, colour, marker in zip(case["scipy"], COLOURS[1:], MARKERS[1:], strict=False):
            seconds, worst = np.transpose(run["trail"][1:])
            panel.plot(seconds, np.minimum.accumulate(worst), marker + "-", color=colour, markersize=3, linewidth=1,
                       label=run["setting"])
        exact = case["exact"]
        panel.plot(exact["cpu"], exact["residual"], MARKERS[0], color=COLOURS[0], markersize=8, label="exact")
        panel.axvline(case["limit"], color=COLOURS[6], linestyle=":", label="one factorisation")
        logarithmic(panel, "xy")
        panel.set(xlabel="processor seconds", ylim=(1e-15, 1), title=f"{case['name']}, {case['vertices']} vertices")
    axes[0].set_ylabel("largest residual so far")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    return figure


if __name__ == "__main__":
    alone(measured)
