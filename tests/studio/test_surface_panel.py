"""Clicks on a surface do what was chosen, or say that they met none."""

import asyncio
from types import SimpleNamespace
from unittest.mock import MagicMock

import numpy as np
import pytest

pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")

from plisse.io.designs import design_from_dict
from plisse.studio.marks import Reference
from plisse.studio.surface_panel import CENTRE, MISSED, SurfacePanel

SQUARE = Reference(np.array([[0, 0, 0], [8, 0, 0], [8, 8, 0], [0, 8, 0]], np.float32),
                   np.array([[0, 1, 2], [0, 2, 3]], np.uint32), np.ones(2, bool))


@pytest.fixture
def tab():
    """Stands for a tab with a surface, whose clicks set the centre."""
    tab = MagicMock()
    tab.desk.recipe = design_from_dict({"surface": {"height": "0*x", "x": [0, 8], "y": [0, 8]}, "pattern": {"width": 1}})
    tab.found = SimpleNamespace(reference=SQUARE)
    return tab


def click(tab, x, y):
    """Click from above at a place."""
    panel = SurfacePanel(tab)
    panel._click.value = CENTRE
    asyncio.run(panel._clicked(SimpleNamespace(ray_origin=(x, y, 5), ray_direction=(0, 0, -1))))


def test_a_click_on_the_surface_sets_the_centre(tab):
    click(tab, 2, 3)
    assert tab.change.call_args.args[0]["surface.centre"] == [2, 3, 0]
    tab.panels.note.assert_not_called()


def test_a_click_beside_the_surface_says_so_and_changes_nothing(tab):
    click(tab, 9, 3)
    tab.panels.note.assert_called_once_with(MISSED)
    tab.change.assert_not_called()


@pytest.mark.parametrize("found", [None, SimpleNamespace(reference=None)])
def test_a_click_where_there_is_no_surface_says_so(tab, found):
    tab.found = found
    click(tab, 2, 3)
    tab.panels.note.assert_called_once_with(MISSED)
    tab.change.assert_not_called()
