"""SuperLU in its symmetric mode: for large sheets without a narrow band."""

import numpy as np
from scipy.sparse import csc_array, tril
from scipy.sparse.linalg import splu

from plisse.leastsquares.factor import Assembled, Factor, NotPositiveDefinite
from plisse.leastsquares.gram import GramPattern

__all__ = ["Sparse"]


class Sparse(Assembled):
    """Sparse LU with minimum-degree order and pivots on the diagonal."""

    def __init__(self, pattern: GramPattern):
        self.pattern = pattern
        shape = (pattern.size, pattern.size)
        number = csc_array((np.arange(1.0, len(pattern.rows) + 1), (pattern.rows, pattern.columns)), shape=shape)
        full = csc_array(number + tril(number, -1).T)
        full.sort_indices()
        self._gather = full.data.astype(np.int64) - 1
        self._indices, self._indptr, self._shape = full.indices, full.indptr, shape

    def factor(self, entries: np.ndarray) -> Factor:
        """Sparse LU factor; raises NotPositiveDefinite where a pivot is not positive."""
        matrix = csc_array((entries[self._gather], self._indices, self._indptr), shape=self._shape)
        try:
            factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        except RuntimeError as error:
            raise NotPositiveDefinite(str(error)) from None
        if not (factor.U.diagonal() > 0).all():
            raise NotPositiveDefinite("a pivot is not positive")
        return factor
