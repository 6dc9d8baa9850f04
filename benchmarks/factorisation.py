"""The library's factorisations of the same matrices, banded, SuperLU and rslab: `python benchmarks/factorisation.py`."""

import numpy as np

from cases import helix, zigzagged
from clocks import alone, spent, turns
from plisse.leastsquares import GramPattern, factoriser
from plisse.leastsquares.banded import Band, Banded
from plisse.leastsquares.sparse import Sparse
from plisse.leastsquares.supernodal import Supernodal
from plots import COLOURS, MARKERS, logarithmic, panels
from systems import System

TITLE = "Factorisations"
GRIDS = ((12, 242), (60, 60), (113, 113), (50, 2000))
QUICK = ((12, 60), (24, 24))
SLOW = 2.0  # seconds from which one run is enough
REPEATS = 4
KINDS = {"dual": "J Jᵀ", "primal": "Jᵀ J"}


def measured(quick: bool = False) -> dict:
    """Milliseconds of one factorisation, for each matrix and solver, and which the library chooses."""
    rows = []
    for creases, samples in QUICK if quick else GRIDS:
        system = System(zigzagged(helix(creases, samples)))
        for kind in KINDS:
            pattern, entries = getattr(system, kind)()
            rows.append({"grid": f"{creases} × {samples}", "matrix": kind, "size": pattern.size, "entries": len(entries),
                         "band": pattern.bandwidth, "chosen": _name(factoriser(pattern)), **_seconds(pattern, entries)})
    return {"rows": rows}


def _seconds(pattern: GramPattern, entries: np.ndarray) -> dict:
    """Processor seconds of every solver, its analysis of the pattern apart, and the worst relative residual."""
    right = np.cos(np.arange(pattern.size))
    factor, analysis, works = {}, {}, {}
    residual = 0.0
    for name, make in _solvers().items():
        try:
            solver, clocks = spent(lambda make=make: make(pattern))
        except ImportError:
            continue
        analysis[name] = clocks["cpu"]
        found, clocks = spent(lambda solver=solver: solver.factor(entries))
        solution = found.solve(right)
        wrong = np.abs(entries_times(pattern, entries, solution) - right).max()
        residual = max(residual, wrong / (np.abs(entries).max() * np.abs(solution).max()))
        factor[name] = clocks["cpu"]
        if clocks["cpu"] < SLOW:
            works[name] = lambda solver=solver: solver.factor(entries)
    factor.update({name: clocks["cpu"] for name, clocks in turns(REPEATS, **works).items()})
    return {"factor": factor, "analysis": analysis, "residual": residual}


def entries_times(pattern: GramPattern, entries: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """The symmetric matrix times a vector."""
    below = pattern.rows != pattern.columns
    return (np.bincount(pattern.rows, entries * vector[pattern.columns], pattern.size)
            + np.bincount(pattern.columns[below], (entries * vector[pattern.rows])[below], pattern.size))


def _solvers() -> dict:
    return {"banded": lambda pattern: Banded(Band(pattern)), "SuperLU": Sparse, "rslab": Supernodal}


def _name(solver) -> str:
    return {Banded: "banded", Sparse: "SuperLU", Supernodal: "rslab"}[type(solver)]


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Milliseconds of one factorisation of the same matrices, one thread, medians of runs that take turns; the "
           "analysis of a pattern is done once and stands in brackets. J Jᵀ (conditions) is what the polish "
           "factorises, Jᵀ J (coordinates) what relaxation does. *Chosen* is what the library takes by itself.", "",
           "| grid | matrix | rows | band | banded | SuperLU | rslab | chosen |", "|---|---|--:|--:|--:|--:|--:|---|"]
    for row in found["rows"]:
        cells = [f"{1000 * row['factor'][name]:.1f} ({1000 * row['analysis'][name]:.0f})" if name in row["factor"] else "–"
                 for name in ("banded", "SuperLU", "rslab")]
        out.append(f"| {row['grid']} | {KINDS[row['matrix']]} | {row['size']:,} | {row['band']} | {' | '.join(cells)} | "
                   f"{row['chosen']} |")
    return out


def draw(found: dict):
    """Milliseconds by matrix."""
    figure, (axes,) = panels(1, height=1.2 + 0.33 * len(found["rows"]))
    at = np.arange(len(found["rows"]))[::-1]
    for name, colour, marker in zip(("banded", "SuperLU", "rslab"), COLOURS, MARKERS, strict=False):
        have = [(1000 * row["factor"][name], place) for row, place in zip(found["rows"], at, strict=True)
                if name in row["factor"]]
        if have:
            axes.plot(*np.transpose(have), marker, color=colour, label=name)
    axes.set_yticks(at, [f"{row['grid']}, {KINDS[row['matrix']]}" for row in found["rows"]])
    logarithmic(axes)
    axes.set_xlabel("milliseconds of one factorisation")
    figure.legend(loc="outside upper center", ncols=3, frameon=False)
    return figure


if __name__ == "__main__":
    alone(measured)
