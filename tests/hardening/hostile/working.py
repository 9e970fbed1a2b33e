"""Who works meanwhile: a page that asks for answers."""

from __future__ import annotations

import itertools
import json
import threading
import time

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from tests.hardening.hostile.asking import PIN, Asking, log_in

PING = 0.1  # seconds between two questions of one trainee


class Trainee:
    """A page that asks for answers."""

    def __init__(self, port, login):
        self.cookie = log_in(port, login, PIN)
        ask = Asking(port)
        assert ask("GET", "/", cookie=self.cookie)[0] == 200
        self.socket = connect(
            f"ws://{ask.host}/words", additional_headers={"Cookie": self.cookie}, origin=f"http://{ask.host}"
        )
        self.trips, self.lost, self._sent, self._stop = [], 0, {}, False
        for job in (self._ask, self._hear):
            threading.Thread(target=job, daemon=True).start()

    def _ask(self):
        for n in itertools.count(1):
            if self._stop:
                return
            self._sent[n] = time.perf_counter()
            try:
                self.socket.send(json.dumps({"t": "ping", "n": n}))
            except WebSocketException:
                self.lost += 1
                return
            time.sleep(PING)

    def _hear(self):
        try:
            for text in self.socket:
                if '"pong"' in str(text):
                    n = int(json.loads(text)["n"])
                    self.trips.append(time.perf_counter() - self._sent.pop(n))
        except WebSocketException:
            pass
        self.lost += not self._stop

    def take(self):
        trips, self.trips = self.trips, []
        return trips

    def stop(self):
        self._stop = True
        self.socket.close()
