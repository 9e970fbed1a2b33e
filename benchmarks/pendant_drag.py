"""From a drag at the handle to the scene's messages, on the server, against plain viser moving the same arm.

Run: python -m benchmarks.pendant_drag

Ours is the whole way: viser's event, the queue, the worker, inverse kinematics, the arm, the handle's pose, the numbers
on the page. The peer only turns the joints of `ViserUrdf`, without inverse kinematics and without anything else.
"""

from __future__ import annotations

import asyncio
import tempfile
import threading
import time
from pathlib import Path

import numpy as np
import viser
import yourdfpy
from viser.extras import ViserUrdf

from app.geometry import Pose
from app.pendant.client import Pendant
from app.pendant.server import PendantServer
from app.session import Store
from app.units import from_mm
from benchmarks._browser import Browser
from benchmarks.rows import Row

ROBOT = "ur10e"
EVENTS, HZ = 300, 30.0
CIRCLE = from_mm(120.0)


def run() -> list[Row]:
    """p50 and p95 of both, and of drawing alone."""
    with tempfile.TemporaryDirectory() as folder:
        server = PendantServer(Store(Path(folder)), port=0, robot=ROBOT)
        browser = Browser(server.port)
        try:
            pendant = _arrived(server)
            ours, drawing = _drags(pendant)
            peer = _plain_viser(pendant)
        finally:
            browser.close()
            server.stop()
    who = "viser ViserUrdf.update_cfg, no inverse kinematics"
    return [
        Row("drag event to scene message, p50", _at(ours, 50), _at(peer, 50), who),
        Row("drag event to scene message, p95", _at(ours, 95), _at(peer, 95), who, aim=5e-3),
        Row("arm drawn at a new pose, p50", _at(drawing, 50), _at(peer, 50), "viser ViserUrdf.update_cfg"),
    ]


def _at(seconds: list[float], share: float) -> float:
    return float(np.percentile(seconds, share))


def _arrived(server: PendantServer) -> Pendant:
    end = time.monotonic() + 20.0
    while time.monotonic() < end:
        if server.pendants and server.pendants[0].worker.idle(1.0):
            return server.pendants[0]
        time.sleep(0.02)
    raise RuntimeError("the pendant did not come up")


def _targets(pendant: Pendant) -> list[Pose]:
    start = pendant.world.tip(pendant.q)
    out = []
    for angle in np.linspace(0.0, 4.0 * np.pi, EVENTS):
        shift = CIRCLE * np.array([np.sin(angle), 1.0 - np.cos(angle), 0.5 * np.sin(2 * angle)])
        out.append(Pose.of(start.rotation, start.position + shift))
    return out


def _drags(pendant: Pendant) -> tuple[list[float], list[float]]:
    """Seconds from viser's event to the last scene message of each drag, and of drawing the arm alone."""
    done, drawn = threading.Event(), []
    follow, draw = pendant.dragging.follow, pendant.stage.arm.set

    def timed_follow(target: Pose) -> None:
        follow(target)
        done.set()

    def timed_draw(q: np.ndarray) -> None:
        start = time.perf_counter()
        draw(q)
        drawn.append(time.perf_counter() - start)

    pendant.dragging.follow = timed_follow  # type: ignore[method-assign]
    pendant.stage.arm.set = timed_draw  # type: ignore[method-assign]
    loop = pendant.client.gui._event_loop
    seconds = []
    for target in _targets(pendant):
        done.clear()
        start = time.perf_counter()
        asyncio.run_coroutine_threadsafe(_event(pendant, target), loop)
        done.wait(5.0)
        seconds.append(time.perf_counter() - start)
        time.sleep(max(0.0, 1.0 / HZ - seconds[-1]))
    pendant.dragging.follow, pendant.stage.arm.set = follow, draw  # type: ignore[method-assign]
    return seconds, drawn


async def _event(pendant: Pendant, target: Pose) -> None:
    pendant.dragging.event("update", target)


def _plain_viser(pendant: Pendant) -> list[float]:
    """Seconds of one `update_cfg` for the same robot, in a server of its own with a browser connected."""
    robot = pendant.model
    description = yourdfpy.URDF.load(str(robot.path), build_scene_graph=True, load_meshes=False)
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    browser = Browser(server.get_port())
    arm = ViserUrdf(server, description)
    rng = np.random.default_rng(0)
    seconds = []
    for q in robot.home + 0.2 * np.cumsum(rng.normal(0.0, 0.05, (EVENTS, robot.joint_count)), axis=0):
        start = time.perf_counter()
        with server.atomic():
            arm.update_cfg(q)
        seconds.append(time.perf_counter() - start)
        time.sleep(max(0.0, 1.0 / HZ - seconds[-1]))
    browser.close()
    server.stop()
    return seconds


if __name__ == "__main__":
    from benchmarks.__main__ import main

    main(["pendant_drag"])
