"""The same work on a Dask cluster: whoever dies there, each job comes back as one row.

A worker that is lost gives its jobs to another by Dask's own rules. A scheduler that is lost takes all jobs with it:
they are given to it anew when it is there again.
"""

from __future__ import annotations

import contextlib
import logging
import queue
import re
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError
from itertools import islice
from typing import TYPE_CHECKING, Any

from app.errors import InputError, one_line
from app.fleet.work import Job, OtherVersionError, Row, Settings, died, work

if TYPE_CHECKING:
    from distributed import Client, Future

#: What can be asked at all: Dask itself says so late, and leaves a trace of a client that never was.
_ADDRESS = re.compile(r"((tcp|tls|ucx|wss?)://)?(\[[0-9A-Fa-f:.%]+\]|[^\s/:\[\]]+):([0-9]{1,5})\Z")
_MOST_PORT = 65_535
_ANSWER = 10.0  # seconds a scheduler has to answer
_PATIENCE = 120.0  # seconds a scheduler that was there may be gone, or a cluster without a worker
_EXPECTED = "the address that `dask scheduler` prints, as tcp://HOST:8786"
_LOOK = 1.0  # seconds between two looks at a silent scheduler
_AHEAD, _LEAST = 3, 8  # jobs a thread has waiting; jobs at once where nobody works yet
_COUNTED = 10.0  # seconds between two counts of a cluster that may grow
_TRIES = 2  # times a job may be given up by the scheduler because its workers died


class Cluster:
    """The workers behind one scheduler.

    Args:
        address: the scheduler's, as tcp://HOST:8786.
        settings, version: what is asked of every file.
        say: told in a line when the scheduler or the workers are waited for.

    Raises:
        InputError: no address, Dask is not installed, or the scheduler does not answer.
    """

    def __init__(self, address: str, settings: Settings, version: str, say: Callable[[str], None]):
        at = _ADDRESS.match(address)
        if at is None or not 0 < int(at[4]) <= _MOST_PORT:
            raise InputError(f"{address!r} is no address", column="--scheduler", expected=_EXPECTED)
        self._address, self._settings, self._version, self._say = address, settings, version, say
        logging.getLogger("distributed").setLevel(
            logging.CRITICAL
        )  # what matters is said in a line of our own
        self._client: Client | None = self._connected()
        self._pending: dict[str, tuple[Future, Job]] = {}
        self._ready: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._given = 0

    def rows(self, jobs: Iterator[Job]) -> Iterator[Row]:
        """Rows in the order in which they are ready."""
        again: list[Job] = []
        tries: dict[str, int] = {}
        room, counted, heard = self._room(), time.monotonic(), time.monotonic()
        while True:
            if not self._alive():
                again += self._reconnected()
            while again and len(self._pending) < room:
                self._submit(again.pop())
            for job in islice(jobs, max(0, room - len(self._pending))):
                self._submit(job)
            if not self._pending:
                return
            now = time.monotonic()
            if now - counted > _COUNTED:
                room, counted = self._room(), now
            try:
                name = self._ready.get(timeout=_LOOK)
            except queue.Empty:
                if not self._alive():
                    continue
                if self._workers():
                    heard = time.monotonic()
                elif time.monotonic() - heard > _PATIENCE:
                    raise InputError(
                        "no worker came", file=self._address, expected="dask worker ..."
                    ) from None
                continue
            if name not in self._pending:  # of a scheduler that is gone
                continue
            heard = time.monotonic()
            future, job = self._pending.pop(name)
            row = self._row(future, job, tries)
            if row is None:
                again.append(job)
            else:
                tries.pop(job.key, None)
                yield row

    def close(self) -> None:
        """Lets go of the cluster; it goes on."""
        client, self._client = self._client, None
        if client is not None:
            with contextlib.suppress(Exception):  # whatever a dying connection says, there is nothing to do
                client.close(timeout=_LOOK)

    def _row(self, future: Future, job: Job, tries: dict[str, int]) -> Row | None:
        """What came of a job; None where it has to be done again."""
        from distributed.scheduler import KilledWorker

        try:
            if future.status in ("cancelled", "lost"):
                return None
            return future.result(timeout=_ANSWER)
        except KilledWorker:
            tries[job.key] = tries.get(job.key, 0) + 1
            return died(job, self._version, 0.0, self._settings.limit) if tries[job.key] >= _TRIES else None
        except OtherVersionError:
            raise
        except (ModuleNotFoundError, ImportError, AttributeError) as error:
            raise InputError(
                f"a worker cannot do this ({one_line(str(error), 120)})",
                file=self._address,
                expected=f"teachframe {self._version} on every worker",
            ) from None
        except (OSError, TimeoutError, CancelledError):
            return None
        except (
            RuntimeError
        ) as error:  # how a worker of other versions of Python or Dask says that it cannot read it
            raise InputError(
                f"the cluster did not do this ({one_line(str(error), 160)})",
                file=self._address,
                expected=f"teachframe {self._version} and the same Python on every worker",
            ) from None
        finally:
            with contextlib.suppress(Exception):
                future.release()

    def _submit(self, job: Job) -> None:
        assert self._client is not None
        self._given += 1
        name = f"teachframe-{job.key}-{self._given}"
        future = self._client.submit(work, job, self._settings, self._version, key=name, pure=False)
        self._pending[name] = (future, job)
        future.add_done_callback(lambda _: self._ready.put(name))

    def _room(self) -> int:
        return max(_LEAST, _AHEAD * sum(self._workers().values()))

    def _workers(self) -> dict[str, int]:
        """Worker -> its threads; none where nobody answers."""
        try:
            threads: Any = {} if self._client is None else self._client.nthreads()
            return dict(threads)
        except Exception:  # a connection that ends in the middle says so in many ways
            return {}

    def _alive(self) -> bool:
        client = self._client
        line = None if client is None else client.scheduler_comm
        return client is not None and client.status == "running" and line is not None and not line.closed()

    def _reconnected(self) -> list[Job]:
        """Waits for the scheduler; the jobs that it has forgotten."""
        self._say(f"{self._address} does not answer; waiting for it up to {_PATIENCE:g} s")
        lost = [job for _, job in self._pending.values()]
        self._pending.clear()
        self.close()
        end = time.monotonic() + _PATIENCE
        while True:
            try:
                self._client = self._connected()
            except InputError:
                if time.monotonic() > end:
                    raise
                time.sleep(_LOOK)
                continue
            self._say(f"{self._address} is there again; {len(lost)} recordings are given to it anew")
            return lost

    def _connected(self) -> Client:
        try:
            from dask import config
            from distributed import Client
        except ModuleNotFoundError as error:
            raise InputError(
                f"--scheduler needs the package {error.name}",
                column="--scheduler",
                expected="pip install 'teachframe[fleet]'",
            ) from None
        never: Any = {"distributed.client.scheduler-info-interval": "60s"}
        try:
            with config.set({"distributed.comm.timeouts.connect": f"{_ANSWER:g}s", **never}):
                return Client(self._address, timeout=_ANSWER, set_as_default=False, name="teachframe-fleet")
        except (OSError, TimeoutError, ValueError, TypeError) as error:
            raise InputError(
                f"the scheduler does not answer ({one_line(str(error), 120)})",
                column="--scheduler",
                expected=_EXPECTED,
            ) from None
