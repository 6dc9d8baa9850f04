"""Colour maps: one table gives names to all who offer them."""

from typing import get_args, get_type_hints

from plisse.cli.render import render
from plisse.draw.colour_maps import MAPS, NAMES, colour_maps


def test_every_entry_makes_a_map_of_its_own_name_with_a_value_at_every_corner(cones):
    maps = colour_maps(cones)
    assert list(maps) == list(MAPS)
    assert all(found.name == name for name, found in maps.items())
    assert all(found.values.shape == cones.topology.corners.vertex.shape for found in maps.values())


def test_the_words_of_a_button_are_the_title_up_to_its_colon(cones):
    assert [found.label for found in colour_maps(cones).values()] == [
        "planarity", "angle sum", "principal defect", "opening angle of creases"]


def test_the_command_offers_all_names():
    assert get_args(get_type_hints(render)["colour"]) == ("paper", *NAMES)
