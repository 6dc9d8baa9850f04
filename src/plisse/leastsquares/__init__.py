"""Nonlinear least squares on fixed sparse patterns: terms, assembly without sorting, factorisations, damping."""

from plisse.leastsquares.choice import factoriser
from plisse.leastsquares.factor import Factor, NotPositiveDefinite, damped
from plisse.leastsquares.gram import GramPattern
from plisse.leastsquares.kernel import KERNELS, Kernel, Rows, Term, kernel
from plisse.leastsquares.problem import Blocks, Linearisation, Problem

__all__ = ["KERNELS", "Blocks", "Factor", "GramPattern", "Kernel", "Linearisation", "NotPositiveDefinite", "Problem",
           "Rows", "Term", "damped", "factoriser", "kernel"]
