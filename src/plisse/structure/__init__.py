"""Faces with labelled edges, guiding curves, folded surfaces with their development, and ground truth."""
