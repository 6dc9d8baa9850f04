"""Principal pleated structures by explicit construction, fitted to guiding creases (§2.4, §2.5)."""

from plisse.solve.principal.construct import march_closed, march_structure
from plisse.solve.principal.fit import PrincipalFit, fit_candidates, fit_principal
from plisse.solve.principal.judge import Regularity
from plisse.solve.principal.numbers import PrincipalNumbers

__all__ = ["PrincipalFit", "PrincipalNumbers", "Regularity", "fit_candidates", "fit_principal",
           "march_closed", "march_structure"]
