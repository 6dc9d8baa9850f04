"""What a design comes to: the structure, the way there, and the report that proves it."""

from dataclasses import dataclass
from typing import Literal

import msgspec
import numpy as np

from plisse.geometry.mesh import ReferenceMesh
from plisse.recipe import Recipe
from plisse.structure.pattern import Pattern
from plisse.structure.pleated import PleatedStructure
from plisse.transform.arrangement import Arrangement
from plisse.transform.variation import Member

__all__ = ["ChosenLayout", "Deviation", "Interval", "Overlay", "Report", "Result", "Sheet", "Spread", "StripEntry"]


class Spread(msgspec.Struct, frozen=True):
    """Largest and mean absolute value."""

    max: float
    mean: float


class Interval(msgspec.Struct, frozen=True):
    """Smallest and largest value."""

    min: float
    max: float


class Sheet(msgspec.Struct, frozen=True):
    """The development on paper, in one piece or several; the size is that of all of them as they lie."""

    overlaps: bool
    size_mm: tuple[float, float]
    overlap_at_mm: tuple[float, float] | None = None
    pieces: int = 1


class Deviation(msgspec.Struct, frozen=True):
    """Distance of the mid-surface from the reference: model units, relative to its diagonal, and in amplitudes."""

    max: float
    mean: float
    max_relative: float
    mean_relative: float
    max_amplitudes: float
    mean_amplitudes: float


class ChosenLayout(msgspec.Struct, frozen=True):
    """What was chosen over a whole surface: what rows do, sizes in model units, and the point they run around, if any."""

    label: str
    width: float
    amplitude: float
    centre: list[float] | None


class StripEntry(msgspec.Struct, frozen=True):
    """One strip of a cutting list: the number of its curve (from 1), sizes in model units, angles to the surface."""

    strip: int
    length: float
    width: float
    curve_length: float
    faces: int
    inclination_deg: Interval | None
    shortest_ruling: float
    notes: list[str]


class Report(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=False):
    """The numbers of `report.json`; angles in radians unless a name says degrees, see the conventions page."""

    status: Literal["exact", "approximate", "infeasible"]
    reasons: list[str]
    vertices: int = 0
    faces: int = 0
    planarity: Spread | None = None
    angle_defect: Spread | None = None
    principal_defect: Spread | None = None
    min_sector_angle_deg: float | None = None
    opening_angle_deg: Interval | None = None
    crease_deviation: Spread | None = None
    inverted_faces: int | None = None
    self_intersections: int | None = None
    isometry: float | None = None
    seams: int = 0
    holes: int | None = None
    coverage: float | None = None
    deviation: Deviation | None = None
    layout: ChosenLayout | None = None
    inclination_deg: list[Interval] | None = None
    principal: bool = False
    edge_scales: Interval | None = None
    strips: list[StripEntry] = []
    warnings: list[str] = []
    start: dict[str, Spread] = {}
    tried: list[str] = []
    iterations: int = 0
    method: str = ""
    seconds: dict[str, float] = {}
    units: str = "mm"
    development: Sheet | None = None
    history: list[float] = []
    design: dict = {}


@dataclass(frozen=True, eq=False)
class Overlay:
    """A reference mesh, the distances (F,) of faces from it in model units, and the amplitude that is their unit."""

    mesh: ReferenceMesh
    distances: np.ndarray
    amplitude: float


@dataclass(frozen=True, eq=False)
class Result:
    """A design, its guiding pattern, the zigzag it started from, the structure and its report.

    `pattern`, `zigzagged` and `structure` are None where the design broke down before they existed. `family` are the
    parallel structures on the way to the last one, with their captions; `arrangement` are strips instead of pleats, on
    `surface` where there is one.
    """

    design: Recipe
    report: Report
    pattern: Pattern | None = None
    zigzagged: PleatedStructure | None = None
    structure: PleatedStructure | None = None
    overlay: Overlay | None = None
    family: tuple[Member, ...] = ()
    arrangement: Arrangement | None = None
    surface: ReferenceMesh | None = None

    @property
    def status(self) -> str:
        """exact, approximate or infeasible."""
        return self.report.status

    @property
    def timings(self) -> dict[str, float]:
        """Seconds of every stage, and in total."""
        return self.report.seconds

    def report_page(self, *, title: str = "") -> str:
        """One self-contained HTML page: a turning view, the sheet, the numbers, the way there, the recipe.

        Raises ValueError where the design broke down before there was a structure.
        """
        from plisse.draw.colour_maps import deviation_of
        from plisse.io.page import report_page

        if self.structure is None:
            raise ValueError(f"there is no structure to show: {'; '.join(self.report.reasons)}")
        return report_page(self.structure, self.report, title=title, deviation=deviation_of(self))

    def plot(self, ax=None, *, flat: bool = False):
        """The structure on matplotlib axes, see PleatedStructure.plot; raises ValueError where there is none."""
        if self.structure is None:
            raise ValueError(f"there is no structure to show: {'; '.join(self.report.reasons)}")
        return self.structure.plot(ax, flat=flat)

    def _repr_html_(self) -> str:
        """Status, numbers and a picture, for notebooks."""
        from plisse.draw.notebook import result_html

        return result_html(self)
