"""Sparse symmetric systems: fixed patterns, assembly without sorting, banded and sparse factorisations."""

from plisse.solve.linear.factor import Factor, NotPositiveDefinite, factoriser
from plisse.solve.linear.gram import GramPattern

__all__ = ["Factor", "GramPattern", "NotPositiveDefinite", "factoriser"]
