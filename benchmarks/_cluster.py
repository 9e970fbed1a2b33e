"""A Dask cluster of processes of its own, of which any may be killed: whoever is missing is started again, as a
deployer's service does."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

_ROOT = Path(__file__).parents[1]  # the program whose work it is
_TICKS = os.sysconf("SC_CLK_TCK")


class Cluster:
    """A scheduler and its workers on this machine.

    Args:
        workers: how many, one thread each.
        folder: for logs and what workers spill.
    """

    def __init__(self, workers: int, folder: Path):
        self._folder, self._stopping, self._spent = folder, threading.Event(), 0.0
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        dask = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--no-dashboard"]
        self._commands = {"scheduler": [*dask, "--host", "127.0.0.1", "--port", str(self.port)]}
        worker = [sys.executable, "-m", "distributed.cli.dask_worker", self.address, "--nthreads", "1"]
        for number in range(workers):
            more = ["--no-dashboard", "--local-directory", str(folder), "--no-nanny"]
            self._commands[f"worker {number}"] = [*worker, *more]
        self._processes = {name: self._start(name) for name in self._commands}
        self._keeper = threading.Thread(target=self._keep, daemon=True)
        self._keeper.start()

    @property
    def address(self) -> str:
        return f"tcp://127.0.0.1:{self.port}"

    def kill(self, name: str) -> None:
        """Without a chance to say anything."""
        self._processes[name].send_signal(signal.SIGKILL)

    def processor(self) -> float:
        """Seconds of processor that all of them have used, those that are gone too."""
        return self._spent + sum(map(_used, self._processes.values()))

    def stop(self) -> None:
        self._stopping.set()
        self._keeper.join()
        for process in self._processes.values():
            process.kill()
            process.wait()

    def _start(self, name: str) -> subprocess.Popen[bytes]:
        log = (self._folder / f"{name}.log").open("ab")
        alone = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(_ROOT)}
        return subprocess.Popen(
            self._commands[name], stdout=log, stderr=log, env={**os.environ, **alone}, cwd=self._folder
        )

    def _keep(self) -> None:
        while not self._stopping.wait(0.5):
            for name, process in self._processes.items():
                if process.poll() is not None:
                    time.sleep(1.0)
                    self._processes[name] = self._start(name)


def _used(process: subprocess.Popen[bytes]) -> float:
    try:
        stat = Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    except OSError:
        return 0.0
    return sum(int(stat[i]) for i in (11, 12)) / _TICKS
