"""What notebooks and matplotlib show."""

import base64
import io
import re
import subprocess
import sys

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

import plisse
from plisse.errors import InvalidStructure


@pytest.fixture(scope="module")
def result():
    return plisse.design({"curve": {"kind": "arc", "radius": 100, "angle": 60},
                          "pattern": {"theta": 20, "creases": 5, "width": 6, "amplitude": 3, "samples": 31}})


def test_a_result_shows_status_numbers_and_a_picture(result):
    html = result._repr_html_()
    assert ">exact<" in html and "planarity" in html
    data = base64.b64decode(re.search(r'base64,([^"]+)"', html)[1])
    assert Image.open(io.BytesIO(data)).size == (720, 480)
    assert len(html) < 600_000


def test_a_structure_shows_itself_with_or_without_sheet(cones):
    assert "in one piece" in cones._repr_html_()
    assert "none yet" in cones.with_vertices(cones.vertices)._repr_html_()


def test_axes_decide_between_folded_and_flat(result):
    figure = Figure()
    space, plane = figure.add_subplot(121, projection="3d"), figure.add_subplot(122)
    assert result.plot(space) is space and result.structure.plot(plane) is plane
    assert len(space.collections[0].get_facecolor()) == result.structure.topology.face_count
    size = np.ptp(plane.dataLim.get_points(), axis=0)
    assert sorted(size) == pytest.approx(sorted(result.report.development.size_mm), rel=1e-6)
    with pytest.raises(InvalidStructure, match="plane axes"):
        result.plot(space, flat=True)


def test_without_axes_a_figure_is_made():
    """In a process of its own, for pyplot is a state that other tests must not find."""
    code = ("import matplotlib; matplotlib.use('Agg'); import plisse; "
            "s = plisse.design({'closed_form': {'kind': 'miura'}}).structure; print(s.plot().name, s.plot(flat=True).name)")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.stdout.split() == ["3d", "rectilinear"], done.stderr
