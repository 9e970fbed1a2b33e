"""viser alone, in a process of its own: so many servers, each with an arm that turns thirty times a second.

No session, no guard, no figures, no words: what the pendant's load is set beside.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import threading
import time
from importlib.metadata import version
from multiprocessing.connection import Connection
from typing import Any

from websockets.asyncio.client import connect

from benchmarks._page import ROBOT, processor_of

HZ = 30.0
_SPEED = 0.5  # rad/s


def bare(count: int, seconds: float) -> float:
    """Share of one core that so many take."""
    ours, theirs = multiprocessing.Pipe()
    process = multiprocessing.get_context("spawn").Process(target=_serve, args=(count, theirs), daemon=True)
    process.start()
    try:
        ports = ours.recv()
        return asyncio.run(_watched(process.pid or 0, ports, seconds))
    finally:
        process.terminate()
        process.join(timeout=20.0)


async def _watched(pid: int, ports: list[int], seconds: float) -> float:
    protocol: Any = f"viser-v{version('viser')}"
    named: Any = {"subprotocols": [protocol], "compression": None, "max_size": None}
    sockets = [await connect(f"ws://127.0.0.1:{port}", **named) for port in ports]

    async def read(socket: Any) -> None:
        async for _ in socket:
            pass

    tasks = [asyncio.create_task(read(socket)) for socket in sockets]
    await asyncio.sleep(2.0)
    used, begun = processor_of(pid), time.perf_counter()
    await asyncio.sleep(seconds)
    share = (processor_of(pid) - used) / (time.perf_counter() - begun)
    for task in tasks:
        task.cancel()
    for socket in sockets:
        await socket.close()
    return share


def _serve(count: int, pipe: Connection) -> None:
    import viser

    from app.kinematics import load_robot
    from app.scene.arm import ArmView

    robot = load_robot(ROBOT)

    def turn(server: Any, arm: ArmView) -> None:
        q, due = robot.home.copy(), time.monotonic()
        while True:
            q[0] = robot.home[0] + _SPEED * (time.monotonic() % 1.0)
            with server.atomic():
                arm.set(q)
            due += 1.0 / HZ
            time.sleep(max(0.0, due - time.monotonic()))

    servers = [viser.ViserServer(host="127.0.0.1", port=0, verbose=False) for _ in range(count)]
    for server in servers:
        arm = ArmView(server.scene, robot)
        threading.Thread(target=turn, args=(server, arm), daemon=True).start()
    pipe.send([server.get_port() for server in servers])
    pipe.recv()
