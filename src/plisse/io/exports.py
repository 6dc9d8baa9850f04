"""Formats that `plisse export` writes, by extension: a new format is one file in this room and one line here."""

from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import numpy as np

from plisse.draw.drawing import Drawing, captioned, crease_pattern
from plisse.draw.strokes import MACHINE, PRINT
from plisse.errors import InvalidStructure, PlisseError
from plisse.io.atomic import require_writable, written
from plisse.io.dxf import write_dxf
from plisse.io.fold import write_fold
from plisse.io.glb_structure import write_glb
from plisse.io.model import Model
from plisse.io.obj import write_obj
from plisse.io.pdf import write_pdf
from plisse.io.ply import write_ply
from plisse.io.rhino import write_3dm
from plisse.io.stl import write_stl
from plisse.io.svg import write_svg
from plisse.io.threemf import write_3mf
from plisse.leastsquares.factor import NotPositiveDefinite
from plisse.measure.isometry import isometry_defect
from plisse.measure.sectors import angle_defect
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.structure.pleated import PleatedStructure

__all__ = ["FLAT", "FOLDED", "developed", "export"]

WORST_ISOMETRY, WORST_ANGLE = 1e-3, 0.1

# writers of the folded shape: (structure, path, *, title, units)
FOLDED: dict[str, Callable] = {
    ".obj": write_obj,
    ".ply": write_ply,
    ".stl": write_stl,
    ".3mf": write_3mf,
    ".glb": write_glb,
}

ELSEWHERE = f"`plisse check` says where, and {', '.join(FOLDED)} need no sheet"

# writers that need the development too
BOTH: dict[str, Callable] = {
    ".fold": partial(write_fold, curves=True),
    ".3dm": write_3dm,
}

# writers of the flat sheet: (drawing, path), and how its lines look
FLAT: dict[str, tuple[Callable[[Drawing, Path], None], dict]] = {
    ".svg": (write_svg, MACHINE),
    ".dxf": (lambda drawing, path: write_dxf([captioned(drawing)], path), MACHINE),
    ".pdf": (lambda drawing, path: write_pdf([captioned(drawing, PRINT)], path), PRINT),
}


def export(model: Model, paths: list[Path]) -> None:
    """Write the model to every path in the format of its extension, all files or none.

    Raises PlisseError for extensions that no format has and places that cannot be written, MissingExtra where a format
    needs a library that is not installed, InvalidStructure where the flat sheet is wanted and the model has none.
    """
    for number, path in enumerate(paths):
        _require_known(path)
        if path.absolute() in [other.absolute() for other in paths[:number]]:
            raise PlisseError(f"{path} is named twice; name every file once")
    for path in paths:
        if not path.parent.is_dir():
            raise PlisseError(f"{path} cannot be written, because there is no directory {path.parent}; make it first")
        require_writable(path.parent, [path.name])
    if any(path.suffix.lower() not in FOLDED for path in paths):
        model = developed(model)
    with ExitStack() as together:
        for path in paths:
            _write(model, path.suffix.lower(), together.enter_context(written(path)))


def developed(model: Model) -> Model:
    """The model with its development, computed where the file had none.

    Raises InvalidStructure where the development would not be isometric: such a sheet does not fold to the model.
    """
    structure = model.structure
    if structure.development is None:
        structure = _flattened(structure)
    opened = structure.opened
    assert structure.development is not None
    defect = isometry_defect(opened.topology, opened.vertices, structure.development)
    if not defect <= WORST_ISOMETRY:
        raise InvalidStructure(f"the mesh does not lie flat: lengths on its sheet would be wrong by {defect:.1e} mean edges "
                               f"(limit {WORST_ISOMETRY:g}); {ELSEWHERE}")
    return Model(structure, model.units, model.title)


def _flattened(structure: PleatedStructure) -> PleatedStructure:
    topology = structure.topology
    misfit = np.abs(angle_defect(topology, structure.vertices)[topology.is_inner]).max(initial=0.0)
    if not misfit <= WORST_ANGLE:
        raise InvalidStructure(f"the mesh does not lie flat: angles around a vertex miss 2π by {misfit:.1e} "
                               f"(limit {WORST_ANGLE:g}); {ELSEWHERE}")
    try:
        return flatten(structure, best_cut(structure))
    except NotPositiveDefinite:
        raise InvalidStructure(f"the mesh cannot be laid flat, because faces are degenerate; {ELSEWHERE}") from None


def _require_known(path: Path) -> None:
    if path.suffix.lower() not in {**FOLDED, **BOTH, **FLAT}:
        known = ", ".join([*BOTH, *FOLDED, *FLAT])
        raise PlisseError(f"{path.name} has no extension that plisse can export; give one of {known}")


def _write(model: Model, suffix: str, path: Path) -> None:
    if suffix in FLAT:
        write, strokes = FLAT[suffix]
        write(crease_pattern(model.structure, model.units, title=model.title, strokes=strokes), path)
    else:
        {**FOLDED, **BOTH}[suffix](model.structure, path, title=model.title, units=model.units)
