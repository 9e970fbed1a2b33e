"""A backup is whole, moves between databases, and never takes anything's place without being told."""

import sqlite3
import threading
from contextlib import closing

import pytest
from sqlalchemy import select, text

from app.session import Store
from app.session.actions import Move
from app.session.backup import back_up, check, restore
from app.session.database import FILE
from app.session.owners import OWNED, Owners
from app.training.records import Records
from tests.cli.running import assert_one_line, teachframe
from tests.session.postgresql import schema
from tests.session.test_migrations import OWNER, RELEASE, SESSION, released

AT = (0.1, -1.0, 1.0, 0.2, 0.3, 0.4)


@pytest.fixture
def store(tmp_path):
    """What version 0.1.0 left, with a session of now, a name that sorts its own way, and a person."""
    store = Store(released(tmp_path / "data", RELEASE))
    store.create(robot="ur5").do(Move(AT))
    Owners(store.database).rename(SESSION, "Übung – 示教 'x'")
    with store.database.begin() as connection:
        connection.execute(
            text(
                "INSERT INTO people (id, owner, login, name, role, secret, failed, locked_until, created, disabled)"
                " VALUES ('1', 'o', 'a', 'A', 'trainee', '', 0, 0, 1.5, :no)"
            ),
            {"no": False},
        )
        connection.execute(text("INSERT INTO audit (at, person, deed, about) VALUES (1, '1', 'log in', '')"))
    yield store
    store.database.close()


def content(store):
    found = {name: store.export(name) for name in sorted(store.names())}
    with store.database.begin() as connection:
        owned = connection.execute(select(OWNED)).all()
        people = connection.execute(text("SELECT login, disabled, created FROM people")).all()
        audit = connection.execute(text("SELECT id, deed FROM audit")).all()
    return found, owned, [tuple(map(float, row[1:])) for row in people], audit


def test_what_is_put_back_is_what_was_there(store, tmp_path):
    counted = back_up(store.database, tmp_path / "b.sqlite")
    assert (counted["sessions"], counted["people"], counted["scores"]) == (3, 1, 1)
    assert (tmp_path / "b.sqlite").stat().st_mode & 0o777 == 0o600
    other = Store(tmp_path / "other")
    assert restore(tmp_path / "b.sqlite", other.database) == counted
    assert content(other) == content(store)
    assert not [p for p in tmp_path.iterdir() if p.name.startswith(".")]


def test_a_backup_moves_to_postgresql_and_back(store, tmp_path, postgresql):
    back_up(store.database, tmp_path / "1.sqlite")
    with schema(postgresql) as url:
        there = Store(tmp_path / "there", url)
        restore(tmp_path / "1.sqlite", there.database)
        assert content(there) == content(store)
        (card,) = Records(there.database).history(OWNER)
        Records(there.database).add(OWNER, SESSION, card)  # numbers go on behind those that came
        back_up(there.database, tmp_path / "2.sqlite")
        back = Store(tmp_path / "back")
        restore(tmp_path / "2.sqlite", back.database)
        assert content(back) == content(there)
        assert len(Records(back.database).history(OWNER)) == 2
        restore(tmp_path / "1.sqlite", there.database, replace=True)
        assert content(there) == content(store)
        there.database.close()


def test_while_a_session_is_written_the_backup_holds_whole_actions(store, tmp_path):
    session = store.create(robot="ur5")
    stop = threading.Event()

    def write():
        while not stop.is_set():
            session.do(Move(AT))

    writing = threading.Thread(target=write)
    writing.start()
    try:
        for number in range(3):
            back_up(store.database, tmp_path / f"{number}.sqlite")
    finally:
        stop.set()
        writing.join()
    other = Store(tmp_path / "other")
    restore(tmp_path / "2.sqlite", other.database)
    got = other.recorded(session.name).entries
    assert len(got) > 1 and got == session.entries[: len(got)]


def test_nothing_takes_the_place_of_anything_without_being_told(store, tmp_path):
    out, data = tmp_path / "b.sqlite", tmp_path / "data"
    assert teachframe("backup", out, "--data", data).code == 0
    assert_one_line(teachframe("backup", out, "--data", data), "already", "--replace")
    assert teachframe("backup", out, "--data", data, "--replace").code == 0
    before = content(store)
    store.create(robot="ur5")
    assert_one_line(teachframe("restore", out, "--data", data), "not empty", "sessions", "--replace")
    said = teachframe("restore", out, "--data", data, "--replace")
    assert said.code == 0 and "sessions 3" in said.err
    assert content(store) == before
    assert teachframe("restore", out, "--data", tmp_path / "new").code == 0


def test_a_backup_of_an_earlier_version_is_brought_to_this_one(tmp_path):
    released(tmp_path / "old")
    old = tmp_path / "old.sqlite"
    (tmp_path / "old" / FILE).rename(old)
    listed = check_list(old)
    with closing(sqlite3.connect(old)) as raw, raw:
        raw.execute(
            "CREATE TABLE backup_content (name TEXT PRIMARY KEY, rows INTEGER, sha256 TEXT, program TEXT)"
        )
        raw.executemany("INSERT INTO backup_content VALUES (?, ?, ?, '0.1.0')", listed)
    store = Store(tmp_path / "data")
    restore(old, store.database)
    assert Owners(store.database).titles(OWNER) == {SESSION: "Monday's cell"}
    store.database.close()


def check_list(path):
    from app.session.backup import _digest

    with closing(sqlite3.connect(path)) as raw:
        names = [n for (n,) in raw.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        return [(name, *_digest(raw.execute(f"SELECT * FROM {name}"))) for name in names]


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (
            lambda raw: raw.execute("UPDATE actions SET action = replace(action, 'ur5', 'ur6')"),
            "actions is damaged",
        ),
        (lambda raw: raw.execute("DELETE FROM sessions WHERE rowid = 1"), "sessions is damaged"),
        (lambda raw: raw.execute("DROP TABLE scores"), "scores is damaged"),
        (lambda raw: raw.execute("DROP TABLE backup_content"), "no backup"),
        (lambda raw: raw.execute("UPDATE alembic_version SET version_num = '0099'"), "later version"),
    ],
)
def test_a_damaged_or_later_backup_is_refused_and_nothing_is_changed(store, tmp_path, spoil, words):
    out = tmp_path / "b.sqlite"
    back_up(store.database, out)
    with closing(sqlite3.connect(out)) as raw, raw:
        spoil(raw)
    before = content(store)
    assert_one_line(teachframe("restore", out, "--data", tmp_path / "data", "--replace"), words)
    assert content(store) == before


def test_what_is_no_backup_is_one_line(tmp_path):
    text = tmp_path / "x"
    text.write_text("not a database, but long enough to be looked at as one " * 40, encoding="utf-8")
    for path in (text, tmp_path / "none", tmp_path):
        assert_one_line(teachframe("restore", path, "--data", tmp_path / "data"))
    assert not (tmp_path / "data").exists()
    assert_one_line(
        teachframe("backup", tmp_path / "no" / "b", "--data", tmp_path / "data"), "no such folder"
    )


def test_a_half_written_backup_leaves_what_was_there(store, tmp_path, monkeypatch):
    out = tmp_path / "b.sqlite"
    back_up(store.database, out)
    before = out.read_bytes()

    def full(*_args, **_named):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("app.session.backup.check", full)
    said = teachframe("backup", out, "--data", tmp_path / "data", "--replace")
    assert_one_line(said, "No space left")
    assert out.read_bytes() == before and check(out)
