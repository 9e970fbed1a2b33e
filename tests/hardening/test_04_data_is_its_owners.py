"""The data folder and what is in it are for their owner alone."""

import stat

from app.session import Store
from app.session.actions import ChooseRobot
from app.session.database import FILE


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_a_new_data_folder_and_its_files_have_no_rights_for_others(tmp_path):
    store = Store(tmp_path / "data")
    session = store.create(robot="ur10e")
    session.do(ChooseRobot("ur5"))
    assert mode(tmp_path / "data") == 0o700
    files = [p for p in (tmp_path / "data").rglob("*") if p.is_file()]
    assert {p.name for p in files} >= {FILE}
    assert {mode(p) for p in files} == {0o600}


def test_a_data_folder_that_an_earlier_version_left_open_is_closed(tmp_path):
    folder = tmp_path / "data"
    Store(folder).database.close()
    folder.chmod(0o755)
    (folder / FILE).chmod(0o644)
    Store(folder)
    assert mode(folder) == 0o700


def test_a_folder_that_holds_other_things_keeps_its_rights(tmp_path):
    folder = tmp_path / "shared"
    folder.mkdir(mode=0o755)
    folder.chmod(0o755)
    Store(folder)
    assert mode(folder) == 0o755 and mode(folder / FILE) == 0o600
