"""`teachframe serve` killed with -9 while somebody teaches at it: what the page had confirmed is there again."""

import itertools
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import load_robot
from app.session import Store
from app.simulation.world import default_world
from tests.pendant.hand import Hand

pytestmark = pytest.mark.xdist_group("pendant_server")

KILLS, LONGEST_S = 4, 0.8
ROBOT = "ur10e"
STEPS = {f"touch{k}": f"Touch {k}" for k in range(1, 5)}
NEAR_RAD = 1e-4  # the angle the drag asked for, as inverse kinematics meets it


@contextmanager
def serving(folder, database):
    """The server as people start it, in a process of its own: (its process, its port)."""
    command = [sys.executable, "-m", "app", "serve", "--port", "0", "--robot", ROBOT]
    command += ["--data", str(folder), "--database", database]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert process.stdout is not None
    try:
        said = process.stdout.readline()
        assert said.startswith("Teachframe pendant: http"), said
        yield process, int(said.rsplit(":", 1)[1])
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


class Teacher:
    """Drags the arm about its first axis and records, or deletes, one point after the other.

    Attributes:
        confirmed: step -> angle of the first axis [rad] of the point the page showed as recorded; None: as deleted.
        pending: the step that was pressed and not yet shown.
    """

    def __init__(self, rng):
        self._rng, self.confirmed, self.pending, self.count = rng, dict.fromkeys(STEPS), None, 0
        world = default_world(load_robot(ROBOT))
        self._home, self._hand = float(world.robot.home[0]), world.hand(world.robot.home)

    def teach(self, hand, begun):
        """Until the server is gone; `begun` is called when the first point is confirmed."""
        for number in itertools.count():
            step = str(self._rng.choice(list(STEPS)))
            title, there = STEPS[step], self.confirmed[step] is not None
            angle = None if there else float(self._rng.uniform(-0.3, 0.3))
            try:
                if angle is not None:
                    turn = exp_so3(np.array([0.0, 0.0, angle]))
                    hand.drag(Pose.of(turn @ self._hand.rotation, turn @ self._hand.position))
                self.pending = (step, angle)
                hand.press(f"{'●' if there else '○'} {title}", "Delete" if there else "Record")
            except Exception:  # the socket is closed
                return
            if not hand.wait_for(lambda row=f"{'○' if there else '●'} {title}": row in hand.rows):
                return
            self.confirmed[step], self.pending, self.count = angle, None, self.count + 1
            if number == 0:
                begun()

    def found(self, state):
        """Holds what is there against what was confirmed; what was on its way may have come or not."""
        for step in STEPS:
            capture = state.captures.get(step)
            angle = None if capture is None else float(capture.q[0]) - self._home
            wanted = [self.confirmed[step]]
            if self.pending is not None and self.pending[0] == step:
                wanted.append(self.pending[1])
            assert any(_same(angle, one) for one in wanted), (step, angle, wanted)
            self.confirmed[step] = angle
        self.pending = None


def _same(angle, other):
    return angle is other if None in (angle, other) else abs(angle - other) < NEAR_RAD


def killed_while_teaching(folder, database, kills=KILLS):
    """Kills the server at random moments, each time in the midst of teaching; gives how much was confirmed."""
    rng = np.random.default_rng(int(time.time()))
    teacher, token = Teacher(rng), None
    store = Store(folder, database)
    for _ in range(kills):
        with serving(folder, database) as (process, port):
            hand = Hand(port, token)
            shown = {
                f"{'○' if teacher.confirmed[step] is None else '●'} {title}" for step, title in STEPS.items()
            }
            assert hand.wait_for(lambda hand=hand, shown=shown: shown <= set(hand.rows)), "the server died"
            assert hand.wait_for(lambda hand=hand: hand.token is not None)
            assert hand.token is not None and token in (None, hand.token)
            token = hand.token
            moment = float(rng.uniform(0.0, LONGEST_S))
            kill = threading.Timer(moment, os.kill, (process.pid, signal.SIGKILL))
            teacher.teach(hand, kill.start)
            assert hand.gone.wait(10.0)
            hand.close()
            teacher.found(store.state(token))
    store.database.close()
    return teacher.count


def test_nothing_the_page_confirmed_is_lost_when_the_server_is_killed(tmp_path):
    assert killed_while_teaching(tmp_path, f"sqlite:///{tmp_path / 'kept.sqlite'}") >= KILLS
