"""Databases that are damaged, locked, full, older or newer: one line to the person, what was confirmed stays."""

import sqlite3
import subprocess
import sys
import textwrap
import time

import pytest

from app.cli import run
from app.errors import InputError, StorageError
from app.session import Store
from app.session.actions import ChooseMode, ChooseRobot
from app.session.database import FILE

AT_ONCE = 8.0  # seconds; the database is given 5 to let go


@pytest.fixture
def kept(tmp_path):
    """A data folder with one session of many actions, closed."""
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    for count in range(3, 40):
        session.do(ChooseMode("touch", 3 + count % 4))
    session.close()
    store.database.close()
    with sqlite3.connect(tmp_path / FILE) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.close()
    return tmp_path


def refused(folder, capsys):
    assert run(["sessions", "--data", str(folder)]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1 and str(folder) in said.err
    return said.err


def test_a_damaged_page_is_told_before_anybody_works_on_it(kept, capsys):
    path = kept / FILE
    data = bytearray(path.read_bytes())
    for page in range(1, len(data) // 4096):
        data[page * 4096 : page * 4096 + 200] = b"\xa5" * 200
    path.write_bytes(bytes(data))
    assert "damaged" in refused(kept, capsys)
    assert path.read_bytes() == bytes(data)


@pytest.mark.parametrize(
    "content", [b"not a database, not at all" * 400, b"SQLite format 3\0" + b"\xff" * 5000]
)
def test_a_file_that_is_no_database_is_refused_and_left_as_it_is(content, tmp_path, capsys):
    (tmp_path / FILE).write_bytes(content)
    assert "damaged" in refused(tmp_path, capsys)
    assert (tmp_path / FILE).read_bytes() == content


def test_a_database_of_a_later_version_is_not_touched(kept, capsys):
    with sqlite3.connect(kept / FILE) as connection:
        connection.execute("PRAGMA user_version = 99")
    connection.close()
    assert "later version" in refused(kept, capsys)


def test_a_database_of_an_earlier_version_is_taken_over(kept, capsys):
    with sqlite3.connect(kept / FILE) as connection:
        connection.execute("PRAGMA user_version = 0")
    connection.close()
    assert run(["sessions", "--data", str(kept)]) == 0
    assert "ur10e" in capsys.readouterr().out


def test_a_locked_database_is_told_within_seconds_and_works_when_it_is_free(kept):
    other = sqlite3.connect(kept / FILE, isolation_level=None)
    other.execute("PRAGMA journal_mode=DELETE")
    other.execute("BEGIN EXCLUSIVE")
    begun = time.monotonic()
    with pytest.raises(InputError, match="locked"):
        Store(kept)
    assert time.monotonic() - begun < AT_ONCE
    other.execute("ROLLBACK")
    other.close()
    assert len(Store(kept).names()) == 1


def test_an_action_on_a_locked_database_is_refused_and_done_later(kept):
    store = Store(kept)
    session = store.open(store.names()[0])
    before = len(session.entries)
    other = sqlite3.connect(kept / FILE, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    with pytest.raises(StorageError, match="locked"):
        session.do(ChooseRobot("ur5"))
    assert session.state.robot == "ur10e" and len(session.entries) == before
    other.execute("ROLLBACK")
    other.close()
    session.do(ChooseRobot("ur5"))
    assert Store(kept).state(session.name).robot == "ur5"


def test_on_a_full_disk_what_was_confirmed_stays_and_work_goes_on_when_there_is_room(tmp_path):
    """A limit on the size of files stands for a disk that is full: writing fails in the same way."""
    script = textwrap.dedent(
        f"""
        import resource, signal
        from app.errors import StorageError
        from app.session import Store
        from app.session.actions import ChooseMode
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        store = Store(__import__("pathlib").Path({str(tmp_path)!r}))
        session = store.create(robot="ur10e")
        folder = __import__("pathlib").Path({str(tmp_path)!r})
        room = max(file.stat().st_size for file in folder.iterdir()) + 100_000
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, resource.RLIM_INFINITY))
        failed = 0
        for n in range(400):
            try:
                session.do(ChooseMode("touch", 3 + n % 4))
            except StorageError as error:
                failed += 1
                assert "\\n" not in str(error)
                if failed == 3:
                    break
        assert failed == 3, failed
        confirmed = len(session.entries)
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        session.do(ChooseMode("touch", 6))
        print(session.name, confirmed + 1)
        """
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    name, confirmed = done.stdout.split()
    recorded = Store(tmp_path).recorded(name)
    assert len(recorded.entries) == int(confirmed) > 5


def test_a_clock_that_is_set_back_changes_no_order(tmp_path, monkeypatch):
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    times = iter(range(2_000_000_000, 1_000_000_000, -100_000_000))
    monkeypatch.setattr("app.session.store.time.time", lambda: float(next(times)))
    for touches in (3, 4, 5):
        session.do(ChooseMode("touch", touches))
    monkeypatch.undo()
    assert Store(tmp_path).state(session.name).touches == 5


def test_two_programs_on_one_session_do_not_both_have_the_same_action(kept):
    first, second = Store(kept), Store(kept)
    name = first.names()[0]
    one, two = first.open(name), second.open(name)
    one.do(ChooseRobot("ur5"))
    with pytest.raises(StorageError, match="another program"):
        two.do(ChooseRobot("iiwa7"))
    assert Store(kept).state(name).robot == "ur5"


@pytest.mark.parametrize("folder", ["/dev/null/x", "/proc/nothing"])
def test_a_folder_that_cannot_be_made_is_told_in_one_line(folder, capsys):
    assert run(["sessions", "--data", folder]) == 2
    assert capsys.readouterr().err.count("\n") == 1
