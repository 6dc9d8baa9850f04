import pytest

from plisse.errors import MissingExtra
from plisse.extras import optional


def test_an_installed_library_comes_back():
    assert optional("json", extra="cad", purpose="Anything").dumps([]) == "[]"


def test_a_missing_one_is_a_sentence_with_the_command_that_installs_it():
    with pytest.raises(MissingExtra, match=r'3DM files need rhino9dm.*pip install "plisse\[cad\]"') as caught:
        optional("rhino9dm", extra="cad", purpose="3DM files")
    assert isinstance(caught.value, ImportError) and "\n" not in str(caught.value)


def test_a_fault_inside_the_library_is_not_taken_for_its_absence(tmp_path, monkeypatch):
    (tmp_path / "half_installed.py").write_text("import surely_not_here_either\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="surely_not_here_either"):
        optional("half_installed", extra="cad", purpose="Files")
