"""Several processes that serve behind one front: one that ends is started again; all end together."""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import logging
import math
import multiprocessing
import os
import shutil
import signal
import socket
import ssl
import sys
import tempfile
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

from app.errors import InputError
from app.shell.floods import Flow
from app.shell.front import LARGEST_HEAD, Front
from app.shell.worker import Plan, work

_ENDING = 8.0  # seconds a worker has to keep where its arms stand
_TOGETHER = 5.0  # seconds the first worker waits for the others when all are started
_SHORT = 10.0  # seconds: one that ended sooner is started again after a pause that doubles, up to the longest
_PAUSE, _LONGEST = 0.1, 10.0
#: Workers are forked from a process that has read the program once and does nothing else; elsewhere (Windows) each
#: reads it itself.
_FORKED = "forkserver" in multiprocessing.get_all_start_methods()


class Supervisor:
    """The workers and their front.

    Args:
        plan: what they serve.
        count: how many.
        listening: where browsers come.
        flow: counts requests of all of them together; None where nobody is counted.
    """

    def __init__(self, plan: Plan, count: int, listening: socket.socket, flow: Flow | None = None):
        self._plan, self._listening = plan, listening
        self._folder = Path(tempfile.mkdtemp(prefix="teachframe-"))  # for its owner alone
        forks: Any = multiprocessing.get_context("forkserver" if _FORKED else "spawn")
        if _FORKED:
            forks.set_forkserver_preload(["app.shell.worker", "app.workers.warm"])
        self._workers = [
            _Worker(plan, self._folder / f"{n}.sock", n + 1, forks, self._ended) for n in range(count)
        ]
        way = plan.way
        sockets = [worker.path for worker in self._workers]
        self._front = Front(
            sockets,
            self._ready,
            self._number,
            _trusted(way.proxy),
            secure=way.certificate is not None,
            flow=flow,
        )
        self._ending = asyncio.Event()
        self._first = math.inf  # when the first worker was ready, by the monotonic clock
        self._begun = False  # people are taken in

    def _ready(self, number: int) -> bool:
        """True where a worker runs. None does before all have come up: the first would get everybody who waits."""
        if not self._begun:
            up = [worker.ready for worker in self._workers]
            if any(up):
                self._first = min(self._first, time.monotonic())
            self._begun = all(up) or time.monotonic() - self._first > _TOGETHER
        return self._begun and self._workers[number].ready

    def _ended(self, number: int) -> None:
        self._front.spread.ended(number - 1)

    def _number(self, process: int) -> int | None:
        found = (n for n, worker in enumerate(self._workers) if worker.ready and worker.process == process)
        return next(found, None)

    def run(self) -> None:
        """Serves until SIGTERM or SIGINT; then all of it ends."""
        logging.getLogger("asyncio").setLevel(logging.CRITICAL)  # browsers that go in the midst of something
        asyncio.run(self._run())

    async def _run(self) -> None:
        loop = asyncio.get_running_loop()
        for number in (signal.SIGTERM, signal.SIGINT):
            loop.add_signal_handler(number, self._ending.set)
        keeping = [asyncio.create_task(worker.keep(self._ending)) for worker in self._workers]
        server = await asyncio.start_server(
            self._front.serve, sock=self._listening, ssl=_tls(self._plan), limit=LARGEST_HEAD, backlog=1024
        )
        try:
            await self._ending.wait()
        finally:
            server.close()
            await asyncio.gather(*keeping, return_exceptions=True)
            shutil.rmtree(self._folder, ignore_errors=True)


class _Worker:
    """One process, over and over.

    Args:
        number: for people, from 1.
        forks: makes processes.
        ended: told the number whenever the process has ended.
    """

    def __init__(self, plan: Plan, path: Path, number: int, forks: Any, ended: Callable[[int], None]):
        self._plan, self.path, self._number, self._forks = plan, path, number, forks
        self._ended = ended
        self.ready = False
        self.process: int | None = None

    async def keep(self, ending: asyncio.Event) -> None:
        """Starts it, and starts it again, until the end."""
        pause = _PAUSE
        while not ending.is_set():
            begun = time.monotonic()
            try:
                process, pipe = await asyncio.to_thread(self._started)
            except OSError as error:  # no memory, no more processes: it may pass
                print(
                    f"worker {self._number} cannot be started ({error.strerror})", file=sys.stderr, flush=True
                )
                await asyncio.sleep(_LONGEST)
                continue
            self.process = process.pid
            await self._watch(process, pipe, ending)
            self.ready = False
            self._ended(self._number)
            pipe.close()
            if ending.is_set():
                await asyncio.to_thread(_end, process)
                return
            process.join()
            pause = min(2 * pause, _LONGEST) if time.monotonic() - begun < _SHORT else _PAUSE
            said = f"worker {self._number} ended ({_how(process.exitcode)}); it is started again"
            print(said, file=sys.stderr, flush=True)
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(ending.wait(), pause)

    def _started(self) -> tuple[BaseProcess, Connection]:
        ours, theirs = self._forks.Pipe()
        process = self._forks.Process(
            target=work, args=(self._plan, self.path, theirs), name=f"worker {self._number}"
        )
        process.start()
        theirs.close()
        return process, ours

    async def _watch(self, process: BaseProcess, pipe: Connection, ending: asyncio.Event) -> None:
        """Until the process or everything ends."""
        loop, over = asyncio.get_running_loop(), asyncio.Event()
        loop.add_reader(process.sentinel, over.set)
        loop.add_reader(pipe.fileno(), self._told, pipe)
        waiting = [asyncio.create_task(event.wait()) for event in (over, ending)]
        try:
            await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in waiting:
                task.cancel()
            loop.remove_reader(process.sentinel)
            loop.remove_reader(pipe.fileno())

    def _told(self, pipe: Connection) -> None:
        try:
            self.ready = pipe.recv() == "ready"
        except (EOFError, OSError):
            asyncio.get_running_loop().remove_reader(pipe.fileno())


def _end(process: BaseProcess) -> None:
    process.terminate()
    process.join(_ENDING)
    if process.is_alive():
        process.kill()
        process.join()


def _how(code: int | None) -> str:
    if code is not None and code < 0:
        with contextlib.suppress(ValueError):
            return signal.Signals(-code).name
    return f"exit code {code}"


def _trusted(proxy: bool) -> Callable[[str], bool]:
    """Where a proxy stands: on this machine, or where FORWARDED_ALLOW_IPS says, as uvicorn reads it."""
    said = os.environ.get("FORWARDED_ALLOW_IPS", "127.0.0.1,::1") if proxy else ""
    networks = []
    for part in filter(None, map(str.strip, said.split(","))):
        try:
            networks += [ipaddress.ip_network(p) for p in (("0.0.0.0/0", "::/0") if part == "*" else (part,))]
        except ValueError:
            raise InputError(
                f"found {part!r}",
                column="FORWARDED_ALLOW_IPS",
                expected="addresses or networks, comma-separated",
            ) from None

    def trusted(address: str) -> bool:
        peer = ipaddress.ip_address(address.partition("%")[0])
        return any(peer in network for network in networks)

    return trusted


def _tls(plan: Plan) -> ssl.SSLContext | None:
    if plan.way.certificate is None:
        return None
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(plan.way.certificate, plan.way.key)
    return context
