"""What a client can ask of its process; every request is one or two calls of the library, as a script would make them."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from plisse.draw.camera import Camera, best_view
from plisse.draw.colour_maps import colour_maps, deviation_of
from plisse.errors import InvalidMesh, InvalidStructure
from plisse.io.meshes import read_mesh
from plisse.recipe import Recipe, SurfaceDesign
from plisse.result import Report, Result
from plisse.structure.pleated import PleatedStructure
from plisse.studio.bench import Bench, Progress, required
from plisse.studio.candidates import Choice, candidates_of
from plisse.studio.downloads import Order, made
from plisse.studio.marks import Reference, overlap_of, reference_of, seed_line, trouble_of
from plisse.studio.view import Tint, View, flat_view, folded_view, plates_view, posed_view, tinted
from plisse.transform.collisions import FreeRange
from plisse.transform.offset import offset_range

__all__ = [
    "Candidates",
    "Colour",
    "Fetch",
    "Found",
    "Mesh",
    "Pose",
    "Reach",
    "Request",
    "Solid",
    "Solve",
    "Take",
]


class Request:
    """A question with the seconds it may take; newer ones that outdate its lane make it stale."""

    limit: ClassVar[float] = 30.0

    @property
    def lane(self) -> str:
        """What kind of question it is."""
        return type(self).__name__

    @property
    def outdates(self) -> tuple[str, ...]:
        """The lanes whose older questions it makes stale."""
        return (self.lane,)

    @property
    def is_brief(self) -> bool:
        """Whether it is let finish once begun, although a newer one has come, unless it takes long."""
        return False

    def run(self, bench: Bench, progress: Progress) -> Any:
        """The answer; errors that plisse foresees are raised."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Found:
    """What a solved design looks like, and the report that proves it.

    `trouble` (3,) is the place of the first problem that the report names, `overlap` (2,) that on the sheet; `seed` (N, 3)
    is the curve the design starts from, `camera` the one that shows most. `drafted` designs have fewer samples than
    asked for.
    """

    report: Report
    drafted: bool
    folded: View | None = None
    sheet: View | None = None
    seed: np.ndarray | None = None
    trouble: np.ndarray | None = None
    overlap: np.ndarray | None = None
    camera: Camera | None = None
    reference: Reference | None = None
    tint: Tint | None = None


@dataclass(frozen=True)
class Solve(Request):
    """The structure of a recipe; `framed` asks for a camera as well, `colour` for a map if the structure has it.

    Drafts, and what is as `quick` as one, are let finish, so that the picture follows while a design is pulled.
    """

    limit: ClassVar[float] = 300.0
    recipe: Recipe
    framed: bool = False
    drafted: bool = False
    colour: str = ""
    quick: bool = False

    @property
    def lane(self) -> str:
        """Drafts wait beside the whole."""
        return "Draft" if self.drafted else "Solve"

    @property
    def outdates(self) -> tuple[str, ...]:
        """A draft is that of a newer design than all before it."""
        return ("Draft", "Solve") if self.drafted else ("Solve",)

    @property
    def is_brief(self) -> bool:
        """Whether it shows something while a design is pulled."""
        return self.drafted or self.quick

    def run(self, bench: Bench, progress: Progress) -> Found:
        """Everything the scene needs."""
        result = bench.result(self.recipe, progress)
        structure, report = result.structure, result.report
        found = Found(report, self.drafted, seed=seed_line(self.recipe), reference=reference_of(result))
        if structure is None:
            return found
        return replace(found, folded=folded_view(structure), trouble=trouble_of(structure, report),
                       sheet=None if structure.development is None else flat_view(structure),
                       overlap=overlap_of(structure, report), camera=best_view(structure) if self.framed else None,
                       tint=self._tint(result) if self.colour else None)

    def _tint(self, result: Result) -> Tint | None:
        colour = colour_maps(required(result), deviation_of(result)).get(self.colour)
        return None if colour is None else tinted(required(result), colour)


@dataclass(frozen=True)
class Pose(Request):
    """A state of the motion: 0 flat, 100 as designed, 200 folded flat."""

    recipe: Recipe
    percent: float

    def run(self, bench: Bench, progress: Progress) -> View:
        """The state as a view; raises InvalidStructure for structures that are not principal."""
        return posed_view(bench.motion(self.recipe), self.percent)


@dataclass(frozen=True)
class Colour(Request):
    """A colour map of a structure by name."""

    recipe: Recipe
    name: str

    def run(self, bench: Bench, progress: Progress) -> Tint:
        """The coloured faces; raises InvalidStructure where the structure has no such map."""
        result = bench.result(self.recipe)
        maps = colour_maps(required(result), deviation_of(result))
        if self.name not in maps:
            raise InvalidStructure(f"there is no colour map {self.name} for this structure; it has {', '.join(maps)}")
        return tinted(required(result), maps[self.name])


@dataclass(frozen=True)
class Solid(Request):
    """What the structure is shown as: "plates" of a thickness, or the "offset" at a distance, in model units."""

    recipe: Recipe
    kind: str
    length: float

    def run(self, bench: Bench, progress: Progress) -> View:
        """The view of them; raises InvalidStructure or InvalidDesign where they do not exist."""
        structure = required(bench.result(self.recipe))
        if self.kind == "offset":
            return folded_view(structure.offset(self.length))
        return plates_view(structure.plates(self.length))


@dataclass(frozen=True)
class Fetch(Request):
    """The whole result, as another process or a download needs it."""

    limit: ClassVar[float] = 300.0
    recipe: Recipe

    def run(self, bench: Bench, progress: Progress) -> Result:
        """The result."""
        return bench.result(self.recipe)


@dataclass(frozen=True)
class Reach(Request):
    """How far a structure moves, and how far it can be offset to both sides."""

    limit: ClassVar[float] = 120.0
    structure: PleatedStructure

    def run(self, bench: Bench, progress: Progress) -> tuple[FreeRange, tuple[float, float]]:
        """The free range of the motion in percent and the offset distances in model units."""
        return self.structure.flex(100).free_range, offset_range(self.structure)


@dataclass(frozen=True)
class Candidates(Request):
    """Automatic layouts over a surface, each as a picture and as a design."""

    limit: ClassVar[float] = 300.0
    recipe: SurfaceDesign
    count: int = 6

    def run(self, bench: Bench, progress: Progress) -> list[Choice]:
        """The layouts, the best first."""
        return candidates_of(self.recipe, self.count, progress)


@dataclass(frozen=True)
class Mesh(Request):
    """Whether a file that was uploaded is a surface; `name` is that by which designs mean it."""

    limit: ClassVar[float] = 60.0
    path: str
    name: str

    def run(self, bench: Bench, progress: Progress) -> int:
        """The number of its triangles; raises InvalidMesh for what is no surface."""
        try:
            return len(read_mesh(self.path).triangles)
        except InvalidMesh as error:
            raise InvalidMesh(str(error).replace(Path(self.path).name, self.name)) from None


@dataclass(frozen=True, eq=False)
class Take(Request):
    """A file made to an order, of one of the kinds of `plisse.studio.downloads`."""

    limit: ClassVar[float] = 300.0
    order: Order
    kind: str

    @property
    def lane(self) -> str:
        """Files of different kinds do not push each other out."""
        return f"Take {self.kind}"

    def run(self, bench: Bench, progress: Progress) -> bytes:
        """The content of the file."""
        return made(self.order, self.kind)
