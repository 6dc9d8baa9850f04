"""From a parallel section of a design to the last of a family of parallel structures (§2.3, Fig. 7)."""

from dataclasses import replace
from time import perf_counter

import msgspec

from plisse.assess import assess, overlap_notes
from plisse.errors import Infeasible
from plisse.recipe import Parallel
from plisse.result import Interval, Result
from plisse.structure.pleated import PleatedStructure
from plisse.transform.edge_scales import ParallelSpace
from plisse.transform.variation import variations

__all__ = ["scales_between", "varied"]


def varied(result: Result, recipe: Parallel) -> Result:
    """The result of a design carried on to a parallel structure; infeasible, with the reason, where there is none."""
    if result.structure is None:
        return result
    start = perf_counter()
    try:
        family = variations(result.structure, recipe)
    except Infeasible as error:
        return replace(result, report=msgspec.structs.replace(result.report, status="infeasible",
                                                              reasons=[str(error), *result.report.reasons]))
    before, structure = result.report, family[-1].structure
    report = assess(structure, principal=before.principal, units=before.units)
    seconds = {stage: value for stage, value in before.seconds.items() if stage != "total"}
    seconds["parallel"] = perf_counter() - start
    report = msgspec.structs.replace(
        report, seconds={**seconds, "total": sum(seconds.values())}, method=f"{before.method}, then parallel",
        edge_scales=scales_between(family[0].structure, family[1].structure), start=before.start,
        iterations=before.iterations, history=before.history, tried=before.tried, design=before.design,
        warnings=overlap_notes(report))
    return replace(result, report=report, structure=structure, family=family)


def scales_between(before: PleatedStructure, after: PleatedStructure) -> Interval | None:
    """Smallest and largest edge scale, or None where the structures have different faces."""
    if len(before.topology.quads) != len(after.topology.quads):
        return None
    if before.topology.vertex_count != after.topology.vertex_count:
        before = before.opened
    if before.topology.vertex_count != after.topology.vertex_count:
        return None
    scales = ParallelSpace(before).scales(after.vertices)
    return Interval(float(scales.min()), float(scales.max()))
