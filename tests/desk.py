"""A person at a session without a page and without a web server: presses, holds, waits."""

import contextlib
import re
import time
from html import unescape

import pytest

from app.session import Store
from app.session.motion import enabling, pace
from app.session.motion.drive import MOTIONS
from app.session.owners import owner_of
from app.workers.hub import Hub
from tests.standing_out import two_stand_out

PATIENCE_S = 60.0
SECRET = "somebody's own"


def until(true, what, patience=PATIENCE_S):
    end = time.monotonic() + patience
    while not true():
        assert time.monotonic() < end, f"waited {patience:g} s for {what}"
        time.sleep(0.005)


class Desk:
    """One open session.

    Attributes:
        live, context: the session as the web server and as a screen know it.
    """

    def __init__(self, live):
        self.live, self._press = live, 1000

    @property
    def context(self):
        return self.live.context

    @property
    def drive(self):
        return self.context.drive

    @property
    def state(self):
        return self.context.session.state

    @property
    def q(self):
        return self.context.q

    @property
    def said(self):
        """What was said last: (level, words)."""
        return self.context.log[-1][1:]

    def view(self, name):
        """A screen's view by something it has."""
        # The screens are built on the worker: who comes with the page may be there first.
        until(lambda: any(hasattr(view, name) for view in self.context.views), f"a screen that has {name}")
        return next(view for view in self.context.views if hasattr(view, name))

    def does(self, job):
        """A job on the worker, done when this returns, with all it has put in."""
        self.context.post(job)
        self.idle()

    def idle(self):
        """The worker has done all it was given; whatever state that is, one key at most is the next."""
        until(lambda: self._still(), f"the worker; {self.context.log[-2:]}")
        assert not (both := two_stand_out(self.context.ui)), f"two keys at once are the next: {both}"

    def _still(self):
        worker = self.context.worker
        with worker._wake:
            busy = worker._queue or worker._busy or worker._timers
            return not busy and not [name for name in worker._motions if name not in ("watch", *MOTIONS)]

    @contextlib.contextmanager
    def holding(self):
        """The enabling switch is held."""
        self.live.beat(True, None, 0, 0)
        until(lambda: self.drive.live, "the switch")
        try:
            yield self
        finally:
            self.live.beat(False, None, 0, 0)
            self.idle()

    def rests(self):
        """Waits until nothing moves and nothing waits to move."""
        running = self.context.worker.running
        until(lambda: not any(map(running, MOTIONS)) and self._still(), f"the arm; {self.context.log[-2:]}")

    def moves(self, job):
        """A job that moves the arm, with the switch held until it rests."""
        with self.holding():
            self.does(job)
            self.rests()

    def jog(self, frame, axis, sign=1, seconds=0.0, enabled=True, till=None):
        """Holds a button of a pair, and the switch: for so long, until the motion has begun, or `till` what it is for
        is so: on a machine that stands still for a moment, time passes and nothing moves."""
        self.live.choose("frame", frame)
        self.idle()
        self._press += 1
        said = len(self.context.log)
        self.live.beat(enabled, axis, sign, self._press)
        until(
            lambda: self.context.worker.running("jog") or len(self.context.log) > said,
            "the motion, or why there is none",
        )
        if till is not None:
            until(till, f"what the jog is for; {self.context.log[-2:]}")
        else:
            time.sleep(max(seconds, 0.05))
        self.idle()
        if seconds == 0.0 and till is None and self.context.jogging.increment != "continuous":
            self.rests()
        self.live.beat(False, None, 0, 0)
        self.rests()

    def place(self, q):
        """The arm stands there, without a way."""
        self.does(lambda: (self.drive.show(q), self.drive.settle(), self.context.refresh()))

    def finish(self):
        """An exercise ends as it is: what is not done asks once more."""
        for _ in range(2):
            if self.state.running is not None:
                self.does(self.view("choose")._finish)

    def press(self, label, value=None, kind=""):
        """Presses a widget by its label."""
        self.context.ui.hear(self.context.ui.find(label, kind).data.id, value)
        self.idle()

    def shown(self):
        """Labels and options of everything that is seen."""
        out = set()
        for widget in self.context.ui.widgets():
            if self.context.ui.seen(widget):
                out |= {widget.label, *widget.options}
        return out


def plain(markup):
    """Markup as text."""
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]+>", " ", markup)))


@pytest.fixture
def patient(monkeypatch):
    """The switch stays live without further words: what is tried is not the watchdog."""
    monkeypatch.setattr(enabling, "SILENCE", 1e6)


@pytest.fixture
def brisk(monkeypatch):
    """The arm is twenty times as quick: what is tried is not its speed."""
    monkeypatch.setattr(pace, "TIP_SPEED", 20.0 * pace.TIP_SPEED)
    monkeypatch.setattr(pace, "TURN_SPEED", 20.0 * pace.TURN_SPEED)


@pytest.fixture
def sit_at(tmp_path, patient):
    """Opens a session: sit_at(robot=…, usual_world=…); all of one test share a store."""
    hubs = []

    def open_(secret=SECRET, **arguments):
        hub = Hub(Store(tmp_path), **{"robot": "ur10e", "linger": 0.05, **arguments})
        hubs.append(hub)
        desk = Desk(hub.enter(owner_of(secret)))
        desk.drive.override = 1.0
        desk.idle()
        return desk

    yield open_
    for hub in hubs:
        hub.close()


@pytest.fixture
def desk(sit_at):
    return sit_at()


@pytest.fixture
def in_the_cell(sit_at, brisk):
    """Two robots with their tracker: the desk, and the view of the procedure."""
    desk = sit_at("two", robot="irb120")
    desk.press("Open the cell")
    return desk, desk.view("run")
