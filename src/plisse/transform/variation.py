"""The parallel meshes that a recipe asks for, one after the other (§2.3, Fig. 7)."""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from plisse.errors import InvalidDesign
from plisse.geometry.polyline import arc_length
from plisse.recipe.parallel import Factors, Move, Parallel
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline
from plisse.transform.parallel import parallel
from plisse.transform.refine_fold import inner_creases, refine_folds

__all__ = ["Member", "edge_factors", "variations"]


class Member(NamedTuple):
    """One of a family of parallel structures, and what it is.

    `pulls` (K, 2, 3) are places of handles before and where they were to go, where handles made it.
    """

    caption: str
    structure: PleatedStructure
    pulls: np.ndarray | None = None


def variations(structure: PleatedStructure, recipe: Parallel) -> tuple[Member, ...]:
    """The structure itself and what a recipe makes of it, step by step, all laid flat; the last is the result.

    Raises InvalidDesign where the recipe contradicts itself, Infeasible where a parallel mesh has no positive scales.
    """
    ways = [name for name in ("growth", "moves") if getattr(recipe, name) is not None]
    ways += ["factors"] if recipe.lengths is not None or recipe.widths is not None else []
    if len(ways) > 1:
        raise InvalidDesign(f"a parallel mesh is made in one way, but {ways[0]} and {ways[1]} are both given; remove one")
    if not ways and recipe.refine is None:
        raise InvalidDesign("nothing is asked for of the parallel mesh; give lengths, widths, growth, moves or refine")
    members = [Member("as designed", structure)]
    if ways:
        members.append(_parallel(structure, recipe, ways[0]))
    if recipe.refine is not None:
        _refined(members, recipe)
    return tuple(members)


def edge_factors(factors: Factors | None, line: Polyline, vertices: np.ndarray, name: str) -> np.ndarray:
    """One factor per edge of a polyline: from one, one each, or a table of positions from 0 to 1 and factors.

    Tables are interpolated without overshoot. Raises InvalidDesign for tables that do not rise, or lists of wrong length.
    """
    points = vertices[line.vertices]
    along = arc_length(points, line.closed)
    count = len(along) - 1
    if not isinstance(factors, list):
        return np.full(count, 1.0 if factors is None else factors)
    if not any(isinstance(entry, list) for entry in factors):
        if len(factors) != count:
            raise InvalidDesign(f"{name} has {len(factors)} factors, but there are {count} edges; give one, one for each, "
                                "or a table [[position, factor], …]")
        return np.array(factors, dtype=float)
    if not all(isinstance(entry, list) and len(entry) == 2 for entry in factors):
        raise InvalidDesign(f"{name} mixes factors and rows; a table has rows [position from 0 to 1, factor] only")
    position, value = np.array(factors, dtype=float).T
    if len(position) < 2 or not (np.diff(position) > 0).all() or not (value > 0).all():
        raise InvalidDesign(f"{name} needs at least two rows with rising positions and factors above 0")
    middle = 0.5 * (along[1:] + along[:-1]) / along[-1]
    return PchipInterpolator(position, value)(np.clip(middle, position[0], position[-1]))


def _parallel(structure: PleatedStructure, recipe: Parallel, way: str) -> Member:
    if way == "growth":
        assert recipe.growth is not None
        return Member(f"grown {recipe.growth:g} times along the creases", parallel(structure, growth=recipe.growth))
    if way == "moves":
        assert recipe.moves is not None
        handles = {(move.crease - 1, move.point - 1): _place(structure, move) for move in recipe.moves}
        found = parallel(structure, handles=handles, least_scale=recipe.least_scale)
        before = [structure.vertices[structure.topology.creases[crease].vertices[point]] for crease, point in handles]
        return Member("nearest to the handles", found, np.stack([before, list(handles.values())], axis=1))
    topology, vertices = structure.topology, structure.vertices
    return Member("edges rescaled", parallel(
        structure, lengths=edge_factors(recipe.lengths, topology.creases[0], vertices, "lengths"),
        widths=edge_factors(recipe.widths, topology.rulings[0], vertices, "widths")))


def _place(structure: PleatedStructure, move: Move) -> np.ndarray:
    """Where a handle goes."""
    creases = structure.topology.creases
    if (move.by is None) == (move.to is None):
        raise InvalidDesign(f"the move of crease {move.crease}, point {move.point} needs either by or to")
    if move.crease > len(creases) or move.point > len(creases[move.crease - 1].vertices):
        raise InvalidDesign(f"there is no point {move.point} on a crease {move.crease}; the structure has {len(creases)} "
                            f"creases with {len(creases[0].vertices)} points on the first")
    if move.to is not None:
        return np.array(move.to)
    return structure.vertices[creases[move.crease - 1].vertices[move.point - 1]] + np.array(move.by)


def _refined(members: list[Member], recipe: Parallel) -> None:
    """Add one member per round of folds replaced by three: those named first, then those that came of them."""
    assert recipe.refine is not None
    structure = members[-1].structure
    inner = inner_creases(structure.topology)
    chosen = inner if recipe.refine == "all" else [crease - 1 for crease in recipe.refine if isinstance(crease, int)]
    for _ in range(recipe.rounds):
        before = structure.topology
        found = refine_folds(structure, chosen, fraction=recipe.fraction, at=None if recipe.at is None else recipe.at / 100)
        touched = np.zeros(found.topology.vertex_count, bool)
        touched[before.vertex_count:] = True
        touched[np.concatenate([before.creases[number].vertices for number in chosen])] = True
        structure = flatten(found, best_cut(found))
        members.append(Member(f"{len(chosen)} folds replaced by three" if len(chosen) > 1 else "one fold replaced by three",
                              structure))
        chosen = [number for number, crease in enumerate(structure.topology.creases) if touched[crease.vertices[0]]]
