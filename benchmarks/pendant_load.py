"""Many trainees at once, each with a session, an arm and a cell of their own: processor, round trip, memory.

Run: python -m benchmarks pendant_load

The server is a process of its own; this one plays the browsers. Each drags its arm about axis 1 at 25 events a second:
the way of a jog with its inverse kinematics and collision check. The round trip is from an event to the message that
draws the very angle it asked for; latest-wins may leave events out, which are then not counted.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import tempfile
import time
from dataclasses import dataclass, field
from importlib.metadata import version
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import zstandard
from websockets.asyncio.client import ClientConnection, connect

from app.geometry import Pose, exp_so3, quaternion_from_rotation
from app.kinematics import load_robot
from app.simulation.world import default_world
from benchmarks.rows import Row

ROBOT, HZ, SECONDS = "ur10e", 25.0, 6.0
TRAINEES = (1, 5, 10, 20, 40)
VISITS, TOGETHER = 200, 4
SWING, PERIOD_S = 0.25, 4.0  # rad about axis 1, and how long there and back takes
_MATCH = 2e-5  # rad: an angle drawn is the angle asked for
_PAGE = os.sysconf("SC_PAGE_SIZE")
_TICKS = os.sysconf("SC_CLK_TCK")
_MEGA = 1e6


def run() -> list[Row]:
    """Share of one core, p50 and p95 of the round trip, memory; and growth over 200 visits."""
    rows = []
    for count in TRAINEES:
        with _Server() as server:
            share, trips, memory = asyncio.run(_load(server, count))
        aimed = count == 20
        who = f"{count} trainees"
        rows += [
            Row(f"{who}: share of one core", share, unit="cores", aim=0.5 if aimed else None),
            Row(f"{who}: round trip, p50", float(np.percentile(trips, 50))),
            Row(f"{who}: round trip, p95", float(np.percentile(trips, 95)), aim=0.05 if aimed else None),
            Row(f"{who}: memory of the server", memory / _MEGA, unit="MB"),
        ]
    with _Server() as server:
        asyncio.run(_visits(server, VISITS // 4))
        before = server.memory()
        asyncio.run(_visits(server, VISITS))
        grown = server.memory() - before
    rows.append(Row(f"memory grown over {VISITS} visits", max(grown, 0) / _MEGA, unit="MB", aim=20.0))
    return rows


class _Server:
    """The pendant in a process of its own."""

    def __enter__(self) -> _Server:
        ours, theirs = multiprocessing.Pipe()
        self._folder = tempfile.TemporaryDirectory()
        context = multiprocessing.get_context("spawn")
        self._process = context.Process(target=_serve, args=(self._folder.name, theirs), daemon=True)
        self._process.start()
        self.port = ours.recv()
        self._ours = ours
        return self

    def __exit__(self, *_: object) -> None:
        self._ours.send("stop")
        self._process.join(timeout=20.0)
        self._folder.cleanup()

    def processor(self) -> float:
        """Seconds of processor used so far."""
        stat = Path(f"/proc/{self._process.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
        return (int(stat[11]) + int(stat[12])) / _TICKS

    def memory(self) -> float:
        """Bytes in memory."""
        return int(Path(f"/proc/{self._process.pid}/statm").read_text(encoding="ascii").split()[1]) * _PAGE


def _serve(folder: str, pipe: Connection) -> None:
    from app.pendant.server import PendantServer
    from app.session import Store

    server = PendantServer(Store(Path(folder)), port=0, robot=ROBOT)
    pipe.send(server.port)
    pipe.recv()
    server.stop()


@dataclass
class _Trainee:
    """One browser without a screen."""

    socket: ClientConnection
    handle: str = ""
    owner: str = ""
    angle: float | None = None  # of axis 1, as drawn last
    asked: list[tuple[float, float]] = field(default_factory=list)
    trips: list[float] = field(default_factory=list)
    _unpack: zstandard.ZstdDecompressor = field(default_factory=zstandard.ZstdDecompressor)

    async def send(self, kind: str, **fields: Any) -> None:
        await self.socket.send(msgspec.msgpack.encode({"type": kind, **fields}))

    async def listen(self) -> None:
        async for data in self.socket:
            if isinstance(data, bytes):
                size, packed = int.from_bytes(data[:8], "little"), int.from_bytes(data[8:16], "little")
                text = self._unpack.decompress(data[16 : 16 + packed], max_output_size=size)
                now = time.perf_counter()
                for message in msgspec.msgpack.decode(text)["messages"]:
                    await self._hear(message, now)

    async def _hear(self, message: dict[str, Any], now: float) -> None:
        kind = message["type"]
        if kind == "SetOrientationMessage" and message["name"].endswith("/joint1"):
            w, _, _, z = message["wxyz"]
            self.angle = 2.0 * float(np.arctan2(z, w))
            turned = [(sent, abs((self.angle - a + np.pi) % (2 * np.pi) - np.pi)) for sent, a in self.asked]
            met = [sent for sent, off in turned if off < _MATCH]
            if met:
                self.trips.append(now - met[-1])
                self.asked = [(sent, a) for sent, a in self.asked if sent > met[-1]]
        elif kind == "TransformControlsMessage" and message["name"] == "/handle":
            self.handle, self.owner = message["name"], message.get("owner", "")
        elif kind == "LocalStorageGetItemRequestMessage":
            uuid = message["request_uuid"]
            await self.send("LocalStorageGetItemResponseMessage", value=None, error=None, request_uuid=uuid)

    async def drag(self, seconds: float) -> None:
        """There and back about axis 1."""
        world = default_world(load_robot(ROBOT))
        home = world.robot.home
        start, begun = world.hand(home), time.perf_counter()
        await self.send("TransformControlsDragStartMessage", name=self.handle, owner=self.owner)
        while (now := time.perf_counter()) < begun + seconds:
            angle = SWING * float(np.sin(2 * np.pi * (now - begun) / PERIOD_S))
            turn = exp_so3(np.array([0.0, 0.0, angle]))
            aim = Pose.of(turn @ start.rotation, turn @ start.position)
            self.asked.append((now, float(home[0]) + angle))
            del self.asked[:-50]
            wxyz = quaternion_from_rotation(aim.rotation)
            await self.send(
                "TransformControlsUpdateMessage",
                name=self.handle,
                owner=self.owner,
                wxyz=tuple(map(float, wxyz)),
                position=tuple(map(float, aim.position)),
            )
            await asyncio.sleep(max(0.0, 1.0 / HZ - (time.perf_counter() - now)))
        await self.send("TransformControlsDragEndMessage", name=self.handle, owner=self.owner)


async def _enter(port: int) -> tuple[_Trainee, asyncio.Task[None]]:
    protocol: Any = f"viser-v{version('viser')}"
    socket = await connect(f"ws://127.0.0.1:{port}", subprotocols=[protocol], max_size=None, compression=None)
    trainee = _Trainee(socket)
    task = asyncio.create_task(trainee.listen())
    view = {"wxyz": (1.0, 0.0, 0.0, 0.0), "position": (2.0, 2.0, 2.0), "look_at": (0.0, 0.0, 0.0)}
    lens = {"fov": 0.8, "near": 0.01, "far": 100.0, "image_height": 800, "image_width": 600}
    await trainee.send("ViewerCameraMessage", **view, **lens, up_direction=(0.0, 0.0, 1.0))
    end = time.perf_counter() + 60.0
    while not trainee.handle:
        if time.perf_counter() > end:
            raise RuntimeError("the pendant did not come up")
        await asyncio.sleep(0.02)
    return trainee, task


async def _load(server: _Server, count: int) -> tuple[float, list[float], float]:
    entered = [await _enter(server.port) for _ in range(count)]
    await asyncio.sleep(2.0 + 0.1 * count)  # pages are made, the first proposals computed
    used, begun = server.processor(), time.perf_counter()
    await asyncio.gather(*(trainee.drag(SECONDS) for trainee, _ in entered))
    share = (server.processor() - used) / (time.perf_counter() - begun)
    memory = server.memory()
    trips = [trip for trainee, _ in entered for trip in trainee.trips]
    for trainee, task in entered:
        await trainee.socket.close()
        task.cancel()
    if not trips:
        raise RuntimeError("no event came back as a drawing")
    return share, trips, memory


async def _visits(server: _Server, count: int) -> None:
    for _ in range(count // TOGETHER):
        entered = await asyncio.gather(*(_enter(server.port) for _ in range(TOGETHER)))
        for trainee, task in entered:
            await trainee.socket.close()
            task.cancel()
    await asyncio.sleep(3.0)


if __name__ == "__main__":
    for row in run():
        print(f"{row.name:40s} {row.ours:10.4g} {row.unit}")
