"""What it costs that an action is on the disk before it counts: a row in the database, against a line in a file.

Run: python -m benchmarks session_store
"""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from pathlib import Path

import msgspec

from app.session import Session, Store
from app.session.actions import Move
from app.session.journal import Entry
from benchmarks.rows import Row

ACTIONS = 300


def run() -> list[Row]:
    """Takes turns, action by action, so that the disk is as busy for both; medians."""
    with tempfile.TemporaryDirectory() as folder:
        store = Store(Path(folder))
        kept, free = store.create(robot="ur10e"), Session(robot="ur10e")
        file = (Path(folder) / "plain.jsonl").open("wb", buffering=0)
        actions = [Move((1.0 + 1e-4 * k, *kept.state.q[1:])) for k in range(ACTIONS)]
        times: dict[str, list[float]] = {"store": [], "file": [], "memory": []}
        for number, action in enumerate(actions, 1):
            times["store"].append(_seconds(lambda action=action: kept.do(action)))
            times["memory"].append(_seconds(lambda action=action: free.do(action)))
            entry = Entry(number, time.time(), action)
            times["file"].append(_seconds(lambda entry=entry: _line(file, entry)))
        opening = _seconds(lambda: store.open(kept.name))
        file.close()
        store.database.close()
    middle = {key: statistics.median(values) for key, values in times.items()}
    plain = middle["file"] + middle["memory"]
    return [
        Row("an action, on the disk before it counts", middle["store"], plain, "a line in a file and fsync"),
        Row("the same without a disk", middle["memory"]),
        Row(f"opening a session of {ACTIONS} actions", opening, aim=0.1),
    ]


def _line(file, entry: Entry) -> None:
    file.write(msgspec.json.encode(entry) + b"\n")
    os.fsync(file.fileno())


def _seconds(job) -> float:
    start = time.perf_counter()
    job()
    return time.perf_counter() - start
