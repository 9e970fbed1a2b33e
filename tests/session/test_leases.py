"""A session is written by one process at a time, whoever dies, sleeps or comes second; no clock is asked."""

import os
import subprocess
import sys
import threading
import time

import pytest
from sqlalchemy import text

from app.errors import ConflictError, StorageError
from app.session import Store, leases
from app.session.actions import Move
from app.session.leases import Leases
from tests.desk import until
from tests.session.postgresql import schema

AT = (0.1, -1.0, 1.0, 0.2, 0.3, 0.4)


@pytest.fixture(params=["sqlite", "postgresql"])
def stores(request, tmp_path):
    """Two processes' views of one database."""
    if request.param == "sqlite":
        yield Store(tmp_path), Store(tmp_path)
        return
    with schema(request.getfixturevalue("postgresql")) as url:
        both = Store(tmp_path, url), Store(tmp_path, url)
        yield both
        for store in both:
            store.database.close()


def holder(store):
    """Leases whose process another one cannot look up, as one of another machine's."""
    held = Leases(store.database)
    held.me = f"elsewhere/1 {held.me.partition(' ')[2]}"
    return held


def test_who_holds_a_session_writes_it_and_nobody_else(stores):
    first, second = (holder(store) for store in stores)
    mine = stores[0].create(robot="ur5", leases=first)
    mine.do(Move(AT))
    with pytest.raises(StorageError, match="elsewhere"):
        stores[1].open(mine.name, leases=second).do(Move(AT))
    mine.do(Move(AT))
    assert len(stores[1].recorded(mine.name).entries) == 3


def test_a_holder_that_is_alive_lets_go_when_it_sees_that_it_is_wanted(stores):
    first, second = (holder(store) for store in stores)
    mine = stores[0].create(robot="ur5", leases=first)
    ending = threading.Event()

    def beats():
        while not ending.wait(0.1):
            _, wanted = first.beat()
            for name in wanted:
                first.let(name)

    beating = threading.Thread(target=beats)
    beating.start()
    begun = time.monotonic()
    second.take(mine.name)
    ending.set()
    beating.join()
    assert time.monotonic() - begun < leases.STILL
    stores[1].open(mine.name, leases=second).do(Move(AT))
    with pytest.raises(StorageError):
        mine.do(Move(AT))
    assert mine.name not in first.beat()[0]


def test_a_holder_that_stands_still_loses_it_within_seconds(stores):
    first, second = (holder(store) for store in stores)
    mine = stores[0].create(robot="ur5", leases=first)
    begun = time.monotonic()
    second.take(mine.name)
    assert leases.STILL <= time.monotonic() - begun < 5.0
    with pytest.raises(StorageError):
        mine.do(Move(AT))


def test_a_holder_that_beats_and_does_not_let_go_keeps_it(stores, monkeypatch):
    monkeypatch.setattr(leases, "_PATIENCE", 1.5)
    monkeypatch.setattr(leases, "STILL", 0.6)
    first, second = (holder(store) for store in stores)
    mine = stores[0].create(robot="ur5", leases=first)
    ending = threading.Event()
    beating = threading.Thread(target=lambda: [first.beat() for _ in iter(lambda: ending.wait(0.2), True)])
    beating.start()
    try:
        with pytest.raises(StorageError, match="open elsewhere"):
            second.take(mine.name)
    finally:
        ending.set()
        beating.join()
    mine.do(Move(AT))


def test_of_several_that_want_a_dead_holders_session_one_gets_it(stores, monkeypatch):
    monkeypatch.setattr(leases, "_PATIENCE", 1.5 * leases.STILL)  # who got it does not beat here
    mine = stores[0].create(robot="ur5", leases=holder(stores[0]))
    wanting = [holder(store) for store in (*stores, *stores)]
    took, refused = [], []

    def want(one):
        try:
            one.take(mine.name)
            took.append(one)
        except StorageError:
            refused.append(one)

    threads = [threading.Thread(target=want, args=(one,)) for one in wanting]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(took) == 1 and len(refused) == 3


