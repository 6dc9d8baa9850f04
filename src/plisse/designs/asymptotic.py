"""From a surface of negative curvature to upright pleats along its asymptotic curves (§2.6, Figs 18 and 22)."""

from dataclasses import replace

import msgspec
import numpy as np

from plisse.assess import assess, overlap_notes, spread
from plisse.designs.asymptotic_surface import charted_surface
from plisse.designs.outcomes import broken_down
from plisse.designs.reconstruction import deviation_of
from plisse.errors import Infeasible
from plisse.geometry.chart import Chart
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.asymptotic.feasibility import (
    refuse_crowded_hubs,
    refuse_domes,
    refuse_few_columns,
    refuse_positive_curvature,
    refuse_twist,
    refuse_uneven_charts,
    refuse_unlike_amplitude,
    share_without_curves,
)
from plisse.layout.asymptotic.pattern import AsymptoticLayout, lay_out
from plisse.layout.asymptotic.sizing import Sizes
from plisse.layout.stops import Stop
from plisse.measure.mid_surface import mid_surface_deviation
from plisse.recipe import AsymptoticDesign
from plisse.result import Report, Result
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.solve.raising import Raised, finer, raised
from plisse.solve.workspace import Workspace
from plisse.stopwatch import Stopwatch
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["along_asymptotic_curves"]

LEG_TWIST = 8.0, 4.0  # τ/κ beside the legs of singularities, and where that fails
COARSE = 12  # columns along a leg with which a structure is sought
LITTLE = 0.3  # of the surface, under a structure
ENDS = {Stop.BOUNDARY: "at the boundary", Stop.PARABOLIC: "at a parabolic curve", Stop.LENGTH: "at their greatest length"}
TALLEST = 10.0  # amplitudes: pleats over higher surfaces seldom become exact


def along_asymptotic_curves(recipe: AsymptoticDesign, watch: Stopwatch, workspace: Workspace) -> Result:
    """The structure that a recipe asks for, or the reasons why there is none."""
    pattern = recipe.pattern
    rounds = max(0, int(np.ceil(np.log2(pattern.columns / COARSE))))
    sizes = Sizes(pattern.creases, round(pattern.columns / 2**rounds), pattern.width, pattern.reach, pattern.hub_size)
    watch.start("surface", 0.0)
    try:
        chart, mesh, surface = charted_surface(recipe.surface)
        watch.start("layout", 0.05)
        whole = _laid_out(chart, recipe, sizes)
        amplitude = 0.5 * whole.width if pattern.amplitude is None else pattern.amplitude
        refuse_unlike_amplitude(whole, amplitude)
        layout = _cut(whole, LEG_TWIST[0])
        refuse_twist(layout, amplitude)
        watch.start("solve", 0.3)
        found, tried = _solved(whole, layout, amplitude, workspace)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    cut = len(whole.net.columns) - len(found.layout.net.columns)
    found, done = _refined(found, rounds, workspace, watch) if found.is_sound else (found, 0)
    watch.start("flatten", 0.7)
    structure = PleatedStructure(found.zigzag.topology, found.solved.vertices)
    structure = flatten(structure, best_cut(structure), workspace)
    watch.start("measure", 0.85)
    report = assess(structure, units=recipe.units)
    reasons = [*report.reasons, *_unfinished(found, amplitude)]
    notes = [f"{cut} of {len(whole.net.columns)} columns were left out, where creases beside the legs hardly bend"] if cut \
        else []
    notes += [f"the columns were doubled {done} of {rounds} times: with more the structure is not regular any more"] \
        if found.is_sound and done < rounds else []
    report = msgspec.structs.replace(
        report, status=report.status if reasons == report.reasons else "approximate", reasons=reasons, method=found.way.name,
        iterations=found.solved.iterations, tried=tried, crease_deviation=_astray(found, amplitude), seconds=watch.stop(),
        design=recipe.to_dict(), warnings=[*_about(found), *notes, *_ends(found), *_left_out(chart), *overlap_notes(report)])
    return Result(recipe, _over(report, found, structure, mesh, surface, amplitude), structure=structure)


def _laid_out(chart: Chart, recipe: AsymptoticDesign, sizes: Sizes) -> AsymptoticLayout:
    """The layout before its legs are cut; without its polygons where they are left out."""
    refuse_uneven_charts(chart)
    refuse_positive_curvature(chart)
    layout = lay_out(chart, recipe.surface.family, sizes)
    refuse_crowded_hubs(layout)
    refuse_domes(layout)
    return replace(layout, hubs_cut=recipe.surface.hub == "cut")


def _cut(whole: AsymptoticLayout, most_twist: float) -> AsymptoticLayout:
    """The layout with its legs cut; raises Infeasible where nothing that folds is left."""
    layout = whole.cut_along_legs(most_twist)
    refuse_few_columns(layout, len(whole.net.columns))
    return layout


