"""The constructed way (§2.4): an explicit principal structure fitted to the guides, exact whatever the fit."""

from itertools import islice

from plisse.errors import Infeasible
from plisse.solve.attempt import Attempt, Start
from plisse.solve.principal import PrincipalFit, fit_candidates

__all__ = ["constructed"]

FEWEST_SAMPLES = 12
FITS = 2  # later candidates take long and have hardly ever been better


def constructed(start: Start) -> Attempt:
    """The attempt on a start; a march that breaks down is a message, not an exception."""
    if start.samples < FEWEST_SAMPLES:
        return Attempt("constructed", None, f"{start.samples} samples are too few for an explicit fit")
    best: PrincipalFit | None = None
    try:
        guides = start.guides(start.samples)
        for fit in islice(fit_candidates(guides, start.amplitude, closed=start.pattern.closed), FITS):
            best = fit if best is None or fit.badness < best.badness else best
            if best.is_good:
                break
    except Infeasible as error:
        if best is None:
            return Attempt("constructed", None, str(error))
    assert best is not None
    return Attempt("constructed", best.vertices.reshape(-1, 3), best.message)
