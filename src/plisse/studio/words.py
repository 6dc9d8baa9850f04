"""What the keys of a design are called on screen: a label, and a sentence that says what the control does."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

__all__ = ["TITLES", "WORDS", "Words", "spoken", "words_of"]

TITLES = {"pattern": "Pleats", "march": "Creases, one after the other", "closed_form": "Shape", "curve": "Curve",
          "surface": "Pleats over it", "strips": "Flat strips", "parallel": "Parallel mesh", "solve": "Exactness"}


@dataclass(frozen=True)
class Words:
    """The label of a key, a sentence for its tooltip, and what its choices are called."""

    label: str
    hint: str | None = None
    choices: dict[str, str] = field(default_factory=dict)


POINTS = Words("points per crease", "How many points every crease has: more are smoother and take longer")
FOLD = Words("fold angle", "How far the sheet is folded at the creases: 0° is flat, 180° folded together")
CREASES = Words("creases", "How many creases there are, mountains and valleys counted together")
CLOSED = Words("closed curve", "Joins the end of the curve to its beginning")

WORDS = {
    "pattern.theta": Words("inclination θ", "How far pleats lean over: 0° stand upright, towards 90° they lie flat"),
    "pattern.creases": CREASES,
    "pattern.width": Words("width", "Distance from one crease to the next, measured on the smooth surface"),
    "pattern.amplitude": Words("amplitude", "How far creases leave the smooth surface to both sides: more folds sharper"),
    "pattern.samples": POINTS,
    "pattern.spacing": Words("falling strips", "Strips that fall are narrower where both sides of a crease shall lean alike",
                             {"mirror": "narrower, to mirror", "uniform": "as wide as rising"}),
    "pattern.method": Words("curves grow", "From one crease to the next in fine steps, or in a single one as in the paper",
                            {"accurate": "in fine steps", "paper": "in one step"}),
    "pattern.smoothing": Words("smoothing (of the length)", "Evens out how pleats twist, over this fraction of the curve"),
    "pattern.initial": Words("creases follow", "The plane in which creases begin; the normal shows the failure of Fig. 25",
                             {"binormal": "the pleats", "normal": "the normal"}),
    "pattern.columns": Words("columns", "How many faces lie side by side along a crease"),
    "pattern.hub_size": Words("hole around singularity", "How far from a singularity creases begin"),
    "pattern.reach": Words("reach of creases", "How far from a singularity creases end"),
    "march.creases": CREASES,
    "march.distance": Words("distance of creases", "Distance from one crease to the next, in their middle"),
    "march.direction": Words("strips widen by", "0° keeps creases parallel, more widens strips along the curve"),
    "march.fold": FOLD,
    "march.opening": Words("opening of the curve", "Angle between both sides of the first crease: 180° is flat"),
    "march.turn": Words("lean of facets", "0° is smooth; more makes facets that lean to both sides in turn, like a Miura"),
    "march.seed": Words("number of the curve", "Which of the creases the curve is, counted from 1"),
    "march.samples": POINTS,
    "closed_form.creases": CREASES, "closed_form.samples": POINTS, "closed_form.fold": FOLD,
    "closed_form.radius": Words("radius", "Radius of the first crease"),
    "closed_form.width": Words("width", "Distance from one crease to the next"),
    "closed_form.slope": Words("slope", "How steeply the strips rise"),
    "closed_form.sector": Words("sector", "Angle that the flat sheet, or its smallest piece, spans"),
    "closed_form.pitch": Words("pitch", "How far one turn rises"),
    "closed_form.turns": Words("turns", "How often creases go around the axis"),
    "closed_form.size": Words("half axis", "Half the length of the first ellipse"),
    "closed_form.eccentricity": Words("eccentricity", "0 is a circle, towards 1 ellipses grow longer"),
    "closed_form.growth": Words("growth per crease", "How much larger every crease is than the last one"),
    "closed_form.start": Words("first ruling at", "Where on the first ellipse the rulings begin"),
    "closed_form.step": Words("step of rulings", "How far rulings go on around the ellipse: less is smoother"),
    "closed_form.edge": Words("edge", "Length of the edges along creases"),
    "closed_form.ruling": Words("ruling", "Length of the edges across"),
    "curve.radius": Words("radius", "Radius of the curve"),
    "curve.pitch": Words("pitch", "How far one turn rises"),
    "curve.turns": Words("turns", "How often the curve goes around its axis"),
    "curve.angle": Words("angle", "How much of the whole turn there is: 360° is all"),
    "curve.a": Words("half axis a", "Half the length of the ellipse along x"),
    "curve.b": Words("half axis b", "Half the length of the ellipse along y"),
    "curve.p": Words("turns about the axis", "How often the knot goes around the axis of the torus"),
    "curve.q": Words("turns about the tube", "How often the knot winds around the tube of the torus"),
    "curve.R": Words("radius", "Radius from the axis to the middle of the tube"),
    "curve.r": Words("radius of the tube", "Half the width of the tube"),
    "curve.rz": Words("half height of the tube", "Half the height of the tube, where it is not round"),
    "curve.smooth": Words("smoothing over", "Evens out measured points over this length"),
    "curve.closed": CLOSED,
    "curve.points": Words("control points"),
    "surface.overhang": Words("pleats may overhang", "Allows faces that hide others, seen from above"),
    "surface.boundary": Words("keep the boundary", "Creases begin and end on the boundary of the surface"),
    "surface.guide_closed": Words("closed guide", "Joins the end of the guide to its beginning"),
    "surface.guide_boundary": Words("boundary as guide", "Number of the boundary that creases start from: 1 is the longest"),
    "surface.directions": Words("creases leave", "How creases leave the guide",
                                {"tuned": "for even gaps", "orthogonal": "at right angles"}),
    "surface.reach": Words("reach", "How far creases run to either side of where they start"),
    "surface.beyond": Words("run over the boundary", "Lets creases leave the surface where it can be continued"),
    "surface.crop": Words("cropped to", "What the pleats are cut along", {"rectangle": "a rectangle",
                                                                          "outline": "the surface"}),
    "surface.side": Words("first crease lies", "On which side of the surface the first crease is"),
    "surface.seams": Words("seams at most", "Along how many cuts the pleats may fall apart, where one sheet does not reach"),
    "surface.centre": Words("middle of the rows", "Around which point rows of pleats are laid; a click sets it, too"),
    "surface.point": Words("start of the creases", "From which point creases start in all directions"),
    "surface.family": Words("family", "Which of the two families of asymptotic curves the creases follow"),
    "surface.hub": Words("at singularities", "What is in the middle, where several legs of creases meet",
                         {"closed": "a face", "cut": "a hole"}),
    "surface.smoothing": Words("smoothing (edges)", "Evens out the noise of the mesh over so many lengths of its edges"),
    "surface.guide": Words("guide"), "surface.file": Words("mesh"),
    "strips.width": Words("width", "Width of every strip, both sides of its curve together"),
    "strips.thickness": Words("thickness", "Thickness of the strips"),
    "strips.side": Words("strips lie", "On which side of their curves strips lie",
                         {"both": "on both sides", "above": "above", "below": "below"}),
    "strips.theta": Words("inclination θ", "How steeply strips stand: they make 90° − θ with the surface"),
    "strips.spacing": Words("distance of strips", "Distance from one strip to the next along the guide"),
    "strips.lean": Words("strips lean", "To which side of the guide strips lean"),
    "strips.samples": Words("points per strip", "How many points every strip has: more are smoother and take longer"),
    "parallel.lengths": Words("factor of lengths", "How much longer edges along the first crease become"),
    "parallel.widths": Words("factor of widths", "How much wider strips become"),
    "parallel.growth": Words("growth to the end", "How much larger the mesh is where creases end than where they begin"),
    "parallel.least_scale": Words("least factor", "How much an edge may shrink"),
    "parallel.refine": Words("triple folds", "Where one fold becomes three", {"all": "at all inner creases"}),
    "parallel.fraction": Words("place of new folds", "Where across a strip new folds lie: 0 at its crease, 1 at the next"),
    "parallel.at": Words("measured at", "Where along the crease that place is measured"),
    "parallel.rounds": Words("rounds", "How often folds become three"),
    "solve.principal": Words("folds flat (principal)", "Asks for a structure that moves from the flat sheet to folded flat"),
    "solve.method": Words("made exact by", "The exact solver, or the paper's energy, which stays a little short of it",
                          {"exact": "exact solver", "paper": "the paper's energy"}),
    "solve.cut": Words("place of the cut", "Where along the crease a closed sheet is cut open to lie flat"),
}
POINT = re.compile(r"\bcurve\.points\[(\d+)\]")
KEY = re.compile(rf"\b(?:{'|'.join(TITLES)})\.\w+")


def words_of(key: str) -> Words:
    """The words of a key; those that have none of their own are called as in the text."""
    return WORDS.get(key) or Words(key.partition(".")[2].replace("_", " "))


def spoken(sentence: str) -> str:
    """A sentence with keys of a design called as their controls are; other keys stay."""
    sentence = POINT.sub(lambda found: f"control point {int(found[1]) + 1}", sentence)
    return KEY.sub(lambda found: f"“{WORDS[found[0]].label}”" if found[0] in WORDS else found[0], sentence)
