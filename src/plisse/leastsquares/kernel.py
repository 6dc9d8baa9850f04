"""Energy terms: a formula on local arrays, and where its arguments come from.

Kernels see component-first arrays (dim, N), one column per element; the problem gathers and scatters. A plain kernel
returns one residual per element (N,) and, per argument, its gradient (dim, N). A *componentwise* kernel treats all
coordinates alike: residuals (dim, N) and derivatives by the same coordinate (dim, N).
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

__all__ = ["KERNELS", "Kernel", "Rows", "Term", "kernel"]

KERNELS: dict[str, "Kernel"] = {}


def _no_gradients(*arguments, **data):
    raise NotImplementedError("this kernel has no Jacobian; register one with @kernel.jacobian")


@dataclass(eq=False)
class Kernel:
    """A residual with its exact Jacobian; positional arguments are unknowns, keyword ones frozen data."""

    name: str
    residual: Callable[..., np.ndarray]
    componentwise: bool = False
    gradients: Callable[..., tuple[np.ndarray, ...]] = _no_gradients

    def __call__(self, *arguments, **data):
        return self.residual(*arguments, **data)

    def jacobian(self, function):
        """Decorator that registers the Jacobian of this kernel."""
        self.gradients = function
        return function


def kernel(function=None, *, componentwise: bool = False):
    """Decorator that makes a formula a kernel and lists it in KERNELS."""
    if function is None:
        return lambda inner: kernel(inner, componentwise=componentwise)
    KERNELS[function.__name__] = Kernel(function.__name__, function, componentwise)
    return KERNELS[function.__name__]


@dataclass(frozen=True, eq=False)
class Rows:
    """Rows of a block of unknowns, one per element."""

    block: str
    index: np.ndarray


@dataclass(frozen=True, eq=False)
class Term:
    """Σ weight · residual² over elements; `data` are the kernel's keyword arguments."""

    name: str
    kernel: Kernel
    arguments: tuple[Rows, ...]
    weight: float = 1.0
    data: dict = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of elements."""
        return len(self.arguments[0].index)
