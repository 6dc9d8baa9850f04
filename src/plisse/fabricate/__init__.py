"""Structures as things to make: pieces of the development on sheets of material."""

from plisse.fabricate.plan import Sheets, sheets

__all__ = ["Sheets", "sheets"]
