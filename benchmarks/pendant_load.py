"""Many trainees at once, each with a session, a scene and an arm of his own: processor, round trip, memory, page.

Run: python -m benchmarks pendant_load

The server is a process of its own; this one plays the pages. Each holds switch and button and jogs about axis 1, there
and back. The round trip is from a word of the page to its answer, over the socket on which the beats go.
"""

from __future__ import annotations

import asyncio
import random
import time
import urllib.request

import numpy as np

from app.shell.server import PAGES
from benchmarks._bare import bare
from benchmarks._page import Page, Served, enter
from benchmarks.rows import Row

TRAINEES, SECONDS = (1, 20, 40), 6.0
VISITS, TOGETHER = 200, 4
_MEGA = 1e6


def run() -> list[Row]:
    """Share of one core beside viser alone, round trip, memory; growth over 200 visits; weight of the page."""
    rows, alone = [], 0.0
    for count in TRAINEES:
        with Served() as served:
            share, trips, memory, way = asyncio.run(_load(served, count))
        alone = alone or way
        aimed = count == 20
        rows += [
            Row(f"{count} trainees: share of one core", share, unit="cores", aim=0.6 if aimed else None),
            Row(f"{count} trainees: share of its way that an arm lost", 1.0 - way / alone, unit="", aim=0.1),
            Row(f"{count} arms in viser alone: share of one core", bare(count, SECONDS), unit="cores"),
            Row(f"{count} trainees: round trip, p50", float(np.percentile(trips, 50))),
            Row(
                f"{count} trainees: round trip, p95",
                float(np.percentile(trips, 95)),
                aim=0.05 if aimed else None,
            ),
            Row(f"{count} trainees: memory of the server", memory / _MEGA, unit="MB"),
        ]
    with Served() as served:
        first = _first(served)
        asyncio.run(_visits(served, VISITS // 4))
        before = served.memory()
        asyncio.run(_visits(served, VISITS))
        grown = served.memory() - before
    weight = sum(path.stat().st_size for path in PAGES.iterdir())
    rows += [
        Row(f"memory grown over {VISITS} visits", max(grown, 0) / _MEGA, unit="MB", aim=20.0),
        Row("the page and all its files, loopback, a new session with its scene included", first, aim=1.0),
        Row("weight of the page without viser", weight / 1e3, unit="kB", aim=200.0),
    ]
    return rows


async def _load(served: Served, count: int) -> tuple[float, list[float], float, float]:
    """Share of one core, round trips [s], memory [bytes], and how far an arm went in the mean: one that is stopped
    because its words come late costs nothing."""
    pages = [await enter(served) for _ in range(count)]
    await asyncio.sleep(2.0 + 0.1 * count)  # screens are made, the first proposals computed
    trips: list[float] = []
    used, begun = served.processor(), time.perf_counter()
    await asyncio.gather(*(_work(page, trips) for page in pages))
    share = (served.processor() - used) / (time.perf_counter() - begun)
    memory, way = served.memory(), float(np.mean([page.way for page in pages]))
    for page in pages:
        await page.close()
    return share, trips, memory, way


async def _work(page: Page, trips: list[float]) -> None:
    end, sign = time.perf_counter() + SECONDS, 1
    while time.perf_counter() < end:
        held = asyncio.create_task(page.hold(1.0, 0, sign))
        for _ in range(3):
            await asyncio.sleep(0.3)
            n, sent = random.random(), time.perf_counter()
            await page.say(t="ping", n=n)
            while n not in page.pongs:
                await asyncio.sleep(0.001)
            trips.append(page.pongs.pop(n) - sent)
        await held
        sign = -sign


async def _visits(served: Served, count: int) -> None:
    async def visit(cookie: str) -> str:
        page = await enter(served, cookie)
        await page.close()
        return page.cookie

    cookies = [""] * TOGETHER
    for _ in range(count // TOGETHER):
        cookies = list(await asyncio.gather(*map(visit, cookies)))


def _first(served: Served) -> float:
    begun = time.perf_counter()
    for path in (
        "/",
        *(f"/static/{file.name}" for file in PAGES.iterdir() if file.suffix in (".js", ".css")),
    ):
        with urllib.request.urlopen(served.address + path) as answer:
            answer.read()
    return time.perf_counter() - begun
