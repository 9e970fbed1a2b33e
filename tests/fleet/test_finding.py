"""Which files are recordings, whose, and when."""

from datetime import UTC, datetime

import pytest

from app.errors import InputError
from app.fleet.finding import arm_of, dated, recordings


def test_a_folder_gives_recordings_and_bags_and_no_notes(tmp_path):
    for name in (
        "b/2.csv",
        "a/1.mcap",
        "a/notes.md",
        "a/1.truth.json",
        ".git/x.csv",
        "bag/metadata.yaml",
        "bag/x.db3",
    ):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.touch()
    assert [str(p.relative_to(tmp_path)) for p in recordings(tmp_path)] == ["a/1.mcap", "b/2.csv", "bag"]


def test_a_list_names_anything_once_relative_to_itself(tmp_path):
    listed = tmp_path / "list.txt"
    listed.write_text("# mine\nx.csv\n\n/y.dat\nx.csv\n", encoding="utf-8")
    assert [str(p) for p in recordings(listed)] == [str(tmp_path / "x.csv"), "/y.dat"]


@pytest.mark.parametrize("content", [b"\x00\x01\x02", b"\xff\xfe\xfd", b""])
def test_what_is_no_list_is_refused(tmp_path, content):
    listed = tmp_path / "list.bin"
    listed.write_bytes(content)
    with pytest.raises(InputError):
        recordings(listed)


def test_when_is_said_by_the_header_then_the_name_then_the_file(tmp_path):
    path = tmp_path / "run_20260302-1405.csv"
    path.touch()

    def when(*parts):
        return datetime(*parts, tzinfo=UTC).timestamp()

    assert dated(path, "2026-01-02T03:04:05+00:00") == (when(2026, 1, 2, 3, 4, 5), "header")
    assert dated(path, "yesterday") == (when(2026, 3, 2, 14, 5), "name")
    plain = tmp_path / "99999999.csv"
    plain.touch()
    assert dated(plain, None) == (plain.stat().st_mtime, "file")


def test_whose_is_the_folder_below_the_root(tmp_path):
    assert arm_of(tmp_path / "hall 2" / "SN-1" / "a.csv", tmp_path) == "hall 2/SN-1"
    assert arm_of(tmp_path / "a.csv", tmp_path) == ""
