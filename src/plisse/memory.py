"""The memory that a design will need, foretold from its size, and whether there is as much."""

import os
from pathlib import Path

from plisse.errors import TooLarge

__all__ = ["CHOSEN", "LARGEST_FACTOR", "available_bytes", "peak_bytes", "refuse_too_large"]

CHOSEN = "PLISSE_MEMORY"  # a limit in GB
PROGRAM = 110e6  # libraries and code
PER_VERTEX = 3200.0  # positions, topology, sparsity patterns, Jacobians
LARGEST_FACTOR = 1.2e9  # bytes; wider bands are factorised sparsely
GB = 1e9


def peak_bytes(vertices: float, across: float, *, principal: bool = False, closed: bool = False) -> float:
    """Peak memory of a design, `across` vertices wide where it is narrowest; measured within a factor of two.

    Planarity and angle sums are two rows per vertex with a band of four times the width; principal structures have three
    rows and six times the width. Closed creases are folded once, which doubles the width.
    """
    rows, band = (3, 6) if principal else (2, 4)
    factor = 8.0 * rows * vertices * band * across * (2 if closed else 1)
    return PROGRAM + PER_VERTEX * vertices + min(factor, LARGEST_FACTOR)


def available_bytes() -> float | None:
    """Memory that is free on this machine, at most the limit that was chosen; None where neither is known."""
    known = [value for value in (_chosen(), _free()) if value is not None]
    return min(known, default=None)


def refuse_too_large(peak: float, what: str, remedy: str) -> None:
    """Raise TooLarge where a design would need more memory than there is; `remedy` says what to change."""
    available = available_bytes()
    if available is not None and peak > available:
        there = "the limit is" if _chosen() == available else "this machine has free only"
        raise TooLarge(f"{what} need about {peak / GB:.2g} GB of memory, but {there} {available / GB:.2g} GB; {remedy}")


def _chosen() -> float | None:
    text = os.environ.get(CHOSEN)
    return None if text is None else float(text) * GB


def _free() -> float | None:
    """Memory that programs can still get, in bytes; None where the system does not say without further libraries."""
    try:
        lines = Path("/proc/meminfo").read_text().splitlines()
    except OSError:
        names = getattr(os, "sysconf_names", {})
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")) if "SC_PHYS_PAGES" in names else None
    fields = dict(line.split(":", 1) for line in lines if ":" in line)
    return 1024.0 * float(fields["MemAvailable"].split()[0]) if "MemAvailable" in fields else None
