"""What leaves the server holds no secret by which its owner could be taken for another; nor does the database."""

import sqlite3

import pytest

from app.session import Store
from app.session.database import FILE
from app.session.journal import read_journal
from app.session.owners import Owners, new_secret, owner_of

SECRET = "a secret that only one browser has"


@pytest.fixture
def kept(tmp_path):
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    Owners(store.database).give(session.name, owner_of(SECRET))
    session.close()
    return store, session.name


def test_an_exported_session_holds_neither_the_secret_nor_its_hash(kept):
    store, name = kept
    content = store.export(name)
    assert SECRET.encode() not in content and owner_of(SECRET).encode() not in content


def test_the_database_holds_the_secret_only_hashed(kept):
    store, _ = kept
    with sqlite3.connect(store.folder / FILE) as database:
        dump = "\n".join(database.iterdump())
    assert SECRET not in dump and owner_of(SECRET) in dump
    assert owner_of(SECRET) != SECRET and len(owner_of(SECRET)) >= 32


def test_a_person_is_listed_his_own_sessions_and_nobody_elses(kept):
    store, name = kept
    owners = Owners(store.database)
    assert name in owners.titles(owner_of(SECRET))
    assert not owners.titles(owner_of(new_secret()))


def test_who_takes_an_exported_session_in_owns_a_copy_and_not_the_session(kept, tmp_path):
    store, name = kept
    (tmp_path / "s.jsonl").write_bytes(store.export(name))
    copy = store.take(read_journal(tmp_path / "s.jsonl"))
    stranger = owner_of("another browser")
    Owners(store.database).give(copy, stranger)
    assert Owners(store.database).latest(owner_of(SECRET)) == name
    assert name not in Owners(store.database).titles(stranger)


def test_secrets_are_not_guessed():
    made = {new_secret() for _ in range(100)}
    assert len(made) == 100 and min(map(len, made)) >= 32
