"""Which worker a browser belongs to: the one it came to first; where that ended, all share those it had."""

import asyncio
import socket
from collections import Counter

import pytest

from app.shell import spread
from app.shell.supervisor import _TOGETHER, Supervisor
from app.shell.way import Way
from app.shell.worker import Plan
from tests.shell.test_front import run, worker


def test_a_browser_stays_with_the_worker_that_gave_it_its_cookie(tmp_path):
    async def story(street):
        for _ in range(4):
            first = await street.ask()
            cookie = first.split("Set-Cookie: ")[1].split(";")[0]
            for _ in range(3):
                assert worker(await street.ask(f"Cookie: look=x; {cookie}; y=1")) == worker(first)

    run(tmp_path, story)


def test_browsers_that_are_known_from_before_are_spread(tmp_path):
    async def story(street):
        went = [worker(await street.ask(f"Cookie: teachframe=person{n}")) for n in range(40)]
        assert went.count(0) == went.count(1) == 20
        assert [worker(await street.ask(f"Cookie: teachframe=person{n}")) for n in range(40)] == went

    run(tmp_path, story)


@pytest.mark.parametrize("says", [True, False])
def test_a_workers_people_go_to_another_whether_or_not_its_end_was_noticed(tmp_path, says):
    async def story(street):
        mine = worker(await street.ask("Cookie: teachframe=me"))
        street.stop(mine)
        street.up[mine] = says
        assert worker(await street.ask("Cookie: teachframe=me")) != mine
        await street.start(mine)
        street.up[mine] = True
        assert worker(await street.ask("Cookie: teachframe=me")) != mine  # where his session is now

    run(tmp_path, story)


def test_those_of_a_worker_that_ended_are_spread_though_another_has_taken_its_place(tmp_path):
    """They come at once: the new one, which has nobody yet, does not get all of them."""

    async def story(street):
        people = [f"Cookie: teachframe=person{n}" for n in range(12)]
        went = {person: worker(await street.ask(person)) for person in people}
        his = [person for person in people if went[person] == 1]
        for known in street.front.spread.known.values():
            known.came -= 60.0  # long ago
        street.front.spread.ended(1)
        again = [worker(answer) for answer in await asyncio.gather(*map(street.ask, his))]
        assert len(his) == 4 and sorted(Counter(again).values()) == [1, 1, 2]
        for person in people:
            assert person in his or worker(await street.ask(person)) == went[person]

    run(tmp_path, story, count=3)


def test_browsers_that_are_gone_for_long_are_forgotten(tmp_path, monkeypatch):
    monkeypatch.setattr(spread, "_MOST_KNOWN", 10)
    monkeypatch.setattr(spread, "_IDLE", 0.0)

    async def story(street):
        for number in range(50):
            await street.ask(f"Cookie: teachframe=person{number}")
        assert len(street.front.spread.known) <= 10

    run(tmp_path, story)


def test_a_class_that_comes_in_at_one_moment_is_spread(tmp_path):
    """Nobody has a cookie yet, so nobody is known."""

    async def story(street):
        went = [worker(answer) for answer in await asyncio.gather(*(street.ask() for _ in range(12)))]
        assert sorted(Counter(went).values()) == [6, 6]

    run(tmp_path, story)


def test_people_wait_for_all_workers_to_come_up_but_not_for_long(monkeypatch, tmp_path):
    """The first to come up got everybody who waited, and kept them."""
    now = [100.0]
    monkeypatch.setattr("app.shell.supervisor.time.monotonic", lambda: now[0])
    listening = socket.socket()
    for late in (False, True):
        people = Supervisor(Plan(tmp_path, None, "127.0.0.1", Way(), None, False), 3, listening)
        people._workers[1].ready = True
        assert not people._front.spread.ready
        if late:
            now[0] += _TOGETHER + 1.0
        else:
            people._workers[0].ready = people._workers[2].ready = True
        assert people._front.spread.ready and people._ready(1) and people._ready(0) is not late
        people._workers[0].ready = False
        assert people._ready(1) and not people._ready(0)
    listening.close()
