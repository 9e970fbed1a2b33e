"""Several processes behind one address: one that is killed loses nobody's work, and all end together."""

import itertools
import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from app.session import Store
from app.session.owners import Owners, owner_of
from tests.shell.hand import Hand
from tests.shell.started import Started
from tests.shell.test_server_kills import STEPS, Teacher

pytestmark = pytest.mark.xdist_group("pendant_server")

BACK_S = 5.0  # within which a killed worker's people go on
KILLS = 3


def serving(folder, *options, workers=2):
    return Started(folder, "--workers", str(workers), *options)


def arrived(port, cookie=None, who=Hand):
    """A person at the page, as soon as it comes up."""
    end = time.monotonic() + 60
    while True:
        try:
            return who(port, cookie)
        except Exception:
            if time.monotonic() > end:
                raise
            time.sleep(0.05)


def holder_of(hand, folder):
    """Process that holds the session of a page."""
    store = Store(folder)
    session = Owners(store.database).latest(owner_of(hand.cookie.split("=", 1)[1]))
    with store.database.begin() as connection:
        worker = connection.exec_driver_sql(f"SELECT worker FROM leases WHERE session = '{session}'").scalar()
    store.database.close()
    return int(worker.split()[1]), session


def test_people_are_spread_and_a_killed_workers_go_on_elsewhere(tmp_path):
    """Every worker that holds somebody is killed in turn; he comes back within seconds with all he recorded."""
    with serving(tmp_path) as server:
        hands = [arrived(server.port) for _ in range(4)]
        assert {holder_of(hand, tmp_path)[0] for hand in hands} == set(server.workers())
        hand = hands[0]
        rng = np.random.default_rng(1)
        teacher = Teacher(rng)
        for number in range(KILLS):
            assert hand.wait_for(lambda hand=hand: bool(hand.read) and bool(hand.rows()))
            pid, session = holder_of(hand, tmp_path)
            hands.append(at_another(server.port, tmp_path, pid))
            kill = threading.Timer(float(rng.uniform(0.0, 0.8)), os.kill, (pid, signal.SIGKILL))
            teacher.teach(hand, kill.start)
            assert hand.gone.wait(10.0)
            begun = time.monotonic()
            hand.close()
            hand = arrived(server.port, hand.cookie)
            assert hand.wait_for(lambda hand=hand: bool(hand.read))
            assert time.monotonic() - begun < BACK_S
            shown = {
                step: angle is not None
                for step, angle in teacher.confirmed.items()
                if teacher.pending is None or step != teacher.pending[0]
            }
            assert hand.wait_for(lambda hand=hand, shown=shown: shown.items() <= hand.rows().items())
            store = Store(tmp_path)
            teacher.found(store.state(session))
            store.database.close()
            assert holder_of(hand, tmp_path)[0] != pid
            if number:
                assert any("SIGKILL" in line and "started again" in line for line in server.said)
        assert teacher.count >= KILLS
        for one in (*hands[1:], hand):
            one.close()


def at_another(port, folder, pid):
    """Somebody whom another process serves: that one has come up, too."""
    end = time.monotonic() + 60
    while True:
        hand = arrived(port)
        if holder_of(hand, folder)[0] != pid:
            return hand
        hand.close()
        assert time.monotonic() < end
        time.sleep(0.5)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_polite_end_ends_all_of_it_and_keeps_where_the_arm_stands(tmp_path, number):
    with serving(tmp_path) as server:
        hand = arrived(server.port)
        assert hand.wait_for(lambda: bool(hand.read))
        workers = server.workers()
        start = hand.read["axes"][0]["number"]
        end = time.monotonic() + 60
        while (
            hand.read["axes"][0]["number"] == start
        ):  # on a busy machine a switch that falls silent stops the arm
            assert time.monotonic() < end
            hand.hold(0.3, axis=0, sign=1)
            assert hand.wait_for(lambda: hand.read["how"] == "standing")
        angle = hand.read["axes"][0]["number"]
        server.process.send_signal(number)
        assert server.process.wait(timeout=20) == 0
        for pid in workers:
            assert not Path(f"/proc/{pid}").exists()
        assert not any("Traceback" in line for line in server.said)
        store = Store(tmp_path)
        (session,) = store.names()
        assert np.degrees(store.state(session).q[0]) == pytest.approx(angle, abs=0.01)
        with store.database.begin() as connection:
            assert connection.exec_driver_sql("SELECT count(*) FROM leases").scalar() == 0
        store.database.close()


def test_a_killed_supervisor_takes_its_workers_with_it(tmp_path):
    with serving(tmp_path) as server:
        arrived(server.port).close()
        workers = server.workers()
        server.process.kill()
        end = time.monotonic() + 15
        while any(Path(f"/proc/{pid}").exists() for pid in workers) and time.monotonic() < end:
            time.sleep(0.1)
        assert not any(Path(f"/proc/{pid}").exists() for pid in workers)


def test_a_person_with_two_browsers_has_one_arm(tmp_path):
    """The second page takes the session over, whichever process it came to; the first is told and stays away."""
    with serving(tmp_path) as server:
        first = arrived(server.port)
        assert first.wait_for(lambda: bool(first.read))
        second = arrived(server.port, first.cookie)
        assert second.wait_for(lambda: bool(second.read))
        assert first.gone.wait(10.0)
        second.close()


def test_two_servers_on_one_folder_hand_a_session_over(tmp_path):
    """The same person at two servers: one writes at a time, nothing is lost, and neither is stuck."""
    with serving(tmp_path, workers=1) as one, serving(tmp_path, workers=1) as two:
        hand = arrived(one.port)
        assert hand.wait_for(lambda: bool(hand.read) and bool(hand.rows()))
        cookie = hand.cookie
        for server, step in zip(itertools.cycle((two, one)), STEPS[:2], strict=False):
            hand.press_row(step, "record")
            assert hand.wait_for(lambda hand=hand, step=step: hand.rows().get(step) is True)
            before = hand
            hand = arrived(server.port, cookie)
            assert hand.wait_for(lambda hand=hand, step=step: hand.rows().get(step) is True)
            assert before.gone.wait(10.0)
            before.close()
        hand.close()
    store = Store(tmp_path)
    (session,) = store.names()
    assert {step for step in STEPS if step in store.state(session).captures} == set(STEPS[:2])
    store.database.close()
