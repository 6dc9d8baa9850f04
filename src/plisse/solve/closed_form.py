"""Structures that a design names by formula instead of curve and pattern."""

from functools import singledispatch

import numpy as np

from plisse.recipe import Cones, ConicCreases, HelicalPleats, Miura
from plisse.structure.exact import alternating_cones, conic_creases, miura
from plisse.structure.helical import helical_pleats
from plisse.structure.pleated import PleatedStructure

__all__ = ["closed_form"]


@singledispatch
def closed_form(form) -> PleatedStructure:
    """The exact principal structure of a `closed_form` section, in model units."""
    raise TypeError(f"no closed form of type {type(form).__name__}")


@closed_form.register
def _(form: Cones) -> PleatedStructure:
    full = form.sector == 360
    return alternating_cones(form.creases, form.samples, radius=form.radius, width=form.width, slope=form.slope,
                             sector=float(np.radians(form.sector)), closed=full)


@closed_form.register
def _(form: ConicCreases) -> PleatedStructure:
    structure = conic_creases(form.creases, form.samples, eccentricity=form.eccentricity, growth=form.growth,
                              fold=float(np.radians(form.fold)), start=float(np.radians(form.start)),
                              step=float(np.radians(form.step)))
    return structure.with_vertices(form.size * structure.vertices)


@closed_form.register
def _(form: HelicalPleats) -> PleatedStructure:
    return helical_pleats(form.creases, form.samples, radius=form.radius, pitch=form.pitch, width=form.width,
                          slope=float(np.radians(form.slope)), turns=form.turns)


@closed_form.register
def _(form: Miura) -> PleatedStructure:
    return miura(form.creases, form.samples, edge=form.edge, ruling=form.ruling,
                 sector=float(np.radians(form.sector)), fold=float(np.radians(form.fold)))
