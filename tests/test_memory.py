"""The memory of a design is known before it is solved, and designs that do not fit are refused at once."""

import subprocess
import sys
from pathlib import Path

import pytest

from plisse.errors import InvalidDesign
from plisse.io.designs import checked_design
from plisse.memory import CHOSEN, available_bytes, peak_bytes, refuse_too_large

HELIX = '[curve]\nkind = "helix"\nradius = 100\npitch = 110\nturns = 1.1\n' \
        "[pattern]\ntheta = 30\ncreases = {}\nsamples = {}\nwidth = {}\namplitude = {}\n"
# VmHWM and not ru_maxrss, which a child inherits from the process it was forked from
MEASURED = "import re, sys, plisse\nplisse.design(sys.argv[1])\n" \
           "print(1024 * int(re.search(r'VmHWM:\\s*(\\d+)', open('/proc/self/status').read())[1]))"


def helix(creases, samples):
    return HELIX.format(creases, samples, 66 / (creases - 1), 50 / (creases - 1))


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the peak is read from /proc, which Linux has")
@pytest.mark.parametrize(("creases", "samples"), [(12, 242), (60, 60), pytest.param(50, 2000, marks=pytest.mark.slow)])
def test_the_estimate_is_within_a_factor_of_two(tmp_path, creases, samples):
    (tmp_path / "helix.toml").write_text(helix(creases, samples))
    peak = int(subprocess.run([sys.executable, "-c", MEASURED, str(tmp_path / "helix.toml")], capture_output=True,
                              text=True, check=True).stdout)
    assert 0.5 < peak_bytes(creases * samples, min(creases, samples)) / peak < 2


def test_more_vertices_and_wider_bands_need_more():
    plain = peak_bytes(10_000, 20)
    assert peak_bytes(20_000, 20) > plain and peak_bytes(10_000, 40) > plain
    assert peak_bytes(10_000, 20, principal=True) > plain and peak_bytes(10_000, 20, closed=True) > plain


def test_a_limit_counts_where_it_is_below_what_is_free(monkeypatch):
    monkeypatch.setenv(CHOSEN, "0.001")
    assert available_bytes() == 1e6
    monkeypatch.setenv(CHOSEN, "1e9")
    assert available_bytes() < 1e15
    monkeypatch.delenv(CHOSEN)
    with pytest.raises(InvalidDesign, match=r"all of them need about 1e\+09 GB of memory.* free only .*; take less"):
        refuse_too_large(1e18, "all of them", "take less")


@pytest.mark.parametrize("design", [
    {"curve": {"kind": "arc", "radius": 100, "angle": 60}, "pattern": {"creases": 100, "samples": 1000, "width": 1,
                                                                     "amplitude": 0.5}},
    {"curve": {"kind": "arc", "radius": 100, "angle": 60}, "march": {"creases": 100, "samples": 1001, "distance": 0.1,
                                                                   "fold": 90}},
    {"surface": {"kind": "asymptotic", "formula": "x*y/100"}, "pattern": {"creases": 40, "columns": 400}},
])
def test_every_kind_of_design_is_refused_beyond_the_limit(monkeypatch, design):
    monkeypatch.setenv(CHOSEN, "0.2")
    with pytest.raises(InvalidDesign, match=r"need about .* GB of memory, but the limit is 0\.2 GB; lower"):
        checked_design(design)


@pytest.mark.parametrize(("size", "options"), [((1000, 20000), ()), ((120, 2000), ("--memory", "0.3"))])
def test_absurd_sizes_are_refused_before_anything_is_solved(tmp_path, size, options):
    (tmp_path / "helix.toml").write_text(helix(*size))
    done = subprocess.run([sys.executable, "-m", "plisse", "make", "helix.toml", *options], cwd=tmp_path,
                          capture_output=True, text=True)
    assert done.returncode == 1 and done.stderr.count("\n") == 1 and "lower pattern." in done.stderr
    assert [file.name for file in tmp_path.iterdir()] == ["helix.toml"]
