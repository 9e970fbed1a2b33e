"""How much a person may do: counted, run off, refused beyond."""

import time
from concurrent.futures import ThreadPoolExecutor

from sqlalchemy import select

from app.people.bulk import Bulk
from app.people.limits import SESSIONS, Limit
from app.people.meter import Meter
from app.people.tables import TRIES
from app.people.tries import Tries
from app.session import Store
from app.session.owners import Owners


def test_what_is_too_much_is_refused_and_fits_again_later(monkeypatch):
    now = time.monotonic()
    monkeypatch.setattr("app.people.meter.time.monotonic", lambda: now)
    meter = Meter(Limit(10, 5.0))
    assert [meter.count("a") for _ in range(12)] == [True] * 10 + [False] * 2
    assert meter.count("b", 10.0) and not meter.count("b", 0.5)
    now += 1.0
    assert [meter.count("a") for _ in range(3)] == [True, True, False]


def test_a_meter_forgets_whom_it_has_not_seen_for_longest(monkeypatch):
    monkeypatch.setattr("app.people.meter._REMEMBERED", 3)
    meter = Meter(Limit(1, 1e9))
    assert all(meter.count(key) for key in "abcd")
    assert len(meter._used) == 3 and not meter.count("d")


def test_what_a_person_keeps_is_counted(tmp_path):
    store = Store(tmp_path)
    owners = Owners(store.database)
    assert owners.used("one") == (0, 0)
    for owner in ("one", "one", "two"):
        session = store.create(robot="ur10e")
        owners.give(session.name, owner)
        session.close()
    sessions, size = owners.used("one")
    assert sessions == 2 and 20 < size < 500 and sessions < SESSIONS


def test_two_processes_that_share_a_database_count_together(tmp_path):
    one, two = (Tries(Store(tmp_path).database) for _ in range(2))
    limit = Limit(5, 60.0)
    counted = [tries.count(limit, "login", "ada") for tries in (one, two) * 4]
    assert counted == [True] * 5 + [False] * 3
    assert one.count(limit, "login", "bo") and not two.count(limit, "login", "bo", amount=5)


def test_of_many_tries_at_once_no_more_than_the_limit_count(tmp_path):
    held_at_once(lambda: Store(tmp_path).database)


def held_at_once(database):
    """Sixteen tries at the same moment, each by a connection pool of its own."""
    everybody = [Tries(database()) for _ in range(16)]
    with ThreadPoolExecutor(len(everybody)) as pool:
        counted = list(pool.map(lambda tries: tries.count(Limit(5, 60.0), "login", "ada"), everybody))
    assert sum(counted) == 5


def test_what_is_older_than_any_limit_is_taken_away(tmp_path, monkeypatch):
    database = Store(tmp_path).database
    tries, now, passed = Tries(database), time.time(), time.monotonic()
    assert tries.count(Limit(5, 60.0), "login", "somebody who never comes back")
    monkeypatch.setattr("app.people.tries.time.time", lambda: now + 7200.0)
    monkeypatch.setattr("app.people.tries.time.monotonic", lambda: passed + 7200.0)
    assert tries.count(Limit(5, 60.0), "login", "ada")
    with database.begin() as connection:
        assert len(connection.execute(select(TRIES)).all()) == 1


def test_bytes_are_counted_over_two_processes_to_the_piece(tmp_path):
    one, two = (Bulk(Tries(Store(tmp_path).database), Limit(100, 60.0), piece=10) for _ in range(2))
    assert one.count("ada", 49) and two.count("ada", 49)
    assert one.count("ada", 1) and two.count("ada", 1), "these fill a piece each"
    assert not one.count("ada", 10) and not two.count("ada", 10)
    assert one.count("ada", 9), "less than a piece more in each"
    assert one.count("bo", 100) and not two.count("bo", 10)
