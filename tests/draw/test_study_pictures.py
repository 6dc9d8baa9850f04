"""Small pictures, contact sheets and maps of studies."""

from collections import Counter
from io import BytesIO

import numpy as np
from PIL import Image

from plisse.draw.contact_sheet import Frame, write_contact_sheet
from plisse.draw.region import places, write_region
from plisse.draw.thumbnail import THUMBNAIL, thumbnail
from plisse.structure.pleated import PleatedStructure


def pixels(png):
    with Image.open(BytesIO(png)) as image:
        return np.asarray(image.convert("RGBA"))


def test_a_thumbnail_shows_the_whole_shape_on_transparent_ground(cones):
    picture = pixels(thumbnail(cones))
    assert picture.shape == (THUMBNAIL[1], THUMBNAIL[0], 4)
    covered = picture[..., 3] > 0
    assert 0.05 < covered.mean() < 0.9
    assert not covered[[0, -1]].any() and not covered[:, [0, -1]].any()


def test_a_thumbnail_does_not_depend_on_size_or_place(cones):
    larger = PleatedStructure(cones.topology, 64 * cones.vertices + 1024)
    difference = pixels(thumbnail(cones)).astype(int) - pixels(thumbnail(larger))
    assert (np.abs(difference).max(axis=-1) > 8).mean() < 0.01  # pixels on edges may fall to the other side


def test_equal_frames_give_equal_pages_and_missing_pictures_leave_a_gap(tmp_path, cones):
    frames = [Frame(thumbnail(cones), "theta = 20", "exact", "exact"),
              Frame(None, "theta = 80", "infeasible: shut", "infeasible")]
    for name in ("a.png", "b.png"):
        write_contact_sheet(frames, tmp_path / name, title="two")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_designs_at_one_place_share_it():
    found = places([(None, 1, 2, "exact"), (None, 1, 2, "timeout"), (None, 1, 3, "exact"), (None, True, 2, "exact")])
    assert [place.counts for place in found] == [Counter(exact=1, timeout=1), Counter(exact=1), Counter(exact=1)]


def test_a_map_takes_numbers_words_lists_and_panels(tmp_path):
    designs = [(panel, kind, width, outcome) for panel in (1, 2) for kind in ("arc", "helix")
               for width, outcome in ((4, "exact"), ([4, 5], "infeasible"))]
    write_region(places(designs), tmp_path / "map.png", labels=("curve.kind", "pattern.width"), panels="pattern.theta",
                 outcomes=("exact", "infeasible"))
    with Image.open(tmp_path / "map.png") as image:
        colours = {colour for _, colour in image.convert("RGB").getcolors(1 << 20)}
    assert {(0x4f, 0x7f, 0x52), (0xb8, 0x43, 0x2f)} <= colours


def test_names_are_drawn_as_they_are(tmp_path):
    name = "a$\\frac$b \u7814\u7a76"
    write_region(places([(name, name, 1, "exact"), (name, name, 2, "exact")]), tmp_path / "map.png", labels=(name, name),
                 panels=name, outcomes=("exact",), title=name)
    write_contact_sheet([Frame(None, name, name, "exact")], tmp_path / "sheet.png", title=name)
    assert (tmp_path / "map.png").stat().st_size > 1000 < (tmp_path / "sheet.png").stat().st_size
