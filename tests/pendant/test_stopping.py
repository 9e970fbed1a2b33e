"""The server stops at the worst of moments: nothing is logged, nothing is thrown, what was done is written."""

import logging
import threading
import time

import numpy as np
import pytest

from app.geometry import Pose
from app.pendant.server import PendantServer
from app.session import Store
from benchmarks._browser import Browser
from tests.pendant.hand import Hand
from tests.pendant.test_server import until

pytestmark = pytest.mark.xdist_group("pendant_server")


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
    return PendantServer(Store(tmp_path), port=0, robot="ur10e")


def sits(server, hand_of=Hand):
    """(a hand, its pendant) with the page made."""
    hand = hand_of(server.port)
    until(lambda: server.pendants and hasattr(server.pendants[0], "page"), "the page")
    assert server.pendants[0].worker.idle()
    return hand, server.pendants[0]


@pytest.mark.parametrize("moment", [0.1, 0.15, 0.2])
def test_the_server_stops_during_a_drag(server, quiet, moment):
    hand, pendant = sits(server)
    start, ended = pendant.hand(), threading.Event()

    def drag():
        for k in range(10_000):
            if ended.is_set() or hand.gone.is_set():
                return
            try:
                hand.drag(Pose.of(start.rotation, start.position + np.array([0.0, 0.0, 1e-4 * k])))
            except OSError:
                return
            except Exception:  # websockets' own word for a closed connection
                return
            time.sleep(0.003)

    person = threading.Thread(target=drag)
    person.start()
    time.sleep(moment)
    server.stop()
    ended.set()
    person.join()
    hand.close()
    assert np.array_equal(server.hub.store.state(pendant.session.name).q, pendant.q)


def test_the_server_stops_while_a_browser_leaves_in_the_midst_of_a_job(server, quiet):
    hand, pendant = sits(server)
    begun = threading.Event()

    def job():
        begun.set()
        time.sleep(0.5)
        pendant.show(pendant.q + 0.1)

    pendant.post(job)
    assert begun.wait(5.0)
    hand.close()
    until(lambda: not server.pendants, "the server to notice")
    server.stop()
    assert np.array_equal(server.hub.store.state(pendant.session.name).q, pendant.q)


class Silent(Browser):
    """A browser that does not say which session is its own."""

    def _answer(self, message):
        pass


def test_the_server_stops_while_a_browser_is_coming_in(server, quiet):
    browser = Silent(server.port)
    until(lambda: browser.received > 0, "the page's first words")
    time.sleep(0.2)
    server.stop()
    browser.close()
    time.sleep(0.3)
    assert not server.pendants
