"""Writes of a process that wait for the disk share a commit; what may not be kept takes nobody else's with it."""

import threading
from contextlib import contextmanager

import pytest
from sqlalchemy import func, insert, select

from app.errors import ConflictError, StorageError
from app.session import Store
from app.session.database import SESSIONS
from app.session.together import Together
from tests.desk import until


@pytest.fixture
def database(tmp_path):
    return Store(tmp_path).database


def row(name):
    def write(connection):
        connection.execute(insert(SESSIONS), {"name": name, "created": 0.0})

    return write


def kept(database):
    with database.begin() as connection:
        return connection.execute(select(func.count()).select_from(SESSIONS)).scalar()


def at_once(database, jobs):
    """Writes while another holds the turn; what each raised, and how many transactions there were."""
    begin, count = database.begin, []
    raised: list[StorageError | None] = [None] * len(jobs)

    @contextmanager
    def counted():
        count.append(1)
        with begin() as connection:
            yield connection

    def one(number):
        try:
            database.write(jobs[number])
        except StorageError as error:
            raised[number] = error

    together = database._together
    database.begin = counted
    try:
        with together._turn:
            threads = [threading.Thread(target=one, args=(number,)) for number in range(len(jobs))]
            for thread in threads:
                thread.start()
            until(lambda: len(together._waiting) == len(jobs), "all of them")
        for thread in threads:
            thread.join()
    finally:
        del database.begin
    return raised, len(count)


def test_those_who_wait_share_a_commit(database):
    before = kept(database)
    raised, commits = at_once(database, [row(f"{number:032x}") for number in range(9)])
    assert raised == [None] * 9 and commits == 1 and kept(database) == before + 9


def test_one_that_conflicts_is_told_and_the_others_are_kept(database):
    database.write(row("a" * 32))
    before = kept(database)
    raised, _ = at_once(database, [row("b" * 32), row("a" * 32), row("c" * 32)])
    assert [type(error) for error in raised] == [type(None), ConflictError, type(None)]
    assert kept(database) == before + 2


def test_a_disk_that_takes_nothing_is_told_to_all(database):
    before = kept(database)

    def full(_):
        raise StorageError("the disk is full")

    raised, commits = at_once(database, [row("d" * 32), full, row("e" * 32)])
    assert all(isinstance(error, StorageError) for error in raised) and commits == 1
    assert kept(database) == before


def test_who_waited_for_one_who_was_ended_is_told_that_nothing_was_kept():
    class Ended(BaseException):
        pass

    begun, told = [], []

    @contextmanager
    def begin():
        begun.append(1)
        if len(begun) == 1:
            raise Ended
        yield

    def write():
        try:
            together.write(lambda connection: None)
        except BaseException as error:
            told.append(type(error))

    together = Together(begin)
    threads = [threading.Thread(target=write) for _ in range(2)]
    with together._turn:
        for thread in threads:
            thread.start()
        until(lambda: len(together._waiting) == 2, "both")
    for thread in threads:
        thread.join()
    assert sorted(t.__name__ for t in told) == ["Ended", "StorageError"]
