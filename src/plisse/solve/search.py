"""The order in which layouts are tried over a whole surface: scanned, refined, and with seams where one piece fails.

Every stage looks at what was found before it; how much is tried does not depend on the clock.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

from plisse.layout.automatic import Layout
from plisse.solve.candidate import PARTED, Candidate
from plisse.solve.masked import Trim
from plisse.solve.seams import even_columns, seam_counts, worst_columns

__all__ = ["Jobs", "best_of", "stages"]

GENTLE = Trim(rounds=10, worst=0.004, hold=0.1)  # where few quads are in the way: with seams, or near the goal
PATCHY = 0.1  # lack from which quads must go faster
HOLDS = (0.03, 0.3, 0.0)
FINALISTS = 3
NOTABLE = 0.1  # coverage for which sheets are cut apart unasked
MOST_SEAMS = 8  # where none are asked for
WORK = 300_000  # quads in all rounds that a search with seams may take, unless the search without took most of it

Jobs = Iterator[tuple[float, Layout, Trim, tuple[int, ...]]]


def stages(first: Jobs, layouts: list[Layout], tried: list[Candidate], seams: int | None) -> Iterator[tuple[str, Jobs]]:
    """What is tried in turn; each stage looks at what was found until then."""
    yield "scan", first
    yield "refine", _second(tried)
    if seams != 0:
        yield "seams", _seamed(layouts, tried, seams)
        yield "refine", _second([candidate for candidate in tried if candidate.seams])


def best_of(tried: list[Candidate], seams: int | None) -> Candidate:
    """The candidate of the highest rank in one piece, or with seams where these cover more: notably more if unasked."""
    uncut, apart = ([candidate for candidate in tried if bool(candidate.seams) == parted] for parted in (False, True))
    if not (uncut and apart):
        return max(tried, key=lambda candidate: candidate.rank)
    whole, parts = (max(some, key=lambda candidate: candidate.rank) for some in (uncut, apart))
    least = NOTABLE if seams is None else PARTED * len(parts.seams)
    return parts if whole.lack - parts.lack >= least else whole


def _seamed(layouts: list[Layout], tried: list[Candidate], most: int | None) -> Jobs:
    """The best layouts with more and more seams, evenly spread and where quads were lost."""
    ranked = sorted(tried, key=lambda candidate: candidate.rank, reverse=True)
    if ranked and ranked[0].lack < (NOTABLE if most is None else PARTED):
        return
    scanned = {id(candidate.layout): candidate for candidate in reversed(tried)}
    finalists = list({id(layout): layout for layout in [c.layout for c in ranked] + layouts}.values())[:FINALISTS + 1]
    spent, counts = _work(tried), seam_counts(MOST_SEAMS if most is None else most)
    for k, (count, layout) in enumerate(product(counts, finalists)):
        mask, closed, first = layout.mask, layout.net.closed, scanned.get(id(layout))
        choices = {even_columns(mask, closed, count)}
        if first is not None:
            choices.add(worst_columns(mask, first.solved.grid.mask, closed, count))
        for columns in sorted(choices - {()}):
            if _work(tried) > max(WORK, 1.5 * spent):
                return
            yield k / len(counts) / len(finalists), layout, GENTLE, columns


def _work(tried: list[Candidate]) -> int:
    """Quads solved for in all rounds."""
    return sum(quads for candidate in tried for quads, _ in candidate.solved.history)


def _second(tried: list[Candidate]) -> Jobs:
    """The best candidates again, held nearer to the reference or left freer; with seams, the best of several layouts."""
    ranked = sorted(tried, key=lambda candidate: candidate.rank, reverse=True)
    apart = {id(candidate.layout): candidate for candidate in reversed(ranked) if candidate.seams}
    finalists = [candidate for candidate in ranked if candidate is apart.get(id(candidate.layout), candidate)]
    finalists = finalists[:max(1, min(FINALISTS, len(finalists) // 2))]
    jobs = [(candidate, hold) for candidate in finalists for hold in HOLDS]
    for k, (candidate, hold) in enumerate(jobs):
        trim = replace(GENTLE if candidate.lack < PATCHY else Trim(), hold=hold)
        yield k / len(jobs), candidate.layout, trim, candidate.seams
