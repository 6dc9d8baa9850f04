"""From a structure to sheets: split, joined, nested."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from plisse.errors import Infeasible, PlisseError
from plisse.fabricate.dense_nesting import tightened
from plisse.fabricate.joints import Joint, joints_between
from plisse.fabricate.nesting import Bed, nest
from plisse.fabricate.paper import Paper, paper_of
from plisse.fabricate.pieces import Piece, Placement, pieces_from
from plisse.fabricate.splitting import NARROWEST, Room, split
from plisse.fabricate.tabs import tabs_for
from plisse.recipe import MILLIMETRES
from plisse.structure.pleated import PleatedStructure

__all__ = ["FOOTER", "JointKind", "Nesting", "Sheets", "require_lengths", "sheets"]

JointKind = Literal["tabs", "edges"]
Nesting = Literal["quick", "dense"]
FOOTER = 9.0
SMALLEST = 1.0


@dataclass(frozen=True, eq=False)
class Sheets:
    """A development as pieces on sheets of one material, lengths in millimetres.

    `placements` has one entry per piece; `paper` is the whole development, in whose place the pieces are stored.
    The lowest 9 mm inside the margins of every sheet stay free for its caption and scale bar.
    """

    paper: Paper
    pieces: tuple[Piece, ...]
    joints: tuple[Joint, ...]
    placements: tuple[Placement, ...]
    material: tuple[float, float]
    margin: float
    kerf: float
    joint: JointKind
    tab: float

    @property
    def count(self) -> int:
        """Number of sheets."""
        return 1 + max(placement.sheet for placement in self.placements)

    @property
    def use(self) -> float:
        """Area of the pieces over the area of the sheets."""
        return float(sum(piece.area for piece in self.pieces) / (self.count * self.material[0] * self.material[1]))

    @property
    def edge_count(self) -> int:
        """How many numbered edges there are, each on two sides."""
        return sum(len(joint.labels) for joint in self.joints)

    @property
    def notes(self) -> list[str]:
        """What a maker should know: edges without a flap, flaps that are shorter than wished, edges that close the ring."""
        out = []
        bare = self.edge_count - sum(len(piece.tabs) for piece in self.pieces)
        if self.joint == "tabs" and bare:
            beside = f" beside a kerf of {self.kerf:g} mm" if self.kerf else ""
            out.append(f"edges without a flap, because there is no room for one{beside}: {bare} of {self.edge_count}; "
                       "glue a strip behind them")
        depths = [tab.depth for piece in self.pieces for tab in piece.tabs]
        short = sum(depth < self.tab for depth in depths)
        if short:
            out.append(f"flaps of less than {self.tab:g} mm, because there is no room for more: {short} of {len(depths)}, "
                       f"the smallest {min(depths):.1f} mm deep")
        closing = [joint.name for joint in self.joints if joint.closes]
        if closing:
            which = f"joint {closing[0]} closes" if len(closing) == 1 else f"joints {', '.join(closing)} close"
            out.append(f"{which} the structure: join last, when everything is folded")
        return out

    def on_sheet(self, number: int) -> list[tuple[Piece, Placement]]:
        """Pieces on one sheet, counted from 0, with their placements."""
        return [pair for pair in zip(self.pieces, self.placements, strict=True) if pair[1].sheet == number]


def sheets(structure: PleatedStructure, *, material: tuple[float, float] = (600.0, 300.0), units: str = "mm",
           scale: float = 1.0, kerf: float = 0.0, joint: JointKind = "tabs", tab: float = 6.0, margin: float = 5.0,
           spacing: float = 2.0, nesting: Nesting = "quick") -> Sheets:
    """The development as pieces that overlap nowhere, nested on sheets of `material` (width, height) mm.

    `scale` is in paper per model. Outlines are grown by half the `kerf`, pieces are `spacing` apart and `margin` from the
    edge of the sheet; `tab` is the depth of glue flaps. All in mm. Raises PlisseError for numbers without sense,
    InvalidStructure without a development, Infeasible where a face does not fit the material, the kerf is wider than a
    piece or the whole development smaller than a millimetre, MissingExtra for dense nesting without spyrrow.
    """
    _require_sense(material, units, scale, kerf, joint, tab, margin, spacing, nesting)
    if spacing >= max(material):
        raise PlisseError(f"a spacing of {spacing:g} mm is larger than the material; give the distance between pieces in mm")
    paper = paper_of(structure, MILLIMETRES[units] * scale)
    extent = float(np.ptp(paper.points, axis=0).max())
    if extent < SMALLEST:
        raise Infeasible(f"the development would be {extent:.2g} mm wide at scale {scale:g}; give a larger scale, or a size")
    bed = Bed((margin, margin + FOOTER), material[0] - 2 * margin, material[1] - 2 * margin - FOOTER, spacing)
    if min(bed.width, bed.height) <= 0:
        raise Infeasible(f"material of {material[0]:g} × {material[1]:g} mm is smaller than its margins of {margin:g} mm "
                         f"and a caption of {FOOTER:g} mm; take larger material or a smaller margin")
    if kerf >= min(bed.width, bed.height):
        raise Infeasible(f"a kerf of {kerf:g} mm is wider than any piece on this material; give the width of the cut")
    flap = tab if joint == "tabs" else 0.0
    masks = split(paper, Room(bed.width - kerf, bed.height - kerf, flap, max(kerf, NARROWEST)))
    piece = np.empty(paper.topology.face_count, int)
    for k, mask in enumerate(masks):
        piece[mask] = k
    joints = joints_between(paper, piece)
    tabs = tabs_for(paper, [paper.polygon(mask) for mask in masks], joints, flap, kerf) if flap else ()
    pieces = pieces_from(paper, masks, tabs, kerf)
    outlines = [piece.outline for piece in pieces]
    placements = nest(outlines, bed)
    if nesting == "dense":
        placements = tightened(outlines, placements, bed)
    return Sheets(paper, pieces, joints, tuple(placements), material, margin, kerf, joint, flap)


def _require_sense(material: tuple[float, float], units: str, scale: float, kerf: float, joint: str, tab: float,
                   margin: float, spacing: float, nesting: str) -> None:
    require_lengths(material, scale=scale, tab=tab, kerf=kerf, margin=margin, spacing=spacing)
    words = {"units": (units, tuple(MILLIMETRES)), "joint": (joint, get_args(JointKind)),
             "nesting": (nesting, get_args(Nesting))}
    for name, (word, known) in words.items():
        if word not in known:
            raise PlisseError(f"{name} {word!r} is unknown; give {' or '.join(known)}")


def require_lengths(material: tuple[float, float], **numbers: float) -> None:
    """Nothing; raises PlisseError where material, scale or tab is not above 0, or another number below 0."""
    for name, value in {"material width": material[0], "material height": material[1], **numbers}.items():
        least = "above" if name in ("material width", "material height", "scale", "tab") else "from"
        if not (0 <= value < np.inf) or (value == 0 and least == "above"):
            raise PlisseError(f"{name} is {value:g}; give a number {least} 0")
