"""A class at several processes: round trips, captures that were confirmed and are lost, time until a killed worker's
people go on.

Run: python -m benchmarks class_load; longer: python -m benchmarks.class_load TRAINEES SECONDS WORKERS KILL_EVERY_S

All come at the same second; when everybody is in, the time begins and so do the kills. Each trainee holds switch and
button, jogs, records a point, deletes it again, over the network, with the scene's socket open, and looks on between
two doings as a learner does: a burst of 0.6 s every five seconds or so. Figures of a run in which workers are killed
hold the waits for another worker apart from the round trips. The trainees' own program takes a share of the same cores,
which is said beside that of front and workers.
"""

from __future__ import annotations

import asyncio
import math
import os
import random
import signal
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from websockets.exceptions import WebSocketException

from benchmarks._page import Page, enter, processor_of
from benchmarks.rows import Row
from tests.shell.started import Started

TRAINEES, SECONDS, WORKERS, KILL_EVERY = 10, 20.0, 4, 8.0
STEPS = ("touch1", "touch2", "touch3", "touch4")
LOOKING_S = 4.0  # mean time a learner looks at what he did before he goes on, drawn anew each time
_PATIENCE = 20.0  # seconds until a button that shows nothing counts as an error
_BROKEN = (OSError, WebSocketException, asyncio.IncompleteReadError)


class _NoAnswerError(Exception):
    """A button showed nothing."""


@dataclass
class Tally:
    """What all trainees met."""

    end: float = math.inf  # by the performance counter; known when everybody is in
    trips: list[float] = field(default_factory=list)
    back: list[float] = field(default_factory=list)
    confirmed: int = 0
    errors: int = 0
    lost: int = 0


class Trainee:
    """One person who jogs, records and deletes, and comes back when he is thrown out."""

    def __init__(self, server: Any, tally: Tally):
        self._server, self._tally, self.cookie = server, tally, ""
        self.came = asyncio.Event()
        self.points: dict[str, bool] = dict.fromkeys(STEPS, False)
        self.doubtful: set[str] = set()  # pressed, and not answered

    async def learn(self) -> None:
        """Until the end."""
        thrown = 0.0
        while time.perf_counter() < self._tally.end:
            page = None
            try:
                page = await enter(self._server, self.cookie)
                self.cookie = page.cookie
                await self._until(lambda page=page: bool(page.rows()))
                if thrown:
                    self._tally.back.append(time.perf_counter() - thrown)
                    thrown = 0.0
                self._compare(page)
                self.came.set()
                while time.perf_counter() < self._tally.end:
                    await self._one(page)
            except _BROKEN:
                if self.came.is_set():
                    thrown = thrown or time.perf_counter()
                await asyncio.sleep(0.5)  # as the page waits
            except _NoAnswerError:
                self._tally.errors += 1
            finally:
                if page is not None:
                    with suppress(*_BROKEN):
                        await page.close()

    async def _one(self, page: Page) -> None:
        step = random.choice(STEPS)
        await page.hold(0.6, 0, random.choice((-1, 1)))
        await self._ping(page)
        await asyncio.sleep(0.5)
        want = not page.rows()[step]
        self.doubtful.add(step)
        await page.press_row(step, "record" if want else "delete")
        await self._until(lambda: page.rows().get(step) is want, page)
        self.points[step] = want
        self.doubtful.discard(step)
        self._tally.confirmed += 1
        await asyncio.sleep(random.expovariate(1.0 / LOOKING_S))

    async def _ping(self, page: Page) -> None:
        n, sent = random.random(), time.perf_counter()
        await page.say(t="ping", n=n)
        await self._until(lambda: n in page.pongs, page)
        self._tally.trips.append(page.pongs.pop(n) - sent)

    def _compare(self, page: Page) -> None:
        """What the page had shown as recorded or deleted is so; what was pressed without an answer may be so or not,
        and may become so later, until that point is confirmed again."""
        for step, there in page.rows().items():
            if step in self.points and step not in self.doubtful:
                self._tally.lost += there is not self.points[step]
                self.points[step] = there

    async def _until(self, true, page: Page | None = None) -> None:
        end = time.perf_counter() + _PATIENCE
        while not true():
            if page is not None and page.gone.is_set():
                raise ConnectionResetError
            if time.perf_counter() > end:
                raise _NoAnswerError
            await asyncio.sleep(0.005)


