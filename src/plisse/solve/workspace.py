"""Topologies and sparsity patterns, built once and shared by all designs of the same size."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import TypeVar

from plisse.solve.constraints import Constraints
from plisse.structure.grid import grid
from plisse.structure.topology import Topology

__all__ = ["Workspace"]

T = TypeVar("T")
ROOM = 24


class Workspace:
    """What depends on connectivity alone; the entries used least recently go first.

    A design makes one for itself; a session keeps one, so that its next answer needs no new patterns. Not for use from
    several threads at once.
    """

    def __init__(self):
        self._held: OrderedDict[Hashable, object] = OrderedDict()

    def held(self, key: Hashable, make: Callable[[], T]) -> T:
        """The object made for this key before, or made now."""
        if key in self._held:
            self._held.move_to_end(key)
        else:
            self._held[key] = make()
            if len(self._held) > ROOM:
                self._held.popitem(last=False)
        return self._held[key]  # type: ignore[return-value]

    def grid(self, creases: int, samples: int, closed_creases: bool, closed_family: bool) -> Topology:
        """A grid, the same object every time."""
        key = ("grid", creases, samples, closed_creases, closed_family)
        return self.held(key, lambda: grid(creases, samples, closed_creases=closed_creases, closed_family=closed_family))

    def constraints(self, topology: Topology, principal: bool) -> Constraints:
        """The exact conditions on a topology with their patterns."""
        return self.held(("constraints", topology, principal), lambda: Constraints(topology, principal))
