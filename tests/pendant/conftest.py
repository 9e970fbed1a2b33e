"""A pendant behind a browser without a screen."""

import pytest

from app.pendant import motion
from app.pendant.server import PendantServer
from app.session import Store
from app.units import deg
from benchmarks._browser import Browser
from tests.pendant.hand import Hand
from tests.pendant.test_server import until


@pytest.fixture
def open_pendant(tmp_path):
    """Opens a pendant: open_pendant(robot=…, world_of=…)."""
    opened = []

    def start(**arguments):
        server = PendantServer(Store(tmp_path), port=0, **{"robot": "ur10e", **arguments})
        opened.append((server, Browser(server.port)))
        until(lambda: server.pendants and hasattr(server.pendants[0], "page"), "the page")
        assert server.pendants[0].worker.idle()
        return server.pendants[0]

    yield start
    for server, browser in opened:
        browser.close()
        server.stop()


@pytest.fixture
def seat(tmp_path):
    """(a hand at the page, its pendant, everywhere axis 1 was shown [deg])."""
    server = PendantServer(Store(tmp_path), port=0, robot="ur10e")
    hand = Hand(server.port)
    until(lambda: server.pendants and hasattr(server.pendants[0], "page"), "the page")
    pendant = server.pendants[0]
    assert pendant.worker.idle()
    assert hand.wait_for(lambda: "Axis 1" in hand.fields and "○ Touch 1" in hand.rows and "P" in hand.keys)
    show, shown = pendant.show, []

    def watched(q):
        shown.append(float(deg(q[0])))
        show(q)

    pendant.show = watched
    yield hand, pendant, shown
    hand.close()
    server.stop()


@pytest.fixture
def brisk(monkeypatch):
    """Shown motions take no longer than they have to be seen: a turn about a tool point has 45 of them."""
    monkeypatch.setattr(motion, "SHORTEST", 0.03)
    monkeypatch.setattr(motion, "SPEED", 8.0)
