"""Structures on matplotlib axes: folded in space, or the flat sheet."""

import numpy as np

from plisse.draw import colours
from plisse.draw.drawing import crease_pattern
from plisse.draw.runs import lettered_runs
from plisse.draw.shade import SUN
from plisse.draw.shapes import Line
from plisse.errors import InvalidStructure
from plisse.measure.planarity import face_normals
from plisse.structure.pleated import PleatedStructure

__all__ = ["plot"]

INKS = {"B": colours.EDGE, "M": colours.MOUNTAIN, "V": colours.VALLEY, "F": colours.CAPTION}
LAYERS = {"boundary": colours.EDGE, "mountain": colours.MOUNTAIN, "valley": colours.VALLEY, "flat": colours.CAPTION}


def plot(structure: PleatedStructure, ax=None, *, flat: bool = False):
    """The axes with the structure on them: folded on 3D axes, its sheet on plane ones or where `flat` is asked for.

    Without axes a figure is made. Raises InvalidStructure for the sheet of a structure without development.
    """
    if ax is None:
        from matplotlib import pyplot

        ax = pyplot.figure().add_subplot(projection=None if flat else "3d")
    if flat and ax.name == "3d":
        raise InvalidStructure("the flat sheet needs plane axes, and these are 3D; leave projection='3d' out")
    if ax.name == "3d":
        _folded(structure, ax)
    else:
        _sheet(structure, ax)
    return ax


def _folded(structure: PleatedStructure, ax) -> None:
    from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

    vertices = structure.vertices
    faces = [vertices[face] for face in structure.topology.faces]
    facing = np.abs(face_normals(structure.topology, vertices) @ SUN)
    paper = colours.rgb(colours.PAPER) * (0.6 + 0.4 * facing)[:, None]
    ax.add_collection3d(Poly3DCollection(faces, facecolors=paper, edgecolors=paper, linewidths=0.1))
    runs = [run for run in lettered_runs(structure) if run.letter in INKS]
    paths = [vertices[np.append(run.vertices, run.vertices[:1]) if run.closed else run.vertices] for run in runs]
    ax.add_collection3d(Line3DCollection(paths, colors=[INKS[run.letter] for run in runs], linewidths=0.8))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.set_aspect("equal")


def _sheet(structure: PleatedStructure, ax) -> None:
    from matplotlib.collections import LineCollection

    for layer in crease_pattern(structure, "mm", margin=0.0).layers:
        if layer.name in LAYERS:
            lines = [np.concatenate([line.points, line.points[:1]]) if line.closed else line.points
                     for line in layer.lines if isinstance(line, Line)]
            ax.add_collection(LineCollection(lines, colors=LAYERS[layer.name], linewidths=0.8))
    ax.autoscale_view()
    ax.set_aspect("equal")
