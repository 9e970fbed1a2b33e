"""A trainer watches an arm that is in another process of the server: it arrives there as soon as at its own page."""

import json
import threading
import time

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app.people import People
from app.session import Store
from app.session.leases import Leases
from app.session.owners import Owners
from app.shell.entrance import Entrance
from app.shell.signing import signed
from tests.desk import until
from tests.people.conftest import PASSWORD, PIN
from tests.shell.hand import Hand
from tests.shell.test_workers import arrived, serving

pytestmark = pytest.mark.xdist_group("pendant_server")

#: Longest a figure takes to a watcher [s].
DELAY_S = 0.5
MOVES = 12


class Times:
    """When the first joint's angle was seen first, by what it was."""

    def __init__(self):
        self.first = {}

    def note(self, text):
        message = json.loads(text)
        if message["t"] == "read":
            self.first.setdefault(message["axes"][0]["number"], time.monotonic())


class Trainee(Hand):
    """A hand that notes when its own page was told."""

    def __init__(self, *rest):
        self.times = Times()
        super().__init__(*rest)

    def heard(self, text):
        self.times.note(text)


class School:
    """A trainer with a trainee, in the database of a server."""

    def __init__(self, folder):
        self.store = Store(folder)
        self.people = People(self.store.database)
        self.trainer = self.people.add("tom", "Tom", "trainer", PASSWORD)
        self.at = self.people.classes.make("Monday", self.trainer.id)
        self.trainee = self.people.join(self.at.code, "Ann", PIN, "127.0.0.1")

    def cookie(self, person):
        """A browser that is logged in."""
        entrance = Entrance(self.people)
        return f"teachframe={signed(entrance.key, self.people.logins.begin(person.id))}"

    def process_of(self, person):
        """The process that has somebody's session."""
        return Leases(self.store.database).process(Owners(self.store.database).latest(person.owner))

    def trainer_in_another_process(self, port):
        """Cookie of the trainer, whose own session is open in another process than the trainee's."""
        end = time.monotonic() + 60
        while time.monotonic() < end:
            cookie = self.cookie(self.trainer)
            hand = arrived(port, cookie)
            assert hand.wait_for(lambda hand=hand: bool(hand.read))
            apart = self.process_of(self.trainer) != self.process_of(self.trainee)
            hand.close()
            if apart:
                return cookie
            time.sleep(0.5)  # the other one has not come up yet
        raise AssertionError("both are in one process")


def listen(watching, seen):
    try:
        for text in watching:
            seen.note(text)
    except ConnectionClosed:
        pass


@pytest.fixture
def school(tmp_path):
    school = School(tmp_path)
    yield school
    school.store.database.close()


def test_a_trainer_watches_an_arm_of_another_process_less_than_half_a_second_late(school, tmp_path):
    delays = []
    with serving(tmp_path) as server:
        hand = arrived(server.port, school.cookie(school.trainee), Trainee)
        assert hand.wait_for(lambda: bool(hand.read))
        his, seen = school.trainer_in_another_process(server.port), Times()
        address = f"ws://127.0.0.1:{server.port}/class/{school.at.id}/watch/{school.trainee.id}/words"
        with connect(address, origin=server.address, additional_headers={"Cookie": his}) as watching:
            threading.Thread(target=listen, args=(watching, seen), daemon=True).start()
            for number in range(MOVES):
                before = hand.read["axes"][0]["number"]
                hand.hold(0.2, axis=0, sign=1 if number % 2 else -1)
                assert hand.wait_for(
                    lambda: hand.read["how"] == "standing" and hand.read["axes"][0]["number"] != before  # noqa: B023
                )
                time.sleep(0.1)  # the last figures
                stands = hand.read["axes"][0]["number"]
                until(lambda stands=stands: stands in seen.first, "the watcher")
                delays.append(seen.first[stands] - hand.times.first[stands])
        hand.close()
    print(
        f"later than at his own page: median {np.median(delays) * 1e3:.0f} ms, most {max(delays) * 1e3:.0f} ms"
    )
    assert max(delays) < DELAY_S
