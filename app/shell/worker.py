"""One of several processes that serve: the same server behind a socket that only the front reaches."""

from __future__ import annotations

import contextlib
import signal
import socket
import threading
import warnings
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from pathlib import Path

from app.people import People
from app.session import Store
from app.session.state import grant_robot
from app.shell.provider import Provider
from app.shell.server import PendantServer
from app.shell.way import Way


@dataclass(frozen=True)
class Plan:
    """What every worker serves.

    Args:
        data, database: where sessions are kept.
        host: the address that browsers come by.
        way: how they come.
        robot: arm of new sessions.
        accounts: True where people log in.
        provider: address, id and secret of who vouches for people besides.
    """

    data: Path | None
    database: str | None
    host: str
    way: Way
    robot: str | None
    accounts: bool
    provider: tuple[str, str, str] | None = None


def work(plan: Plan, path: Path, supervisor: Connection) -> None:
    """Serves until the supervisor says so, or is gone.

    Args:
        path: of the socket.
        supervisor: a pipe that ends with it; told when the worker is ready.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal's Ctrl-C goes to all: the supervisor answers it
    ending = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ending.set())
    warnings.simplefilter("ignore")
    if plan.robot is not None:
        grant_robot(plan.robot)
    store = Store(plan.data, plan.database)
    people = People(store.database) if plan.accounts else None
    provider = None if plan.provider is None else Provider(*plan.provider)
    path.unlink(missing_ok=True)
    listening = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    listening.bind(str(path))
    listening.listen(1024)
    way = replace(plan.way, certificate=None, key=None, proxy=True)
    server = PendantServer(
        store,
        host=plan.host,
        people=people,
        way=way,
        provider=provider,
        robot=plan.robot,
        listening=listening,
    )
    threading.Thread(target=_until_gone, args=(supervisor, ending), daemon=True).start()
    supervisor.send("ready")
    while not ending.wait(1.0) and server.running:
        pass
    server.stop()


def _until_gone(supervisor: Connection, ending: threading.Event) -> None:
    """A supervisor that was killed says nothing: its end of the pipe closes."""
    with contextlib.suppress(EOFError, OSError):
        supervisor.recv()
    ending.set()
