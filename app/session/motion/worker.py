"""One worker a session: everything that changes a pendant happens on its thread, in order.

A browser's callbacks only put work in: clicks first-in-first-out, poses and sliders latest-wins. What fails is
told to the operator; it never ends the worker.
"""

from __future__ import annotations

import functools
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

Job = Callable[[], object]

#: Ticks a second of motions that run by themselves; and of all arms of a process that move at once, together. One
#: interpreter can do some 600 with all that hangs on them: where more arms want to move each goes in longer steps, and
#: no page's words come late.
TICK_HZ, TOGETHER_HZ = 30.0, 400.0

#: Held for a tick of any arm of this process. Threads that reckon at once only take the interpreter from each other,
#: and each that wants it adds to what a word of a page waits: 20 arms that jog at once made that half a second, and
#: the switch of some fell silent.
_TICKING = threading.Lock()
#: Workers of this process with motions.
_MOVING: set[Worker] = set()


@dataclass
class _Entry:
    job: Job
    slot: str | None  # None: a click, always done


class Worker:
    """A thread with a queue and, beside it, motions that run by themselves.

    Args:
        name: for the thread.
        around: called with every job; does it, and tells the operator what failed.
    """

    def __init__(self, name: str, around: Callable[[Job], None]):
        self._around = around
        self._queue: deque[_Entry] = deque()
        self._motions: dict[str, Iterator[None]] = {}
        self._timers: dict[str, tuple[float, Job]] = {}
        self._wake = threading.Condition()
        self._stopped = False
        self._busy = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def post(self, job: Job) -> None:
        """Does `job` after everything put in before."""
        self._put(_Entry(job, None))

    def latest(self, slot: str, job: Job) -> None:
        """Like `post`, but replaces what waits under the same slot unless a click came in between."""
        self._put(_Entry(job, slot))

    def _put(self, entry: _Entry) -> None:
        with self._wake:
            if entry.slot is not None:
                for waiting in reversed(self._queue):
                    if waiting.slot is None:
                        break
                    if waiting.slot == entry.slot:
                        waiting.job = entry.job
                        return
            self._queue.append(entry)
            self._wake.notify()

    def animate(self, name: str, steps: Iterator[None]) -> None:
        """Runs a motion tick by tick beside the queue; another one of the same name replaces it.

        Only for jobs: call it on the worker's own thread.
        """
        with self._wake:
            self._motions[name] = steps
            _MOVING.add(self)
            self._wake.notify()

    def later(self, name: str, seconds: float, job: Job) -> None:
        """Does `job` once, in so many seconds; what waits under the same name is given up for it."""
        with self._wake:
            self._timers[name] = (time.monotonic() + seconds, job)
            self._wake.notify()

    def waits(self, name: str) -> bool:
        """True while something waits for its time under this name."""
        return name in self._timers

    def halt(self, name: str | None = None) -> None:
        """Ends one motion or what waits under its name, or all."""
        with self._wake:
            for key in [name] if name is not None else [*self._motions, *self._timers]:
                self._motions.pop(key, None)
                self._timers.pop(key, None)
            self._count()

    def running(self, name: str) -> bool:
        """True while the motion of this name runs."""
        return name in self._motions

    def idle(self, timeout: float = 10.0) -> bool:
        """Waits until nothing is waiting, being done or moving; False where it took longer."""
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            with self._wake:
                if not (self._queue or self._busy or self._motions or self._timers):
                    return True
            time.sleep(0.005)
        return False

    def stop(self) -> None:
        """Ends the thread after the job it is doing; what still waits is dropped."""
        with self._wake:
            self._stopped = True
            self._queue.clear()
            self._motions.clear()
            self._timers.clear()
            self._count()
            self._wake.notify()
        if threading.current_thread() is not self._thread:
            self._thread.join(timeout=5.0)

    def _run(self) -> None:
        next_tick = time.monotonic()
        while True:
            with self._wake:
                while not self._queue and not self._stopped:
                    due = [when for when, _ in self._timers.values()] + [next_tick] * bool(self._motions)
                    if not due:
                        self._wake.wait()
                    elif (wait := min(due) - time.monotonic()) > 0:
                        self._wake.wait(wait)
                    else:
                        break
                if self._stopped:
                    return
                now = time.monotonic()
                for name in [name for name, (when, _) in self._timers.items() if when <= now]:
                    self._queue.append(_Entry(self._timers.pop(name)[1], None))
                job = self._queue.popleft().job if self._queue else None
                self._busy = True
            if job is not None:
                self._around(job)
            now = time.monotonic()
            if self._motions and now >= next_tick:
                with _TICKING:
                    self._around(self._tick)
                next_tick = max(next_tick + max(1.0 / TICK_HZ, len(_MOVING) / TOGETHER_HZ), now)
            with self._wake:
                self._busy = False

    def _tick(self) -> None:
        """One step of each motion; what fails is told when all have had theirs."""
        failed: list[Exception] = []
        for name, steps in list(self._motions.items()):
            try:
                next(steps)
            except StopIteration:
                self._end(name, steps)
            except Exception as error:
                self._end(name, steps)
                failed.append(error)
        for error in failed[1:]:
            self._around(functools.partial(_raise, error))
        if failed:
            raise failed[0]

    def _end(self, name: str, steps: Iterator[None]) -> None:
        """Forgets a motion unless another has taken its name meanwhile."""
        with self._wake:
            if self._motions.get(name) is steps:
                del self._motions[name]
            self._count()

    def _count(self) -> None:
        """Motions were taken away: without any this arm takes no share of the ticks."""
        if not self._motions:
            _MOVING.discard(self)


def _raise(error: Exception) -> None:
    raise error
