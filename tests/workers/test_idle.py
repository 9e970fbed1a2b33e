"""Sessions that no page shows: none whose person is on his way is closed for want of room, and nobody waits for those
that are."""

import threading

import numpy as np
import pytest

from app.errors import StorageError
from app.session import Store
from app.session.actions import Move
from app.session.leases import BEAT, Leases
from app.session.owners import owner_of
from app.workers import idle
from app.workers.hub import Hub
from tests.desk import until

AT = (0.1, -1.0, 1.0, 0.2, 0.3, 0.4)
ROOM = 3


@pytest.fixture
def hub(tmp_path, monkeypatch):
    monkeypatch.setattr(idle, "MOST_IDLE", ROOM)
    hub = Hub(Store(tmp_path), robot="ur10e")
    yield hub
    hub.close()


def people(count):
    return [owner_of(f"person {number}") for number in range(count)]


def were_here(hub, owners):
    """Sessions of people whose process has ended."""
    for owner in owners:
        session = hub.store.create(robot="ur10e")
        session.close()
        hub.owners.give(session.name, owner)


def test_however_many_come_back_at_once_each_finds_his_session_open_when_his_page_is_there(hub):
    owners = people(3 * ROOM)
    were_here(hub, owners)
    lives = [hub.enter(owner) for owner in owners]
    pages = [object() for _ in lives]
    for live, page in zip(lives, pages, strict=True):
        hub.arrive(live, page)
    assert all(hub.shows(live, page) and not live.closed for live, page in zip(lives, pages, strict=True))


def test_pages_take_no_room_from_those_who_reload(hub):
    for owner in people(2 * ROOM):
        hub.arrive(hub.enter(owner), object())
    live, page = hub.enter(owner_of("reloads")), object()
    hub.arrive(live, page)
    hub.depart(live, page)
    hub.arrive(hub.enter(owner_of("one more")), object())
    assert hub.find(owner_of("reloads")) is live and not live.closed


def test_of_strangers_whose_pages_never_come_the_first_are_closed(hub):
    owners = people(ROOM + 2)
    lives = [hub.enter(owner) for owner in owners]
    until(lambda: lives[0].closed and lives[1].closed, "room to be made")
    until(lambda: len(hub.lives) == ROOM, "the others to stay")
    assert hub.lives == lives[2:]


def test_who_was_closed_for_want_of_room_and_comes_after_all_stays(hub):
    owners = people(ROOM + 1)
    lives = [hub.enter(owner) for owner in owners]
    until(lambda: lives[0].closed, "room to be made")
    back = hub.enter(owners[0])
    for owner in [owner_of(f"stranger {number}") for number in range(2 * ROOM)]:
        hub.enter(owner)
    until(lambda: len(hub.lives) == ROOM + 1, "room to be made")
    assert back in hub.lives and back.session.name == lives[0].session.name


def test_a_page_that_comes_to_a_session_that_was_closed_takes_it_from_nobody(hub):
    owner = owner_of("somebody")
    before, late, page = hub.enter(owner), object(), object()
    hub.leave(owner)
    now = hub.enter(owner)
    hub.arrive(now, page)
    hub.arrive(before, late)
    assert hub.shows(now, page) and not hub.shows(before, late)


def test_a_database_that_does_not_answer_loses_nobodys_session(hub, monkeypatch):
    """He was given an empty one, and the one before stayed held here: no other process could open it."""
    owner = owner_of("somebody")
    were_here(hub, [owner])
    name, open_ = hub.owners.latest(owner), hub.store.open

    def busy(*_, **__):
        raise StorageError("busy")

    monkeypatch.setattr(hub.store, "open", busy)
    with pytest.raises(StorageError, match="busy"):
        hub.enter(owner)
    assert hub.owners.latest(owner) == name and len(hub.store.names()) == 1
    elsewhere = Leases(hub.store.database)
    elsewhere.take(name)  # at once
    elsewhere.let(name)
    monkeypatch.setattr(hub.store, "open", open_)
    assert hub.enter(owner).session.name == name


def test_who_comes_back_while_his_session_is_closed_finds_what_is_written_meanwhile(hub, monkeypatch):
    owner = owner_of("somebody")
    before = hub.enter(owner)
    closing, go_on, close = threading.Event(), threading.Event(), before.close

    def slowly():
        closing.set()
        go_on.wait(20.0)
        close()

    before.context.worker.idle()
    before.context.drive.q = np.array(AT)  # written when it closes
    monkeypatch.setattr(before, "close", slowly)
    leaving = threading.Thread(target=hub.leave, args=(owner,))
    leaving.start()
    closing.wait(20.0)
    back = []
    coming = threading.Thread(target=lambda: back.append(hub.enter(owner)))
    coming.start()
    coming.join(timeout=0.3)
    go_on.set()
    leaving.join()
    coming.join()
    assert tuple(back[0].session.state.q) == pytest.approx(AT)
    back[0].session.do(Move(AT))  # the number of the row is nobody else's


def test_others_sessions_are_held_while_one_that_is_wanted_elsewhere_is_closed(hub, monkeypatch):
    """Their beats waited for it: after three seconds any of them could be taken away."""
    wanted, other = hub.enter(owner_of("wanted")), hub.enter(owner_of("other"))
    closing, go_on, close = threading.Event(), threading.Event(), wanted.close

    def slowly():
        closing.set()
        go_on.wait(20.0)
        close()

    monkeypatch.setattr(wanted, "close", slowly)
    elsewhere = threading.Thread(target=Leases(hub.store.database).take, args=(wanted.session.name,))
    elsewhere.start()
    try:
        assert closing.wait(20.0)
        beats = []
        beat = hub._leases.beat
        monkeypatch.setattr(hub._leases, "beat", lambda: (beats.append(1), beat())[1])
        until(lambda: len(beats) >= 2, "beats", 20 * BEAT)
        assert not other.closed
    finally:
        go_on.set()
        elsewhere.join()
