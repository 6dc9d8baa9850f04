"""A family of parallel structures side by side (Fig. 7)."""

from collections.abc import Sequence
from pathlib import Path

from plisse.draw.camera import best_view
from plisse.draw.row import write_row
from plisse.transform.variation import Member

__all__ = ["write_family"]

MOST = 5


def write_family(family: Sequence[Member], path: str | Path, *, title: str = "") -> None:
    """Write a PNG of a family, at one scale and from the side that shows its last member best.

    Handles are dots with arrows to where they shall go, on the structure that they pull.
    """
    shown = [*family[:MOST - 1], family[-1]] if len(family) > MOST else list(family)
    topology = family[-1].structure.topology
    write_row([member.structure for member in shown], [member.caption for member in shown], path,
              camera=best_view(family[-1].structure), title=title, arrows={
                  k: after.pulls for k, after in enumerate(shown[1:]) if after.pulls is not None},
              facts=["edges are parallel", f"{len(topology.creases)} creases", f"{topology.vertex_count:,} vertices"])
