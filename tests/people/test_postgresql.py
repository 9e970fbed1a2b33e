"""The same people in PostgreSQL: coming in, the table of doors, a log that the database lets nobody change."""

import pytest
from sqlalchemy import text

from app.errors import PersonRefusedError, StorageError
from app.people import People
from app.people.belongings import erase, everything
from app.people.keys import server_key
from app.session import Store
from app.session.owners import Owners
from tests.people.conftest import HERE, PASSWORD, PIN
from tests.people.test_limits import held_at_once
from tests.session.postgresql import schema


@pytest.fixture
def store(postgresql, tmp_path):
    with schema(postgresql) as url:
        store = Store(tmp_path, url)
        yield store
        store.database.close()


def test_people_come_in_are_counted_locked_and_logged_out(store):
    people = People(store.database)
    trainer = people.add("tom", "Tom", "trainer", PASSWORD)
    at = people.classes.make("Monday", trainer.id)
    li = people.join(at.code, "Li Wei", PIN, HERE)
    assert people.join(at.code, "li wei", PIN, HERE) == li and people.may(trainer, "watch", li.owner)
    browser = people.logins.begin(li.id)
    assert people.logins.person(browser) == li.id
    for number in range(10):
        with pytest.raises(PersonRefusedError):
            people.authenticate(li.login, "000001", f"10.0.0.{number}")
    with pytest.raises(PersonRefusedError) as caught:
        people.authenticate(li.login, PIN, HERE)
    assert caught.value.why == "locked"
    people.change(li.id, pin="739105")
    assert people.logins.person(browser) is None and people.authenticate(li.login, "739105", HERE)
    assert server_key(store.database) == server_key(store.database)


@pytest.mark.parametrize("change", ["DELETE FROM audit", "UPDATE audit SET person = ''", "TRUNCATE audit"])
def test_the_database_refuses_to_change_the_log(store, change):
    people = People(store.database)
    people.add("ada", "Ada", "administrator", PASSWORD)
    before = people.audit.read()
    with pytest.raises(StorageError), store.database.begin() as connection:
        connection.execute(text(change))
    assert before and people.audit.read() == before


def test_everything_kept_is_given_and_erased(store):
    people = People(store.database)
    eve = people.add("eve", "Eve", "trainee", PASSWORD)
    session = store.create(robot="ur10e")
    Owners(store.database).give(session.name, eve.owner)
    assert session.name.encode() in everything(people, eve, eve.id)
    assert erase(people, eve, eve.id) == 1 and not store.has(session.name) and people.get(eve.id) is None
    assert people.audit.read(person=eve.id)[0].deed == "erase"


def test_of_many_tries_at_once_no_more_than_the_limit_count(store):
    held_at_once(lambda: store.database)
