"""Designs to begin with."""

WAVE = {"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 18, 8], [80, 18, 14], [120, 0, 16]]},
        "pattern": {"theta": 40, "creases": 7, "width": 5, "amplitude": 3, "samples": 61}, "solve": {"principal": True}}
COIL = {"curve": {"kind": "helix", "radius": 20, "pitch": 5, "turns": 2},
        "pattern": {"theta": 85, "creases": 8, "width": 5, "amplitude": 3, "samples": 61}}
SADDLE = {"surface": {"height": "0.0008*x*x - 0.0006*y*y", "x": [-60, 60], "y": [-40, 40]}, "pattern": {"width": 6}}
