"""Curve-pleated structures."""
