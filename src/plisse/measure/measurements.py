"""All numbers about a structure: of its folded shape and of its sheet."""

from dataclasses import dataclass

from plisse.measure.isometry import isometry_defect
from plisse.measure.overlap import Overlap, development_overlap
from plisse.measure.shape import Shape
from plisse.structure.pleated import PleatedStructure

__all__ = ["Measurements", "measure"]


@dataclass(frozen=True, eq=False)
class Measurements:
    """The folded shape, and how the sheet belongs to it; `isometry` and `overlap` are None without development."""

    shape: Shape
    isometry: float | None
    overlap: Overlap | None


def measure(structure: PleatedStructure, shape: Shape | None = None) -> Measurements:
    """Every measure of a structure; what is known of its `shape` already is not taken again."""
    if shape is None or shape.vertices is not structure.vertices:
        shape = Shape(structure.topology, structure.vertices)
    flat, opened = structure.development, structure.cut.topology
    return Measurements(
        shape,
        None if flat is None else isometry_defect(opened, structure.vertices[structure.cut.source], flat),
        None if flat is None else development_overlap(opened, flat))
