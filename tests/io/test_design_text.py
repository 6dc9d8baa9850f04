"""Designs written as TOML read back as the same designs."""

import tomllib

import pytest

from plisse.io.design_text import design_text
from plisse.io.designs import design_from_dict, read_design
from plisse.shipped import shipped_design, shipped_names


@pytest.mark.parametrize("name", shipped_names())
def test_every_shipped_design_survives_the_way_through_toml(name):
    recipe = read_design(shipped_design(name))
    text = design_text(recipe, title="a title\nof two lines")
    assert design_from_dict(tomllib.loads(text)) == recipe
    assert design_text(design_from_dict(tomllib.loads(text)), title="a title of two lines") == text


def test_defaults_are_left_out():
    text = design_text(read_design(shipped_design("fig01d")))
    assert "iterations" not in text
    assert "samples = 242" in text
