"""The command `plisse`: parse, one call, write."""

from plisse.cli.app import main

__all__ = ["main"]
