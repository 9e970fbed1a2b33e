"""What it costs to open a session that was there before, in a class: what a killed worker's people cost the others.

Run: python -m benchmarks session_open

Processor time of one process that holds what a worker is forked with, without page and sockets; the arm and its points
are there and all screens are made.
"""

from __future__ import annotations

import tempfile
import threading
import time
from importlib import import_module
from pathlib import Path

from app.session import Store
from app.session.actions import AnyAction, Delete, Move, Record
from app.session.journal import Entry, Header, Recorded
from app.session.owners import Owners, owner_of
from app.workers.hub import Hub
from app.workers.live import Live
from benchmarks.rows import Row

PEOPLE, ACTIONS, OPENED = 200, 100, 24
#: Cores of a class, and seconds within which the people of one worker of four go on.
_CORES, _WITHIN = 2, 5.0


def run() -> list[Row]:
    """Processor time a session, alone and among the sessions of a class."""
    import_module("app.workers.warm")
    aim = _CORES * _WITHIN / (PEOPLE / 4)
    return [
        Row(f"opening one of {OPENED} sessions of {ACTIONS} actions", _opened(OPENED), aim=aim),
        Row(f"the same among those of {PEOPLE} people", _opened(PEOPLE), aim=aim),
    ]


def _opened(people: int) -> float:
    with tempfile.TemporaryDirectory() as folder:
        store = Store(Path(folder))
        _fill(store, people)
        hub = Hub(store, robot="ur10e")
        _ready(hub.enter(owner_of("0")))
        begun = time.process_time()
        for live in [hub.enter(owner_of(str(number))) for number in range(1, OPENED)]:
            _ready(live)
        spent = time.process_time() - begun
        hub.close()
        store.database.close()
    return spent / (OPENED - 1)


def _fill(store: Store, people: int) -> None:
    """Each has jogged, recorded a point and deleted it again, over and over."""
    owners, first = Owners(store.database), store.create(robot="ur10e")
    q, done = first.state.q, [entry.action for entry in first.entries]
    for number in range(ACTIONS):
        stood = Move((q[0] + 1e-3 * (number % 50), *q[1:]))
        steps: tuple[AnyAction, ...] = (stood, Record("touch1"), stood, Delete("touch1"))
        done.append(steps[number % 4])
    entries = tuple(Entry(n, time.time(), action) for n, action in enumerate(done, 1))
    for number in range(people):
        name = store.take(Recorded(Header("", time.time()), entries))
        owners.give(name, owner_of(str(number)))


def _ready(live: Live) -> None:
    """Waits until what was asked of it so far is done."""
    done = threading.Event()
    live.context.post(done.set)
    done.wait(60.0)
