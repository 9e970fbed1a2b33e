"""Files somebody sends: kept inside their folder, and refused in words where they are too large."""

from types import SimpleNamespace

import pytest

from app.pendant.texts import text
from app.pendant.uploads import put


def _pendant(said):
    return SimpleNamespace(
        t=lambda key, **fields: text(key, **fields), say=lambda level, words: said.append((level, words))
    )


@pytest.mark.parametrize("name", ["a.csv", "../../a.csv", "/etc/a.csv"])
def test_a_name_cannot_lead_out_of_the_folder(tmp_path, name):
    path = put(_pendant([]), tmp_path, name, b"content", otherwise="x.csv", most=100)
    assert path == tmp_path / "a.csv"
    assert path.read_bytes() == b"content"


def test_a_file_without_a_name_gets_one(tmp_path):
    assert put(_pendant([]), tmp_path, "", b"1", otherwise="x.csv", most=100) == tmp_path / "x.csv"


def test_a_file_that_is_too_large_is_refused_in_words_and_not_written(tmp_path):
    said = []
    assert put(_pendant(said), tmp_path, "big.csv", b"12345", otherwise="x.csv", most=4) is None
    assert said == [("warning", "big.csv is too large to be taken in.")]
    assert not list(tmp_path.iterdir())
