"""Which factorisation is fastest for a pattern, judged by the work in its narrowest band."""

from plisse.leastsquares.banded import Band, Banded
from plisse.leastsquares.factor import Factoriser
from plisse.leastsquares.gram import GramPattern
from plisse.leastsquares.sparse import Sparse
from plisse.leastsquares.supernodal import Supernodal
from plisse.memory import LARGEST_FACTOR

__all__ = ["factoriser"]

# banded operations per entry of the matrix, as measured on grids of 60² to 316² vertices and on singular patterns
REORDERED = 1e4  # from here on a search for a narrower band costs little beside one factorisation
SUPERNODAL = 1.5e4  # rslab is faster, its analysis included
SPARSE = 5e4  # SuperLU is faster


def factoriser(pattern: GramPattern) -> Factoriser:
    """The fastest factorisation for a pattern: banded up to a certain width, then rslab's if installed, else SuperLU."""
    band = Band(pattern)
    if band.bandwidth**2 < REORDERED:  # there is an entry in every row at least
        return Banded(band)
    if band.operations > REORDERED:
        band = min(band, Band.narrow(pattern), key=lambda candidate: candidate.bandwidth)
    if band.operations > SUPERNODAL:
        try:
            return Supernodal(pattern)
        except ImportError:
            pass
    return Banded(band) if band.operations < SPARSE and band.bytes < LARGEST_FACTOR else Sparse(pattern)
