"""`exact` beside the paper's functional (5) on the same linear algebra: `python benchmarks/methods.py`.

The paper's method is stopped nowhere: its vertices and clock are noted at every iteration and measured afterwards. Runs of
`exact` come between; `exact` is charged with its flattening too, because the paper's method finds the development as well.
"""

import time
from statistics import median
from unittest import mock

import numpy as np

from cases import HELIX, helix, shipped
from clocks import alone, staged
from plisse.layout.guiding import guiding
from plisse.leastsquares.levenberg import levenberg_marquardt
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect, sector_angles
from plisse.recipe import Design
from plisse.solve.cutting import best_cut
from plisse.solve.energies import Guides
from plisse.solve.paper import solve_paper
from plisse.solve.zigzag import zigzag
from plots import COLOURS, MARKERS, logarithmic, panels
from systems import one_factorisation

TITLE = "Exact against the paper's method"
LEVELS = (1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-13)
REGULAR = 5.0  # degrees of the smallest sector angle
PRINTED = "as printed"
FREE = "without fairness and closeness"
WEAK = "fairness 1e-6, no closeness"
EVERY = (PRINTED, FREE, WEAK)
BETWEEN = 3  # runs of exact after each of the paper's method


def weights(setting: str, principal: bool) -> list[float]:
    """λ1 … λ5 of a setting."""
    fold = 100.0 * principal
    return {PRINTED: [10, 1, 100, 1, fold], FREE: [10, 0, 100, 0, fold], WEAK: [1, 0, 1, 1e-6, fold / 100]}[setting]


def measured(quick: bool = False) -> dict:
    """Seconds and defects of both methods on open, closed, small and square designs."""
    if quick:
        return {"cases": [_case(HELIX, shipped(HELIX), (PRINTED, FREE), 20)]}
    return {"cases": [_case(HELIX, shipped(HELIX), EVERY, 60), _case("fig01d", shipped("fig01d"), EVERY, 60),
                      _case("helix 60 × 60", helix(60, 60), EVERY, 30), _case("fig19", shipped("fig19"), (PRINTED,), 10)]}


def _case(name: str, design: Design, settings: tuple[str, ...], iterations: int) -> dict:
    result, _ = staged(design)  # imports
    exact, paper = [], []
    for setting in settings:
        paper.append({"setting": setting, "trail": _paper(design, weights(setting, design.solve.principal), iterations)})
        exact += [staged(design)[1] for _ in range(BETWEEN)]
    report = result.report
    ours = {**{clock: median(spans["solve"][clock] + spans["flatten"][clock] for spans in exact)
               for clock in ("cpu", "wall")},
            "planarity": report.planarity.max, "angle": report.angle_defect.max, "sector_deg": report.min_sector_angle_deg,
            "runs": len(exact), "limit": one_factorisation(result.structure, design.solve.principal)}
    return {"name": name, "vertices": report.vertices, "principal": design.solve.principal, "iterations": iterations,
            "exact": ours, "paper": paper, "ratios": _ratios(ours, paper), "best": _best(ours, paper)}


def _paper(design: Design, lambdas: list[float], iterations: int) -> list[dict]:
    """Processor seconds and defects at every iteration of the paper's method, from the zigzag on."""
    guide = guiding(design.curve, design.pattern)
    pattern = guide.pattern.resampled(guide.samples)
    first = zigzag(pattern, guide.amplitude)
    topology, cut = first.topology, best_cut(first, design.solve.cut)
    seen: list[tuple[float, np.ndarray]] = []

    def noted(problem, start, *, renew=None, **options):
        if renew is None:  # the first stage, which only unfolds
            return levenberg_marquardt(problem, start, **options)

        def renewed(blocks):
            seen.append((time.process_time() - begun, blocks["vertices"].T))
            return renew(blocks)

        found = levenberg_marquardt(problem, start, renew=renewed, **options)
        seen.append((time.process_time() - begun, found.blocks["vertices"].T))
        return found

    with mock.patch("plisse.solve.paper.levenberg_marquardt", noted):
        begun = time.process_time()
        solve_paper(topology, first.vertices,
                    Guides.along_creases(topology, first.vertices, pattern.binormals.reshape(-1, 3)), weights=lambdas,
                    iterations=iterations, cut=cut, principal=design.solve.principal)
    return [{"iteration": number, "cpu": seconds, "planarity": planarity_defect(topology, vertices).max(),
             "angle": np.abs(angle_defect(topology, vertices)).max(),
             "sector_deg": np.degrees(sector_angles(topology, vertices).min())}
            for number, (seconds, vertices) in enumerate(seen)]


