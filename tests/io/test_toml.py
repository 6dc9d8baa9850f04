import tomllib

import pytest

from plisse.io.toml import toml_text
from plisse.shipped import shipped_design, shipped_names


@pytest.mark.parametrize("name", shipped_names())
def test_every_shipped_design_reads_back_as_it_was_written(name):
    data = tomllib.loads(shipped_design(name).read_text(encoding="utf-8"))
    assert tomllib.loads(toml_text(data)) == data


def test_awkward_words_numbers_and_keys_survive():
    data = {"words": 'a "b" \\ \n\t \x7f é θ', "small": 1e-300, "whole": -3, "yes": True,
            "table": {"a b": [[1, 2.5], {"c.d": "e"}], "empty": []}}
    text = toml_text(data, comment="two\nlines")
    assert tomllib.loads(text) == data
    assert text.startswith("# two lines\n")
