"""Malformed designs: one sentence that names the key and the remedy, for every mistake a person can make."""

import copy

import numpy as np
import pytest

from plisse.errors import InvalidDesign
from plisse.io.designs import design_from_dict, parse_assignment, read_design
from plisse.recipe import Points

GOOD = {"curve": {"kind": "arc", "radius": 5}, "pattern": {"creases": 5, "width": 1, "amplitude": 1}}


def changed(**entries):
    data = copy.deepcopy(GOOD)
    for path, value in entries.items():
        *sections, key = path.split("__")
        target = data
        for section in sections:
            target = target.setdefault(section, {})
        target[key] = value
    return data


MISTAKES = {
    "theta of 90 degrees": ({"pattern__theta": 90}, r"pattern\.theta.*90"),
    "negative theta": ({"pattern__theta": -1}, r"pattern\.theta"),
    "theta list of wrong length": ({"pattern__theta": [1, 2]}, r"2 values.*5.*one per crease"),
    "a word among thetas": ({"pattern__theta": [0, 0, "x", 0, 0]}, r"pattern\.theta\[2\]"),
    "half a crease": ({"pattern__creases": 2.5}, r"pattern\.creases.*whole number"),
    "two creases": ({"pattern__creases": 2}, r"pattern\.creases"),
    "a million samples": ({"pattern__samples": 1_000_000}, r"pattern\.samples.*20000"),
    "too many vertices": ({"pattern__samples": 20_000, "pattern__creases": 900}, r"18000000 vertices.*lower"),
    "no width": ({"pattern__width": 0}, r"pattern\.width"),
    "mixed widths": ({"pattern__width": [1, [0, 2], 3, 4]}, r"pattern\.width mixes"),
    "too few widths": ({"pattern__width": [1, 2]}, r"2 values.*4 strips"),
    "a width table backwards": ({"pattern__width": [[0.5, 1], [0.2, 1]]}, r"increasing"),
    "a width outside the curve": ({"pattern__width": [[0, 1], [2, 1]]}, r"position from 0 to 1"),
    "amplitude not a number": ({"pattern__amplitude": float("nan")}, r"pattern\.amplitude is nan"),
    "infinite radius": ({"curve__radius": float("inf")}, r"curve\.radius is inf"),
    "unknown key": ({"pattern__tetha": 3}, r"pattern\.tetha is not a key.*theta"),
    "unknown section": ({"patern": {}}, r"patern is not a key.*pattern"),
    "unknown kind": ({"curve__kind": "circle"}, r"curve\.kind.*arc, helix"),
    "missing radius": ({"curve": {"kind": "arc"}}, r"curve\.radius is missing"),
    "missing kind": ({"curve": {"radius": 3}}, r"curve\.kind is missing"),
    "a section that is a number": ({"pattern": 3}, r"pattern"),
    "units of a race course": ({"units": "furlong"}, r"^units is 'furlong'; give mm, cm, m, in or ft$"),
    "no amplitude": ({"pattern__amplitude": 0}, r"^pattern\.amplitude[^`]*$"),
    "units of a star ship": ({"units": "parsec"}, r"units.*mm, cm, m"),
    "principal as a number": ({"solve__principal": 1}, r"solve\.principal.*true or false"),
    "unknown method": ({"solve__method": "magic"}, r"solve\.method.*exact or paper"),
    "four weights": ({"solve__weights": [1, 2, 3, 4]}, r"solve\.weights.*five"),
    "a cut in an open curve": ({"solve__cut": 50}, r"solve\.cut.*open"),
    "an arc that cannot close": ({"curve__closed": True}, r"curve\.angle.*360"),
    "a helix that closes": ({"curve": {"kind": "helix", "radius": 1, "pitch": 1, "closed": True}}, r"helix never closes"),
    "a knot that runs twice": ({"curve": {"kind": "torus-knot", "p": 2, "q": 4, "R": 3, "r": 1}}, r"common divisor"),
    "a tube too thick": ({"curve": {"kind": "torus-knot", "p": 2, "q": 3, "R": 3, "r": 4}}, r"not smaller"),
    "a spline without points": ({"curve": {"kind": "spline"}}, r"neither"),
    "points and a file": ({"curve": {"kind": "spline", "points": [[0, 0, 0]] * 4, "file": "x.csv"}}, r"both"),
    "two points": ({"curve": {"kind": "spline", "points": [[0, 0, 0], [1, 0, 0]]}}, r"2 points.*at least 3"),
    "flat points": ({"curve": {"kind": "spline", "points": [[0, 0], [1, 0], [2, 1]]}}, r"three coordinates|points"),
    "repeated points": ({"curve": {"kind": "spline", "points": [[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 2, 0]]}},
                        r"points\[1\] and curve\.points\[2\] are the same"),
    "points lost in rounding": ({"curve": {"kind": "spline", "points": [[1e15, k, k * k] for k in range(4)]}}, r"rounding"),
    "a missing file": ({"curve": {"kind": "spline", "file": "nowhere.csv"}}, r"no curve file"),
    "a file of another kind": ({"curve": {"kind": "spline", "file": "curve.docx"}}, r"not a polyline file"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_every_mistake_is_one_sentence_with_the_key_and_the_remedy(mistake):
    entries, expected = MISTAKES[mistake]
    with pytest.raises(InvalidDesign, match=expected) as caught:
        design_from_dict(changed(**entries))
    message = str(caught.value)
    assert "\n" not in message
    assert "Traceback" not in message


def test_a_good_design_keeps_its_defaults_in_the_provenance():
    recipe = design_from_dict(GOOD).to_dict()
    assert recipe["pattern"]["samples"] == 200
    assert recipe["solve"]["method"] == "exact"
    assert recipe["curve"]["kind"] == "arc"
    assert design_from_dict(recipe).to_dict() == recipe


@pytest.mark.parametrize(("text", "says"), [
    ("x,y,z\n0,0,0\n1,nan,0\n2,0,0\n3,1,0\n", "line 3 is '1,nan,0', which is not finite"),
    ("x,y,z\n0,0,0\n1,one,0\n2,0,0\n", "line 3 is '1,one,0'"),
])
def test_bad_rows_are_named_by_their_line_in_the_file(tmp_path, text, says):
    (tmp_path / "points.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InvalidDesign, match=says):
        design_from_dict(changed(curve={"kind": "spline", "file": "points.csv"}), base=tmp_path)


def test_overrides_take_toml_values_and_bare_words(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text('[curve]\nkind = "arc"\nradius = 5\n[pattern]\ncreases = 5\nwidth = 1\namplitude = 1\n')
    design = read_design(path, ["pattern.theta=[1,2,3,4,5]", "units=cm", "solve.principal=true"])
    assert design.pattern.theta == [1, 2, 3, 4, 5]
    assert design.units == "cm"
    assert design.solve.principal


@pytest.mark.parametrize("text", ["theta", "=3", "pattern.=3", ""])
def test_overrides_without_key_or_value_are_refused(text):
    with pytest.raises(InvalidDesign, match=r"section\.key=value"):
        parse_assignment(text)


def test_broken_toml_names_the_line(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text("[curve\n")
    with pytest.raises(InvalidDesign, match="line 1"):
        read_design(path)


def test_binary_junk_is_not_text(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(bytes(range(128, 256)))
    with pytest.raises(InvalidDesign, match="cannot be read"):
        read_design(path)


@pytest.mark.parametrize("suffix", [".csv", ".txt", ".npy", ".obj"])
def test_curve_files_of_every_kind_give_the_same_points(tmp_path, suffix):
    points = np.array([[0, 0, 0.5], [1, 0, 0], [2, 1, 0], [3, 3, 1]])
    path = tmp_path / f"curve{suffix}"
    if suffix == ".npy":
        np.save(path, points)
    elif suffix == ".obj":
        path.write_text("".join("v {} {} {}\n".format(*p) for p in points) + "l 1 2 3 4\n")
    else:
        separator = "," if suffix == ".csv" else " "
        path.write_text("x y z\n" + "\n".join(separator.join(map(str, p)) for p in points))
    recipe = changed(curve={"kind": "spline", "file": path.name})
    assert np.array_equal(design_from_dict(recipe, base=tmp_path).curve.points, points)


def test_rows_of_different_length_are_named(tmp_path):
    (tmp_path / "c.csv").write_text("0,0,0\n1,1\n2,2,2\n")
    with pytest.raises(InvalidDesign, match="different lengths"):
        design_from_dict(changed(curve={"kind": "spline", "file": "c.csv"}), base=tmp_path)


def test_a_curve_that_names_a_file_and_no_kind_is_measured_points(tmp_path):
    np.savetxt(tmp_path / "curve.csv", np.stack([np.arange(9.0), np.arange(9.0) ** 2, np.zeros(9)], axis=1), delimiter=",")
    pattern = {"creases": 4, "width": 1, "amplitude": 0.5}
    found = design_from_dict({"curve": {"file": "curve.csv"}, "pattern": pattern}, base=tmp_path)
    assert isinstance(found.curve, Points)
    assert len(found.curve.points) == 9
