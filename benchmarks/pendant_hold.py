"""From a press to the first motion seen, and from the last word of a page to the last pose of its arm.

Run: python -m benchmarks pendant_hold

The first over both sockets of a server in a process of its own; the second inside one process, where the last pose can
be timed: a page says that it holds switch and button, and then nothing more, while other threads take the processor.
"""

from __future__ import annotations

import asyncio
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

from benchmarks._page import Page, Served, enter
from benchmarks.rows import Row

PRESSES, FREEZES, BUSY = 60, 1000, 2
STANDS_WITHIN, MOVES_WITHIN = 0.2, 0.06  # s


def run() -> list[Row]:
    """p50 and p95 of press to motion; the longest way from silence to standstill in 1,000."""
    with Served() as served:
        moved = asyncio.run(_presses(served))
    stood = _freezes()
    return [
        Row("press to motion seen on the page, p50", float(np.percentile(moved, 50))),
        Row("press to motion seen on the page, p95", float(np.percentile(moved, 95)), aim=MOVES_WITHIN),
        Row(f"silence to standstill, p50 of {FREEZES}", float(np.percentile(stood, 50))),
        Row(f"silence to standstill, longest of {FREEZES}", float(np.max(stood)), aim=STANDS_WITHIN),
    ]


async def _presses(served: Served) -> list[float]:
    page = await enter(served)
    await asyncio.sleep(1.0)
    times = []
    for number in range(PRESSES):
        await asyncio.sleep(0.3)
        times.append(await _press(page, 1 if number % 2 else -1))
    await page.close()
    return times


async def _press(page: Page, sign: int) -> float:
    page.moved.clear()
    begun = time.perf_counter()
    held = asyncio.create_task(page.hold(0.25, 0, sign))
    await page.moved.wait()
    took = time.perf_counter() - begun
    await held
    return took


def _freezes() -> list[float]:
    from app.session import Store
    from app.session.owners import owner_of
    from app.workers.hub import Hub

    ended = threading.Event()
    load = [threading.Thread(target=_busy, args=(ended,), daemon=True) for _ in range(BUSY)]
    with tempfile.TemporaryDirectory() as folder:
        hub = Hub(Store(Path(folder)), robot="ur10e")
        live = hub.enter(owner_of("a person's own"))
        drive, shown = live.context.drive, [0.0]
        show = drive.show

        def seen(q: np.ndarray) -> None:
            shown[0] = time.monotonic()  # from here on the arm stands there; drawing it comes after
            show(q)

        drive.show = seen  # type: ignore[method-assign]
        time.sleep(2.0)
        for thread in load:
            thread.start()
        times = []
        for number in range(FREEZES):
            live.beat(False, None, 0, 0)
            live.beat(True, 0, 1 if number % 2 else -1, number + 1)
            last = time.monotonic()
            time.sleep(0.25)
            times.append(max(shown[0] - last, 0.0))
        ended.set()
        hub.close()
    return times


def _busy(ended: threading.Event) -> None:
    """Takes the processor, and the interpreter with it, as other sessions do."""
    matrix = np.random.default_rng(0).normal(size=(60, 60))
    while not ended.is_set():
        np.linalg.svd(matrix)
        sum(range(2000))
        time.sleep(0.001)
