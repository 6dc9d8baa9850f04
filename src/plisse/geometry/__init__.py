"""Curves, frames and vectors; nothing here knows about folding."""
