"""Layouts to choose from say what their order is by."""

import re

from plisse.io.designs import design_from_dict
from plisse.studio.candidates import candidates_of


def test_every_layout_says_how_much_it_covers_and_how_near_it_lies():
    saddle = design_from_dict({"surface": {"height": "0.0008*x*x - 0.0006*y*y", "x": [-60, 60], "y": [-40, 40]},
                               "pattern": {"width": 6}})
    choices = candidates_of(saddle, 2, lambda *_: None)
    assert choices
    for number, choice in enumerate(choices, 1):
        said = re.match(rf"Layout {number}: (\d+\.\d) % covered, (\d+\.\d\d) amplitudes away", choice.words)
        covered, away = map(float, said.groups())
        assert 50 < covered <= 100
        assert 0 < away < 3
