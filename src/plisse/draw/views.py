"""Named views and angles: where a picture is taken from."""

import numpy as np

from plisse.draw.camera import Camera, best_view
from plisse.errors import InvalidDesign
from plisse.structure.pleated import PleatedStructure

__all__ = ["VIEWS", "view_of"]

# azimuth and elevation in degrees
VIEWS = {"iso": (-45.0, 35.264), "top": (-90.0, 90.0), "front": (-90.0, 0.0), "side": (0.0, 0.0)}


def view_of(structure: PleatedStructure, name: str) -> Camera:
    """The camera that a name or "azimuth,elevation" in degrees means; "best" shows most of the folds.

    Azimuth counts around the z axis from the x axis. Raises InvalidDesign for anything else.
    """
    if name == "best":
        return best_view(structure)
    if name in VIEWS:
        return Camera.at(*np.radians(VIEWS[name]).tolist())
    try:
        azimuth, elevation = (float(part) for part in name.split(","))
    except ValueError:
        azimuth = elevation = np.nan
    if not (np.isfinite(azimuth) and -90 <= elevation <= 90):
        raise InvalidDesign(f"--view {name} is neither best, {', '.join(VIEWS)} nor azimuth,elevation in degrees with an "
                            "elevation from -90 to 90, for example 30,40")
    return Camera.at(np.radians(azimuth), np.radians(elevation))