def _ratios(exact: dict, paper: list[dict]) -> list[dict]:
    """For every level of both defects: the first regular iteration of the paper's method that reaches it, over `exact`."""
    out = []
    for level in LEVELS:
        reaching = [(point["cpu"], point["iteration"], run["setting"]) for run in paper for point in run["trail"]
                    if max(point["planarity"], point["angle"]) <= level and point["sector_deg"] >= REGULAR]
        if reaching:
            cpu, iteration, setting = min(reaching)
            out.append({"level": level, "setting": setting, "iteration": iteration, "cpu": cpu, "ratio": cpu / exact["cpu"]})
    return out


def _best(exact: dict, paper: list[dict]) -> list[dict]:
    """For every setting: the least defect of a regular iteration, when it came, and that over `exact`."""
    out = []
    for run in paper:
        defect, cpu, iteration = min((max(point["planarity"], point["angle"]), point["cpu"], point["iteration"])
                                     for point in run["trail"] if point["sector_deg"] >= REGULAR)
        out.append({"setting": run["setting"], "defect": defect, "iteration": iteration, "cpu": cpu,
                    "ratio": cpu / exact["cpu"]})
    return out


def headline(found: dict) -> str:
    """One sentence."""
    parts = []
    for level in (1e-4, 1e-9):
        ratios = [row["ratio"] for case in found["cases"] for row in case["ratios"] if row["level"] == level]
        if ratios:
            bounds = dict.fromkeys(f"{bound:.0f}" for bound in (min(ratios), max(ratios)))
            parts.append(f"{' to '.join(bounds)} times as long to planarity and angles of {level:.0e} "
                         f"({len(ratios)} of {len(found['cases'])} designs get there)")
    return ("The paper's functional on the same linear algebra, each time in its fastest setting, takes "
            f"{' and '.join(parts)} as `exact` takes to 1e-13.") if parts else ""


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["`method = \"paper\"` is functional (5) with 5V + 3F unknowns, Levenberg–Marquardt on the same assembly and "
           "factorisations. Settings: the weights of Fig. 21 (λ = 10, 1, 100, 1, and 100 for principal designs); the same "
           "without fairness and closeness, which lets it converge; λ = 1, 0, 1, 1e-6. Lines give the first iteration of "
           "any setting that reaches both defects with sector angles of at least 5°, then the best iteration of each "
           "setting; `exact` is always charged with its whole way to round-off, patterns and flattening included. Processor "
           "seconds. The paper's energy of constant folds does not make principal designs exactly principal, `exact` does; "
           "that is not compared."]
    for case in found["cases"]:
        exact = case["exact"]
        out += ["", f"**{case['name']}**, {case['vertices']} vertices, {'principal' if case['principal'] else 'general'}: "
                f"`exact` takes {exact['cpu']:.3f} s to planarity {exact['planarity']:.0e} and angles {exact['angle']:.0e}; "
                f"one factorisation takes {exact['limit']:.4f} s.", "",
                "| both defects at most | setting | iteration | s | / exact |", "|--:|---|--:|--:|--:|"]
        out += [f"| {row['level']:.0e} | fastest: {row['setting']} | {row['iteration']} | {row['cpu']:.2f} | "
                f"{row['ratio']:.0f} |" for row in case["ratios"]]
        out += [f"| {row['defect']:.0e} | best of {case['iterations']}: {row['setting']} | {row['iteration']} | "
                f"{row['cpu']:.2f} | {row['ratio']:.0f} |" for row in case["best"]]
    return out


def draw(found: dict):
    """Defect over seconds, one panel per design."""
    figure, axes = panels(len(found["cases"]))
    for panel, case in zip(axes, found["cases"], strict=True):
        for number, run in enumerate(case["paper"], start=1):
            trail = run["trail"]
            panel.plot([point["cpu"] for point in trail], [max(point["planarity"], point["angle"]) for point in trail],
                       MARKERS[number] + "-", color=COLOURS[number], label=f"paper, {run['setting']}", markersize=3,
                       linewidth=1)
        exact = case["exact"]
        panel.plot(exact["cpu"], max(exact["planarity"], exact["angle"]), MARKERS[0], color=COLOURS[0], markersize=8,
                   label="exact")
        panel.axvline(exact["limit"], color=COLOURS[6], linestyle=":", label="one factorisation")
        logarithmic(panel, "xy")
        panel.set(xlabel="processor seconds", ylim=(1e-14, 10), title=f"{case['name']}, {case['vertices']} vertices")
        panel.set_yticks(10.0 ** np.arange(-14, 2, 3))
    figure.supylabel("larger of planarity and angle defect")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    return figure


if __name__ == "__main__":
    alone(measured)
