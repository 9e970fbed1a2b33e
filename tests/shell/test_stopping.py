"""The server stops at the worst of moments: nothing is logged, nothing is thrown, what was done is written."""

import logging
import socket
import threading
import time

import numpy as np
import pytest

from app.session import Store
from app.shell.server import PendantServer
from tests.desk import until
from tests.shell.hand import Hand


@pytest.fixture
def quiet(caplog, monkeypatch, capfd):
    """Holds that nobody complained: no log, no thread that died, nothing on stderr."""
    died = []
    monkeypatch.setattr(threading, "excepthook", lambda fault: died.append(fault.exc_value))
    with caplog.at_level(logging.WARNING):
        yield
        time.sleep(0.2)
    said = [r.getMessage() for r in caplog.get_records("call")]
    assert not said and not died
    assert not capfd.readouterr().err


@pytest.fixture
def server(tmp_path):
    return PendantServer(Store(tmp_path), port=0, robot="ur10e", linger=0.1)


def sits(server):
    """(a hand, its session) with the screens made."""
    hand = Hand(server.port, scene=True)
    until(lambda: server.lives and hand.widgets and hand.read, "the page")
    return hand, server.lives[0]


@pytest.mark.parametrize("moment", [0.1, 0.15, 0.2])
def test_the_server_stops_while_the_arm_is_jogged(server, quiet, moment):
    hand, live = sits(server)
    start, ended = live.context.q.copy(), threading.Event()

    def jog():
        while not ended.is_set() and not hand.gone.is_set():
            try:
                hand.hold(0.3, axis=0)
            except Exception:  # websockets' own word for a closed connection
                return

    person = threading.Thread(target=jog)
    person.start()
    until(lambda: not np.array_equal(live.context.q, start), "the arm to move")
    time.sleep(moment)
    server.stop()
    ended.set()
    person.join()
    hand.close()
    assert np.array_equal(server.hub.store.state(live.session.name).q, live.context.q)


def test_the_server_stops_while_a_page_leaves_in_the_midst_of_a_job(server, quiet):
    hand, live = sits(server)
    begun = threading.Event()

    def job():
        begun.set()
        time.sleep(0.5)
        live.context.drive.show(live.context.q + 0.1)

    live.context.post(job)
    assert begun.wait(5.0)
    hand.close()
    server.stop()
    assert np.array_equal(server.hub.store.state(live.session.name).q, live.context.q)


def test_the_server_stops_while_somebody_has_only_knocked(server, quiet):
    with socket.create_connection(("127.0.0.1", server.port)) as knocking:
        knocking.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n")
        time.sleep(0.1)
        server.stop()
    assert not server.lives


def test_a_port_that_is_taken_makes_it_take_the_next(server, tmp_path):
    other = PendantServer(Store(tmp_path / "other"), port=server.port)
    try:
        assert server.port < other.port < server.port + 200
    finally:
        other.stop()
        server.stop()
