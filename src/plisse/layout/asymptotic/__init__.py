"""Layouts along asymptotic curves: directions, singularities, curves, faces, and mountains and valleys (§2.6)."""
