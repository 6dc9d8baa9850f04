"""Guiding curves: where creases should run (§3.1, §3.2)."""