def test_what_a_killed_process_of_this_machine_held_is_taken_at_once(tmp_path):
    store = Store(tmp_path)
    code = (
        "import sys, time; from pathlib import Path; from app.session import Store;"
        "from app.session.leases import Leases;"
        f"s = Store(Path({str(tmp_path)!r}));"
        "print(s.create(robot='ur5', leases=Leases(s.database)).name, flush=True); time.sleep(60)"
    )
    other = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    name = other.stdout.readline().strip()
    mine = Leases(store.database)
    other.kill()
    other.wait()
    other.stdout.close()
    begun = time.monotonic()
    mine.take(name)
    assert time.monotonic() - begun < 1.0
    store.open(name, leases=mine).do(Move(AT))


def test_a_process_of_this_machine_that_lives_is_not_taken_for_gone():
    mine = f"{leases._host()} {os.getpid()} {leases._began(os.getpid())} x"
    assert not leases._is_gone(mine)
    assert leases._is_gone(f"{leases._host()} {os.getpid()} 1 x")  # another process has its number now
    assert not leases._is_gone(f"elsewhere/1 {os.getpid()} 1 x")


def test_a_clock_that_is_set_back_changes_nothing(stores, monkeypatch):
    first, second = (holder(store) for store in stores)
    mine = stores[0].create(robot="ur5", leases=first)
    monkeypatch.setattr(time, "time", lambda: 1e9)  # the year 2001
    mine.do(Move(AT))
    second.take(mine.name)
    later = stores[1].open(mine.name, leases=second)
    later.do(Move(AT))
    assert [entry.n for entry in stores[0].recorded(mine.name).entries] == [1, 2, 3]
    assert tuple(later.state.q) == pytest.approx(AT)


def test_a_deleted_session_is_held_by_nobody(stores):
    held = holder(stores[0])
    mine = stores[0].create(robot="ur5", leases=held)
    stores[1].delete(mine.name)
    with pytest.raises(StorageError):
        mine.do(Move(AT))
    with stores[0].database.begin() as connection:
        assert connection.execute(text("SELECT count(*) FROM leases")).scalar() == 0
        assert connection.execute(text("SELECT count(*) FROM actions")).scalar() == 0


def test_those_who_come_from_a_killed_process_share_a_commit(tmp_path):
    """Each asked SQLite for its lock himself: beside three other processes some did not get it in five seconds."""
    store = Store(tmp_path)
    gone, mine = Leases(store.database), Leases(store.database)
    gone.me = f"{leases._host()} {os.getpid()} 1 x"  # another process has its number now
    names = [store.create(robot="ur5", leases=gone).name for _ in range(6)]
    together = store.database._together
    with together._turn:
        threads = [threading.Thread(target=mine.take, args=(name,)) for name in names]
        for thread in threads:
            thread.start()
        until(lambda: len(together._waiting) == len(names), "all to wait for one commit", 20.0)
    for thread in threads:
        thread.join()
    assert mine.beat()[0] == set(names)


def test_of_two_that_wait_for_each_others_rows_one_is_told_so_and_both_are_kept(request, tmp_path):
    """Sessions that are wanted in opposite orders by two processes that share commits (PostgreSQL locks rows)."""
    with schema(request.getfixturevalue("postgresql")) as url:
        stores = [Store(tmp_path, url), Store(tmp_path, url)]
        gone = holder(stores[0])
        names = [stores[0].create(robot="ur5", leases=gone).name for _ in range(2)]
        both, conflicts = threading.Barrier(2), []

        def update(connection, name):
            change = "UPDATE leases SET beat = beat + 1 WHERE session = :name"
            connection.execute(text(change), {"name": name})

        def wanted(store, order):
            first, second = order
            try:
                with store.database.begin() as connection:
                    update(connection, first)
                    both.wait(20.0)
                    update(connection, second)
            except ConflictError:
                conflicts.append(store)
                # As jobs of a shared commit, each alone: who asks for both again may meet the same.
                for name in order:
                    store.database.write(lambda connection, name=name: update(connection, name))

        threads = [
            threading.Thread(target=wanted, args=(store, order))
            for store, order in zip(stores, (names, names[::-1]), strict=True)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(conflicts) == 1
        with stores[0].database.begin() as connection:
            assert set(connection.execute(text("SELECT beat FROM leases")).scalars()) == {2}
        for store in stores:
            store.database.close()
