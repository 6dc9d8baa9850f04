"""The constructed way (§2.4): an explicit principal structure fitted to the guides, exact whatever the fit."""

from plisse.errors import Infeasible
from plisse.solve.attempt import Attempt, Start
from plisse.solve.principal import fit_principal

__all__ = ["constructed"]


def constructed(start: Start) -> Attempt:
    """The attempt on a start; a march that breaks down is a message, not an exception."""
    try:
        fit = fit_principal(start.guides(start.samples), start.amplitude, closed=start.pattern.closed)
    except Infeasible as error:
        return Attempt("constructed", None, str(error))
    return Attempt("constructed", fit.vertices.reshape(-1, 3), fit.message)
