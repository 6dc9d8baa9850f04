"""Clocks: processor and wall seconds of calls, of runs that take turns, of stages of a design, and of new processes."""

import json
import subprocess
import sys
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from statistics import median
from typing import Any

import plisse
from plisse.recipe import Recipe
from plisse.result import Result

__all__ = ["alone", "fresh", "rounded", "spent", "staged", "turns"]

HERE = Path(__file__).parent


def spent(work: Callable[[], Any]) -> tuple[Any, dict]:
    """What a call returns, and its seconds `cpu` and `wall`."""
    cpu, wall = time.process_time(), time.perf_counter()
    found = work()
    return found, {"cpu": time.process_time() - cpu, "wall": time.perf_counter() - wall}


def turns(repeats: int, **works: Callable[[], Any]) -> dict[str, dict]:
    """Median seconds `cpu` and `wall` of calls that take turns, `repeats` times each, after one turn that does not count."""
    seen: dict[str, list[dict]] = {name: [] for name in works}
    for turn in range(repeats + 1):
        for name, work in works.items():
            seconds = spent(work)[1]
            if turn:
                seen[name].append(seconds)
    return {name: {clock: median(run[clock] for run in runs) for clock in ("cpu", "wall")} for name, runs in seen.items()}


def staged(recipe: Recipe) -> tuple[Result, dict[str, dict]]:
    """The result of a design, and seconds `cpu` and `wall` of each of its stages."""
    seen: list[tuple[str, float, float]] = []
    result = plisse.design(
        recipe, progress=lambda stage, _: seen.append((stage, time.process_time(), time.perf_counter())))
    spans: dict[str, dict] = {}
    for (stage, cpu, wall), (_, cpu_after, wall_after) in pairwise(seen):
        before = spans.get(stage, {"cpu": 0.0, "wall": 0.0})
        spans[stage] = {"cpu": before["cpu"] + cpu_after - cpu, "wall": before["wall"] + wall_after - wall}
    return result, spans


def fresh(*command: str, directory: Path | None = None) -> dict:
    """Seconds `cpu` and `wall`, `peak_mb` of memory and exit `code` of a command in a process of its own."""
    done = subprocess.run([sys.executable, str(HERE / "process.py"), *command], cwd=directory, check=True,
                          stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def rounded(value: Any) -> Any:
    """The same data with four significant digits, as numbers that JSON knows."""
    if isinstance(value, dict):
        return {str(key): rounded(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [rounded(item) for item in value]
    if isinstance(value, bool | str | int) or value is None:
        return value
    return float(f"{float(value):.4g}")


def alone(measured: Callable[..., dict]) -> None:
    """Measure a subject by itself and print what was found as JSON; `--quick` takes small cases only."""
    print(json.dumps(rounded(measured(quick="--quick" in sys.argv)), indent=1))
