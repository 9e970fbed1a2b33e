"""`teachframe serve` killed with -9 while somebody teaches at it: what the page had confirmed is there again."""

import itertools
import os
import signal
import threading
import time

import numpy as np
import pytest

from app.session import Store
from app.session.owners import Owners, owner_of
from tests.shell.hand import Hand
from tests.shell.started import Started

pytestmark = pytest.mark.xdist_group("pendant_server")

KILLS, LONGEST_S = 4, 0.8
STEPS = ("touch1", "touch2", "touch3", "touch4")
NEAR_DEG = 0.011  # the page shows hundredths of a degree


class Teacher:
    """Jogs the arm about its first axis and records, or deletes, one point after the other.

    Attributes:
        confirmed: step -> angle of the first axis [deg] of the point the page showed as recorded; None: as deleted.
        pending: the step that was pressed and not yet shown.
    """

    def __init__(self, rng):
        self._rng, self.confirmed, self.pending, self.count = rng, dict.fromkeys(STEPS), None, 0

    def teach(self, hand, begun):
        """Until the server is gone; `begun` is called when the first point is confirmed."""
        for number in itertools.count():
            step = str(self._rng.choice(STEPS))
            there = self.confirmed[step] is not None
            try:
                angle = None if there else self._jogged(hand)
                self.pending = (step, angle)
                hand.press_row(step, "delete" if there else "record")
            except Exception:  # the socket is closed
                return
            if not hand.wait_for(lambda step=step, there=there: hand.rows().get(step) is not there):
                return
            self.confirmed[step], self.pending, self.count = angle, None, self.count + 1
            if number == 0:
                begun()

    def _jogged(self, hand):
        sign = 1 if hand.read["axes"][0]["number"] < 0.0 else -1
        hand.hold(0.06, axis=0, sign=sign)
        seen = None
        while (
            not hand.gone.is_set()
        ):  # on a busy machine figures come late: what stands is told the same twice
            now = (hand.read["how"], hand.read["axes"][0]["number"])
            if now == seen and now[0] == "standing":
                break
            seen = now
            time.sleep(0.15)
        return hand.read["axes"][0]["number"]

    def found(self, state):
        """Holds what is there against what was confirmed; what was on its way may have come or not."""
        for step in STEPS:
            capture = state.captures.get(step)
            angle = None if capture is None else float(np.degrees(capture.q[0]))
            wanted = [self.confirmed[step]]
            if self.pending is not None and self.pending[0] == step:
                wanted.append(self.pending[1])
            assert any(_same(angle, one) for one in wanted), (step, angle, wanted)
            self.confirmed[step] = angle
        self.pending = None


def _same(angle, other):
    return angle is other if None in (angle, other) else abs(angle - other) < NEAR_DEG


def killed_while_teaching(folder, database, kills=KILLS):
    """Kills the server at random moments, each time in the midst of teaching; gives how much was confirmed."""
    rng = np.random.default_rng(int(time.time()))
    teacher, cookie = Teacher(rng), None
    store = Store(folder, database)
    for _ in range(kills):
        with Started(folder, "--database", database) as server:
            hand = Hand(server.port, cookie)
            cookie = hand.cookie
            shown = {step: angle is not None for step, angle in teacher.confirmed.items()}
            assert hand.wait_for(lambda hand=hand, shown=shown: shown.items() <= hand.rows().items())
            assert hand.wait_for(lambda hand=hand: bool(hand.read))
            kill = threading.Timer(
                float(rng.uniform(0.0, LONGEST_S)), os.kill, (server.process.pid, signal.SIGKILL)
            )
            teacher.teach(hand, kill.start)
            assert hand.gone.wait(10.0)
            hand.close()
            session = Owners(store.database).latest(owner_of(cookie.split("=", 1)[1]))
            teacher.found(store.state(session))
    store.database.close()
    return teacher.count


def test_nothing_the_page_confirmed_is_lost_when_the_server_is_killed(tmp_path):
    assert killed_while_teaching(tmp_path, f"sqlite:///{tmp_path / 'kept.sqlite'}") >= KILLS
