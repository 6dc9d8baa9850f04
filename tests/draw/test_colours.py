"""Colours stay apart for every eye: simulated after Machado, Oliveira and Fernandes (2009), measured in OKLab.

A difference of 0.02 in OKLab is just noticed side by side; lines and areas differ at least five times as much.
"""

import itertools

import numpy as np
import pytest

from plisse.draw import colours
from plisse.draw.colours import opening, quality, rgb
from plisse.io.gltf import linear
from plisse.studio.scene import GLASS, OPEN
from plisse.studio.status import MARKS

EYES = {
    "three cones": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
CONES = np.array([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
                  [0.0883024619, 0.2817188376, 0.6299787005]])
OKLAB = np.array([[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099],
                  [0.0259040371, 0.7827717662, -0.8086757660]])
APART, NOTICED = 0.1, 0.04


def seen(colour, eye):
    """OKLab (…, 3) of sRGB colours (…, 3) as an eye sees them."""
    return np.cbrt(np.clip(linear(colour) @ np.transpose(EYES[eye]), 0, 1) @ CONES.T) @ OKLAB.T


def differences(inks, eye):
    return [np.linalg.norm(seen(rgb(a), eye) - seen(rgb(b), eye)) for a, b in itertools.combinations(inks, 2)]


@pytest.mark.parametrize("eye", EYES)
def test_mountains_valleys_edges_and_paper_stay_apart(eye):
    assert min(differences([colours.MOUNTAIN, colours.VALLEY, colours.PAPER], eye)) > APART
    assert min(differences([colours.EDGE, colours.PAPER], eye)) > APART


@pytest.mark.parametrize("eye", EYES)
def test_covered_and_open_surfaces_stay_apart(eye):
    assert min(differences([GLASS, OPEN, colours.BACKGROUND], eye)) > APART


@pytest.mark.parametrize("eye", EYES)
def test_scales_run_from_light_to_dark_without_turning_back(eye):
    shares = np.linspace(0, 1, 30)
    for found in (quality(shares), opening(shares)[::-1]):
        lightness = seen(found, eye)[:, 0]
        assert (np.diff(lightness) < 0).all()
        assert np.ptp(lightness) > 5 * APART


@pytest.mark.parametrize("eye", EYES)
def test_marks_of_the_status_differ_in_their_sign_and_noticeably_in_colour(eye):
    assert len({sign for sign, _ in MARKS.values()}) == len(MARKS)
    assert min(differences([ink for _, ink in MARKS.values()], eye)) > NOTICED


def test_in_grey_mountains_are_lighter_than_valleys_and_valleys_are_dashed():
    from plisse.studio.look_panel import LINES

    mountain, valley = (seen(rgb(ink), "three cones")[0] for ink in (colours.MOUNTAIN, colours.VALLEY))
    assert mountain - valley > APART
    assert {words: is_dashed for _, is_dashed, words in LINES} == {"mountain": False, "valley": True, "edge": False}


def test_the_simulation_can_tell_what_an_eye_cannot():
    """Red and green of equal brightness, the classical pair."""
    pair = ["#b35c5c", "#6f7d3a"]
    assert differences(pair, "three cones")[0] > APART > differences(pair, "deuteranopia")[0]
