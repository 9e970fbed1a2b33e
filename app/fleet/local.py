"""The work on this machine: one process a core, one thread each; a file that ends its process ends nothing else."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from itertools import islice

from app.diagnosis.batch import cores, worker_pool
from app.fleet.work import Job, Row, Settings, died, work

_AHEAD = 3  # jobs a process has waiting, so that none is idle


class Local:
    """All cores of this machine.

    Args:
        settings, version: what is asked of every file.
        processes: how many; None takes a process a core.
    """

    def __init__(self, settings: Settings, version: str, processes: int | None = None):
        self._settings, self._version = settings, version
        self.processes = processes or cores()

    def rows(self, jobs: Iterator[Job]) -> Iterator[Row]:
        """Rows in the order in which they are ready."""
        while True:
            with worker_pool(self.processes) as pool:
                pending: dict[Future[Row], Job] = {}
                try:
                    yield from self._through(pool, jobs, pending)
                    return
                except BrokenProcessPool:  # a process died: who did it shows only alone
                    ready = [f for f in pending if f.done() and f.exception() is None]
                    suspects = [job for future, job in pending.items() if future not in ready]
                except BaseException:  # whoever ends this does not wait for files that take long
                    for child in multiprocessing.active_children():
                        child.terminate()
                    raise
            yield from (future.result() for future in ready)
            for job in suspects:
                yield self._alone(job)

    def close(self) -> None:
        """Nothing stays open between files."""

    def _through(
        self, pool: ProcessPoolExecutor, jobs: Iterator[Job], pending: dict[Future[Row], Job]
    ) -> Iterator[Row]:
        while True:
            for job in islice(jobs, _AHEAD * self.processes - len(pending)):
                pending[self._submit(pool, job, pending)] = job
            if not pending:
                return
            done, _ = wait(pending, return_when=FIRST_COMPLETED)
            for future in done:
                row = future.result()
                del pending[future]
                yield row

    def _submit(self, pool: ProcessPoolExecutor, job: Job, pending: dict[Future[Row], Job]) -> Future[Row]:
        try:
            return pool.submit(work, job, self._settings, self._version)
        except BrokenProcessPool:
            pending[Future()] = job  # taken from the jobs already
            raise

    def _alone(self, job: Job) -> Row:
        begun = time.monotonic()
        with worker_pool(1) as pool:
            try:
                return pool.submit(work, job, self._settings, self._version).result()
            except BrokenProcessPool:
                return died(job, self._version, time.monotonic() - begun, self._settings.limit)