def _solved(whole: AsymptoticLayout, layout: AsymptoticLayout, amplitude: float,
            workspace: Workspace) -> tuple[Raised, list[str]]:
    """The best structure over a layout, or over one that is cut further along its legs, and an account of the others."""
    found, tried = raised(layout, amplitude, workspace)
    if found.is_sound:
        return found, tried
    try:
        shorter = _cut(whole, LEG_TWIST[1])
    except Infeasible:
        return found, tried
    if len(shorter.net.columns) == len(layout.net.columns):
        return found, tried
    again, more = raised(shorter, amplitude, workspace)
    best, other = (again, found) if again.rank > found.rank else (found, again)
    return best, [*tried, *more, other.account]


def _refined(found: Raised, rounds: int, workspace: Workspace, watch: Stopwatch) -> tuple[Raised, int]:
    """The structure with twice as many columns, `rounds` times or as often as it stays sound, and how often it did."""
    for done in range(rounds):
        watch.start("layout", 0.35 + 0.3 * done / rounds)
        try:
            layout = found.layout.refined()
            watch.start("solve", 0.37 + 0.3 * done / rounds)
            after = finer(found, layout, workspace)
        except Infeasible:
            after = None
        if after is None:
            return found, done
        found = after
    return found, rounds


def _unfinished(found: Raised, amplitude: float) -> list[str]:
    """Why a result is not what was asked for, beyond what is measured on it."""
    out = []
    if found.height < 1:
        tall = float(np.ptp(found.layout.points @ unit(found.layout.normals.mean(axis=0)[None])[0])) / amplitude
        out.append(f"the surface could be raised to {100 * found.height:.0f} % of its height only, which is {tall:.1f} "
                   f"amplitudes (few patterns become exact above {TALLEST:g}); flatten it, or take a smaller part or a "
                   "larger amplitude")
    wrong = found.zigzag.against_labels(found.solved.vertices).sum() if found.is_exact else 0
    if wrong:
        out.append(f"{wrong} crease edges fold the other way than mountains and valleys were assigned; a larger amplitude "
                   "or fewer creases help")
    return out


def _astray(found: Raised, amplitude: float):
    """Distance of creases from those of the zigzag, sliding along them left out, in amplitudes."""
    zigzag = found.zigzag
    moved = found.solved.vertices - zigzag.vertices
    along = np.zeros_like(moved)
    for crease in zigzag.topology.creases:
        along[crease.vertices] = np.gradient(zigzag.vertices[crease.vertices], axis=0)
    along = unit(along)
    return spread(norm(moved - dot(moved, along)[:, None] * along) / amplitude)


def _about(found: Raised) -> list[str]:
    """The singularities of a pattern, for its report."""
    layout = found.layout
    points = layout.chart.positions(np.array([hub.place for hub in layout.hubs], complex))
    points[np.abs(points) < 1e-6 * layout.width] = 0.0
    notes = [f"a singularity of index {hub.index:g} at ({', '.join(f'{x:.4g}' for x in point)}), {hub.sectors} sectors"
             + f", for {len(hub.others)} of them that are too close to be told apart" * bool(hub.others)
             for hub, point in zip(layout.hubs, points, strict=True)]
    if (without := len(layout.hubs) - layout.closed_hubs):
        notes.append(f"{without} of these, too near to the boundary for creases in all sectors, without a polygon")
    return notes


def _ends(found: Raised) -> list[str]:
    """Why the creases of a pattern end, where not all of them reach the boundary of the surface."""
    net = found.layout.net
    used = [net.creases[number] for number in np.unique(net.crease)]
    stops = [stop for leaf in used for stop in (leaf.first_stop, leaf.stop)]
    counts = [f"{stops.count(stop)} {where}" for stop, where in ENDS.items() if stop in stops]
    return [] if set(stops) == {Stop.BOUNDARY} else [f"creases end: {', '.join(counts)}"]


def _left_out(chart: Chart) -> list[str]:
    """Which share of a surface has no asymptotic curves."""
    share = share_without_curves(chart)
    return [f"{100 * share:.0f} % of the surface are curved like a dome and left out, for asymptotic curves exist only "
            "where curvature is negative"] if share > 0.01 else []


def _over(report: Report, found: Raised, structure: PleatedStructure, mesh: ReferenceMesh, surface: Surface,
          amplitude: float) -> Report:
    """The report with coverage and deviation."""
    under = ReferenceMesh(found.layout.points, triangulated(structure.topology)[0])
    deviation = mid_surface_deviation(surface, structure.vertices, structure.topology.quads)
    coverage = under.area / mesh.area
    few = [f"only {100 * coverage:.2g} % of the surface lie under the structure: a larger pattern.width or more creases "
           "cover more" + ", and so does a surface with its singularities nearer to the middle" * bool(found.layout.hubs)] \
        if coverage < LITTLE else []
    return msgspec.structs.replace(report, coverage=coverage, warnings=[*report.warnings, *few],
                                   deviation=deviation_of(deviation, mesh.diagonal, amplitude))