def run(
    trainees: int = TRAINEES, seconds: float = SECONDS, workers: int = WORKERS, kill_every: float = KILL_EVERY
) -> list[Row]:
    """p50 and p95 of the round trip, errors, lost captures; `kill_every` 0 kills nobody."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "data"
        folder.mkdir()
        server, tally = Started(folder, "--workers", str(workers)), Tally()
        try:
            spent = Spent(server)
            coming, kills = asyncio.run(_class(server, tally, trainees, seconds, kill_every, spent))
            loaded = os.getloadavg()[0]
            server.stop()
        finally:
            server.kill()
    what = f"{trainees} trainees, {workers} workers, {seconds:g} s, {kills} kills"
    trips, back = np.array(tally.trips or [np.nan]), np.array(tally.back or [np.nan])
    return [
        Row(f"{what}: until all who came at once were in", coming),
        Row(f"{what}: round trip, p50", float(np.percentile(trips, 50))),
        Row(f"{what}: round trip, p95", float(np.percentile(trips, 95))),
        Row(f"{what}: points confirmed", tally.confirmed, unit=""),
        Row(f"{what}: confirmed points lost", tally.lost, unit="", aim=0.5),
        Row(f"{what}: buttons without an answer in {_PATIENCE:g} s", tally.errors, unit=""),
        Row(f"{what}: until a killed worker's people go on, p50", float(np.percentile(back, 50))),
        Row(f"{what}: until a killed worker's people go on, longest", float(np.max(back))),
        Row(f"{what}: processor of front and workers", spent.served / seconds, unit="cores"),
        Row(f"{what}: processor of the trainees' own program", spent.own / seconds, unit="cores"),
        Row(f"{what}: load of the machine", loaded, unit=""),
    ]


class Spent:
    """Processor time since `begin`: of this program, and of front and workers, those that are killed included."""

    def __init__(self, server: Started):
        self._server, self._begun, self.served = server, 0.0, 0.0
        self._seen: dict[int, float] = {}
        self.begin()

    def begin(self) -> None:
        """Forgets what was spent so far."""
        self.look()
        self._begun, self.served = time.process_time(), 0.0

    @property
    def own(self) -> float:
        """Seconds of this program."""
        return time.process_time() - self._begun

    def look(self) -> None:
        """Adds what was spent since the last look; one who will be killed is looked at just before."""
        for process in (self._server.process.pid, *self._server.workers()):
            with suppress(FileNotFoundError):
                spent = processor_of(process)
                self.served += spent - self._seen.get(process, 0.0)
                self._seen[process] = spent


async def _class(
    server: Started, tally: Tally, trainees: int, seconds: float, kill_every: float, spent: Spent
) -> tuple[float, int]:
    """Seconds until all were in, and how many processes were killed."""
    people = [Trainee(server, tally) for _ in range(trainees)]
    begun = time.perf_counter()
    tasks = [asyncio.create_task(person.learn()) for person in people]
    await asyncio.gather(*(person.came.wait() for person in people))
    spent.begin()
    tally.trips.clear()
    coming, kills = time.perf_counter() - begun, 0
    tally.end = begun + coming + seconds
    while kill_every and time.perf_counter() + kill_every < tally.end:
        await asyncio.sleep(kill_every)
        spent.look()
        serving = server.workers()
        if serving:
            os.kill(serving[kills % len(serving)], signal.SIGKILL)
            kills += 1
    await asyncio.gather(*tasks)
    spent.look()
    return coming, kills


if __name__ == "__main__":
    said = [float(word) for word in sys.argv[1:]]
    chosen: dict[str, Any] = dict(zip(("trainees", "seconds", "workers", "kill_every"), said, strict=False))
    for name in ("trainees", "workers"):
        chosen[name] = int(chosen.get(name, {"trainees": TRAINEES, "workers": WORKERS}[name]))
    for row in run(**chosen):
        print(f"{row.name}: {row.ours:.4g} {row.unit}")
