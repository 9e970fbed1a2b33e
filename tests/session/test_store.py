"""The store: an action is on the disk before it counts, and is found again by whoever asks."""

import sqlite3
from contextlib import contextmanager

import numpy as np
import pytest
from sqlalchemy.dialects import postgresql
from sqlalchemy.schema import CreateTable

from app.errors import ActionRefusedError, FileFormatError, InputError, StorageError, UnknownNameError
from app.session import Store
from app.session.actions import Delete, Move, Record
from app.session.database import FILE, METADATA, Database
from app.session.store import JOURNAL
from tests.session.wizard import wizard_actions


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path)


@pytest.fixture
def taught(store):
    session = store.create(robot="ur10e")
    for action in wizard_actions()[0]:
        session.do(action)
    return session


def test_a_session_opened_again_is_as_it_was_left(store, taught):
    back = store.open(taught.name)
    assert np.array_equal(back.state.result.result.tool_point, taught.state.result.result.tool_point)
    assert back.state.q == taught.state.q and back.state.count == taught.state.count
    assert back.entries == taught.entries


def test_a_refused_action_leaves_state_and_journal_untouched(store, taught):
    state, before = taught.state, store.export(taught.name)
    with pytest.raises(ActionRefusedError):
        taught.do(Record("touch1"))
    assert taught.state is state and store.export(taught.name) == before


def test_sqlite_writes_ahead_and_waits_for_the_disk(store):
    with store.database.begin() as connection:
        assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal"
        assert connection.exec_driver_sql("PRAGMA synchronous").scalar() == 2  # FULL


def test_an_action_that_cannot_be_kept_does_not_count(store, taught):
    with store.database.begin() as connection:
        connection.exec_driver_sql("DROP TABLE actions")
    state = taught.state
    with pytest.raises(StorageError, match="did not keep this"):
        taught.do(Delete("touch1"))
    assert taught.state is state


def test_an_action_whose_confirmation_was_lost_makes_room_for_the_next_one(store, taught, monkeypatch):
    begin, before = store.database.begin, taught.state

    @contextmanager
    def silent():
        with begin() as connection:
            yield connection
        raise StorageError("the connection broke")

    with monkeypatch.context() as broken:
        broken.setattr(store.database, "begin", silent)
        with pytest.raises(StorageError):
            taught.do(Delete("touch1"))
        with pytest.raises(StorageError):  # and once more, over the first
            taught.do(Delete("touch2"))
    assert taught.state is before
    taught.do(Delete("touch3"))
    back = store.open(taught.name)
    assert back.entries == taught.entries and set(back.state.captures) == set(taught.state.captures)


def test_two_writers_of_one_session_cannot_both_have_a_number(store, taught):
    other = store.open(taught.name)
    other.do(Move(other.state.q))
    with pytest.raises(StorageError, match="another program"):
        taught.do(Delete("touch1"))
    assert "touch1" in taught.state.captures


def test_sessions_are_listed_the_newest_first_with_their_arm(store, taught):
    newer = store.create(robot="iiwa7")
    first, second = store.list()
    assert (first.name, first.robot, first.actions) == (newer.name, "iiwa7", 1)
    assert (second.name, second.robot, second.actions) == (taught.name, "ur10e", len(taught.entries))
    assert second.last >= second.created and len(store.list(1)) == 1


def test_only_names_the_store_gave_are_opened(store):
    for name in ("../../etc", "", "a" * 32, "x", "' or 1=1 --"):
        assert not store.has(name)
    with pytest.raises(UnknownNameError):
        store.open("a" * 32)


def test_a_row_that_is_no_action_or_is_missing_is_named(store, taught, tmp_path):
    file = sqlite3.connect(tmp_path / FILE)
    file.execute('update actions set action = \'{"do":"fly"}\' where n = 3')
    file.commit()
    with pytest.raises(FileFormatError, match="row 3"):
        store.open(taught.name)
    file.execute("delete from actions where n = 3")
    file.commit()
    file.close()
    with pytest.raises(FileFormatError, match="action 3 is missing"):
        store.open(taught.name)


def test_journals_of_earlier_versions_are_taken_over_once(tmp_path, store, taught):
    folder = tmp_path / "new" / "sessions"
    for name, content in ((taught.name, store.export(taught.name)), ("b" * 32, b"rubbish\n")):
        (folder / name).mkdir(parents=True)
        (folder / name / JOURNAL).write_bytes(content)
    for _ in range(2):
        new = Store(tmp_path / "new")
        assert new.names() == [taught.name]
        assert new.recorded(taught.name).entries == taught.entries
        new.database.close()


def test_another_database_is_taken_by_its_url(tmp_path):
    url = f"sqlite:///{tmp_path / 'deep' / 'other.db'}"
    name = Store(tmp_path / "data", url).create(robot="ur10e").name
    assert Store(tmp_path / "data", url).has(name) and not Store(tmp_path / "data").has(name)


@pytest.mark.parametrize(
    "url, words",
    [
        ("nonsense", "is no database"),
        ("oracle99://x/y", "oracle99"),
        ("sqlite://", "keeps nothing"),
        ("mysql+pymysql://root:secret@localhost/x", "needs the package pymysql"),
        ("sqlite:////proc/none/x.db", "/proc/none"),
    ],
)
def test_a_database_that_cannot_be_used_is_said_in_one_line_without_its_password(url, words):
    with pytest.raises(InputError, match=words) as caught:
        Database(url)
    assert "\n" not in str(caught.value) and "secret" not in str(caught.value)


def test_the_tables_are_what_postgresql_understands_too():
    for table in METADATA.tables.values():
        assert "CREATE TABLE" in str(CreateTable(table).compile(dialect=postgresql.dialect()))
