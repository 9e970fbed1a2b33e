"""Hold to move: as long as a button and the enabling switch are held, the arm moves one way.

One press is one increment, however the words of the press stutter on their way: each press has a number of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

from app.session.motion.drive import Drive
from app.session.motion.jog_way import FRAMES, Jog, JogWay
from app.session.motion.pace import Pace
from app.units import from_deg, from_mm

__all__ = ["FRAMES", "INCREMENTS", "Jog", "Jogging"]

#: Increment -> length [m] and angle [rad]; None moves as long as the button is held.
INCREMENTS: dict[str, tuple[float, float] | None] = {
    "continuous": None,
    "large": (from_mm(10.0), from_deg(3.0)),
    "medium": (from_mm(1.0), from_deg(1.0)),
    "small": (from_mm(0.1), from_deg(0.1)),
}


_ROUNDING = 1e-9  # of an increment


class Jogging:
    """Moves one arm while a button and the enabling switch are held.

    Args:
        drive: the arm's.
    """

    def __init__(self, drive: Drive):
        self._drive = drive
        self.frame, self.increment = "joint", "continuous"
        self._held: tuple[Jog, int] | None = None  # the button that is held now, and the number of its press
        self._begun: tuple[Jog, int] | None = None  # the press that was taken up last
        self._watching = False

    def beat(self, enabled: bool, jog: Jog | None, press: int = 0) -> None:
        """A word from the page, on any thread: which of switch and button is held. Only enqueues.

        Args:
            enabled: the enabling switch is held.
            jog: the button that is held; None for none, or for two at once.
            press: number of the press: another number is another press.
        """
        drive = self._drive
        was = drive.live
        live = drive.enabling.beat(enabled, anything=enabled or jog is not None)
        held = None if jog is None else (jog, press)
        changed, self._held = held != self._held, held
        if held is not None and changed:
            drive.worker.post(lambda: self._take(held))
        elif live != was:
            drive.worker.latest("switch", self._switched)

    def let_go(self) -> None:
        """The page is gone: the next one holds nothing yet, and numbers its presses from the beginning."""
        self._held = None
        self._drive.enabling.let_go()
        self._drive.worker.post(self._forget)

    def _forget(self) -> None:
        self._begun = None

    def _switched(self) -> None:
        drive = self._drive
        if drive.live and not drive.worker.running("watch"):
            drive.worker.animate("watch", self._watch())
        held = self._held
        if (
            drive.live and held is not None and held != self._begun
        ):  # the button came first, the switch after it
            self._take(held)
        drive.worker.post(drive.rested)

    def _watch(self) -> Iterator[None]:
        """Tells when the switch was let go, or fell silent."""
        drive, moved = self._drive, False
        while drive.live:
            moved = drive.moves  # a jog may see the silence before this does, and is no more
            yield
        if drive.enabling.tripped and not drive.enabling.stopped:
            level, key = ("warning", "silent") if moved else ("info", "silent_standing")
            drive.voice.say(level, drive.voice.t(f"message.{key}"))
        drive.worker.post(drive.rested)

    def _take(self, held: tuple[Jog, int]) -> None:
        drive = self._drive
        drive.must_not_be_stopped()
        if held != self._held or held == self._begun:
            return
        if not drive.live:
            key = "message.let_go" if drive.enabling.tripped else "message.not_enabled"
            drive.voice.say("warning", drive.voice.t(key))
            return
        if not drive.worker.running("watch"):
            drive.worker.animate("watch", self._watch())
        self._begun = held
        drive.cancel()
        drive.worker.animate("jog", self._run(held, INCREMENTS[self.increment]))

    def _run(self, held: tuple[Jog, int], step: tuple[float, float] | None) -> Iterator[None]:
        """Tick by tick along one way; an increment is gone to its end, and then nothing more happens."""
        drive = self._drive
        way, pace, share = JogWay(drive, held[0]), Pace(drive), 0.0
        yield
        while drive.live and share < 1.0 and (self._held == held or step is not None):
            passed = pace.passed()
            if passed > 0.0:
                part = way.part(passed, step, 1.0 - share)
                gone = way.go(part)
                if gone is None:
                    break
                if step is not None:
                    share += gone / way.whole(step)
                    share = 1.0 if share > 1.0 - _ROUNDING else share
            yield
        drive.rest()
