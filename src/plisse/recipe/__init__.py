"""The recipe of a structure: one typed tree for TOML, Python, the command line and provenance.

Angles are in degrees and lengths in model units here and only here; everything behind uses radians.
"""

from plisse.recipe.closed_forms import ClosedForm, Cones, ConicCreases, Miura
from plisse.recipe.curves import Arc, Curve, Ellipse, Helix, Points, Spline, TorusKnot
from plisse.recipe.design import Design, Pattern, Solve
from plisse.recipe.fields import MILLIMETRES
from plisse.recipe.surface import Pull, Surface, SurfaceDesign, SurfacePattern

__all__ = ["MILLIMETRES", "Arc", "ClosedForm", "Cones", "ConicCreases", "Curve", "Design", "Ellipse", "Helix", "Miura",
           "Pattern", "Points", "Pull", "Solve", "Spline", "Surface", "SurfaceDesign", "SurfacePattern", "TorusKnot"]
