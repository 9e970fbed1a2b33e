"""Files somebody sends: kept inside their folder, whatever their names say."""

import pytest

from app.panel.uploads import Upload, safe_folder, safe_name


@pytest.fixture
def sent(tmp_path):
    def make(name, folder="", content=b"content"):
        path = tmp_path / "0"
        path.write_bytes(content)
        return Upload(name, path, folder)

    return make


@pytest.mark.parametrize("name", ["a.csv", "../../a.csv", "/etc/a.csv", "..\\..\\a.csv", "a.csv\0"])
def test_a_name_cannot_lead_out_of_the_folder(sent, tmp_path, name):
    (tmp_path / "in").mkdir()
    path = sent(name).into(tmp_path / "in", "x.csv")
    assert path == tmp_path / "in" / "a.csv"
    assert path.read_bytes() == b"content"


@pytest.mark.parametrize("name", ["", "..", "a/.."])
def test_a_file_without_a_name_gets_one(sent, tmp_path, name):
    assert sent(name).into(tmp_path / "in", "x.csv") == tmp_path / "in" / "x.csv"


@pytest.mark.parametrize("folder", ["arm/meshes", "/arm/meshes", "../arm/./meshes/..", "arm\\meshes"])
def test_folders_are_kept_and_lead_nowhere_else(sent, tmp_path, folder):
    assert sent("a.stl", folder).into(tmp_path / "in", "x").parent == tmp_path / "in" / "arm" / "meshes"
    assert not safe_folder(folder).is_absolute()


def test_names_have_an_end():
    assert len(safe_name("a" * 10_000 + ".csv")) <= 120
