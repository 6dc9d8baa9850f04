"""The recipe of a structure: one typed tree for TOML, Python, the command line and provenance.

Angles are in degrees and lengths in model units here and only here; everything behind uses radians.
"""

from plisse.recipe.asymptotic import AsymptoticDesign, AsymptoticPattern, AsymptoticSurface, WeierstrassData
from plisse.recipe.closed_forms import ClosedForm, Cones, ConicCreases, HelicalPleats, Miura
from plisse.recipe.curves import Arc, Curve, Ellipse, Helix, Points, Spline, TorusKnot
from plisse.recipe.design import Design, Pattern, Solve
from plisse.recipe.fields import MILLIMETRES
from plisse.recipe.march import March
from plisse.recipe.parallel import Move, Parallel
from plisse.recipe.strips import Strips
from plisse.recipe.surface import Pull, Section, Surface, SurfaceDesign, SurfacePattern

__all__ = ["MILLIMETRES", "Arc", "AsymptoticDesign", "AsymptoticPattern", "AsymptoticSurface", "ClosedForm", "Cones",
           "ConicCreases", "Curve", "Design", "Ellipse", "HelicalPleats", "Helix", "March", "Miura", "Move", "Parallel",
           "Pattern", "Points", "Pull", "Recipe", "Section", "Solve", "Spline", "Strips", "Surface", "SurfaceDesign",
           "SurfacePattern", "TorusKnot", "WeierstrassData"]

Recipe = Design | SurfaceDesign | AsymptoticDesign
