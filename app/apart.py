"""A job in a process of its own: it cannot stop the others, and what it may use is bounded.

What somebody sends is read here: a file that takes minutes, gigabytes or the interpreter with it ends its own process,
and nobody else notices. The process is forked from a small server that has read the program once, so that a job begins
after some 20 ms; where there is no such server (Windows), each job starts an interpreter.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from app.errors import InputError, TeachframeError

Say = Callable[[float, str], None]

_FORKED = "forkserver" in multiprocessing.get_all_start_methods()
_CONTEXT: Any = multiprocessing.get_context("forkserver" if _FORKED else "spawn")
_PREPARED: dict[str, None] = {}  # a process has one small server, whoever asks for it
_LOOK = 0.05  # seconds between two looks at whether the job was given up
_ENDING = 10.0  # seconds by the clock in which a process that closed its pipe has said how it ended
_GIB = 1 << 30
_POLITE = 5  # how much later than the server's own threads it gets its turn, as `nice` counts


class GivenUpError(TeachframeError):
    """Somebody stopped the job."""


@dataclass(frozen=True, eq=False)
class Bounds:
    """What a kind of job may use.

    Args:
        seconds: of the processor.
        patience: seconds by the clock, a busy machine's too.
        memory: bytes beyond what the program itself needs.
        seats: jobs of this kind at a time; the next ones wait.
    """

    seconds: int
    patience: float
    memory: int
    seats: int
    _seats: threading.BoundedSemaphore = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_seats", threading.BoundedSemaphore(self.seats))

    @contextlib.contextmanager
    def seat(self, stop: threading.Event) -> Iterator[None]:
        """Waits for a seat; raises GivenUpError where the job was given up meanwhile."""
        while not self._seats.acquire(timeout=_LOOK):
            if stop.is_set():
                raise GivenUpError("given up")
        try:
            yield
        finally:
            self._seats.release()


#: A tool frame, points, a model, a journal: at most some megabytes.
SMALL = Bounds(seconds=20, patience=120.0, memory=1 * _GIB, seats=4)
#: A robot's description with its meshes.
DESCRIPTION = Bounds(seconds=60, patience=600.0, memory=2 * _GIB, seats=2)
#: A recording of up to 400 MB with its robot.
RECORDING = Bounds(seconds=300, patience=1800.0, memory=3 * _GIB, seats=2)
#: The search for what a simulation leaves out.
SEARCH = Bounds(seconds=3600, patience=4 * 3600.0, memory=3 * _GIB, seats=2)


def prepare(modules: Sequence[str]) -> None:
    """Modules that the small server reads before the first job, besides those it was told of; to be said before it."""
    if _FORKED:
        _PREPARED.update(dict.fromkeys(modules))
        _CONTEXT.set_forkserver_preload(list(_PREPARED))


def apart(
    job: Callable[..., Any],
    *args: Any,
    bounds: Bounds,
    say: Say | None = None,
    stop: threading.Event | None = None,
) -> Any:
    """Does `job(*args)` in a process of its own, and waits for it.

    Args:
        job: a function of a module; where `say` is given it gets one as its last argument.
        args: what can be pickled.
        bounds: what it may use.
        say: called on this thread with the share done (0..1) and what is being done.
        stop: set by anybody to give the job up.

    Returns:
        What the job returned.

    Raises:
        GivenUpError: `stop` was set; the process is gone when this is raised.
        InputError: it used more than it may, or its process died.
        TeachframeError: whatever of these the job raised.
        RuntimeError: any other fault of the job.
    """
    stop = stop or threading.Event()
    with bounds.seat(stop):
        ours, theirs = _CONTEXT.Pipe(duplex=False)
        process = _CONTEXT.Process(
            target=_work,
            args=(theirs, job, args, bounds.seconds, bounds.memory, say is not None),
            daemon=True,
        )
        process.start()
        theirs.close()
        try:
            return _answer(ours, process, bounds, say, stop)
        finally:
            process.kill()
            process.join()
            ours.close()


def _answer(ours: Connection, process: Any, bounds: Bounds, say: Say | None, stop: threading.Event) -> Any:
    end = time.monotonic() + bounds.patience
    while not stop.is_set():
        if time.monotonic() > end:
            raise _too_long(bounds)
        if ours not in wait([ours, process.sentinel], _LOOK) and process.exitcode is None:
            continue
        try:
            kind, what = ours.recv()
        except (EOFError, OSError):
            process.join(_ENDING)
            raise _died(process.exitcode, bounds) from None
        if kind == "done":
            return what
        if kind == "error":
            raise what
        if kind == "fault":
            raise RuntimeError(what)
        if say is not None:
            say(*what)
    raise GivenUpError("given up")


def _died(code: int | None, bounds: Bounds) -> InputError:
    if code == -getattr(signal, "SIGXCPU", 0):
        return _too_long(bounds)
    return InputError("the process that read it died", expected="a file that is whole")


def _too_long(bounds: Bounds) -> InputError:
    return InputError(f"it takes longer than {bounds.seconds} s of the processor", expected="a smaller file")


def _work(
    answers: Connection, job: Callable[..., Any], args: tuple[Any, ...], seconds: int, memory: int, says: bool
) -> None:
    """In the process: does the job and answers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server answers an interrupt, and ends this
    warnings.simplefilter("ignore")  # of libraries, for developers
    _bound(seconds, memory)
    try:
        done = job(*args, lambda share, doing: answers.send(("say", (share, doing)))) if says else job(*args)
        answers.send(("done", done))
    except TeachframeError as error:
        answers.send(("error", error))
    except MemoryError:
        needed = f"it needs more than {memory // _GIB} GB of memory"
        answers.send(("error", InputError(needed, expected="a smaller file")))
    except BrokenPipeError:  # the server has gone
        pass
    except Exception as error:
        answers.send(("fault", f"{type(error).__name__}: {error}"))


def _bound(seconds: int, memory: int) -> None:
    """The kernel ends what uses more."""
    try:
        import resource
    except ImportError:  # Windows has no such bounds
        return
    os.nice(_POLITE)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    has = _mapped()
    if has:
        resource.setrlimit(resource.RLIMIT_AS, (has + memory, has + memory))


def _mapped() -> int:
    """Bytes of address space in use; 0 where the system does not say."""
    try:
        words = Path("/proc/self/statm").read_text(encoding="ascii")
        return int(words.split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError):
        return 0
