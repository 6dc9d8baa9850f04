"""What became of one design of a study."""

import msgspec

__all__ = ["DIED", "OUTCOMES", "Outcome"]

OUTCOMES = ("exact", "approximate", "infeasible", "invalid", "timeout", "memory", "failed")
DIED = "died"  # its process was killed from outside: not an outcome yet, but worth another attempt


class Outcome(msgspec.Struct, frozen=True, kw_only=True):
    """Status (one of OUTCOMES, or DIED), reasons, numbers, seconds, peak memory in MB, the worker's name, a small PNG."""

    status: str
    reasons: list[str]
    numbers: dict = {}
    seconds: float = 0.0
    memory_mb: float = 0.0
    worker: str = ""
    picture: bytes | None = None
