"""The drag handle moves the arm by inverse kinematics and says why it stopped."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.geometry import Pose
from app.pendant.guarding import words

if TYPE_CHECKING:
    from app.pendant.client import Pendant


class Dragging:
    """What a drag at the handle does.

    The handle is written back only when the drag ends: until then it is in the person's hand.

    Args:
        pendant: whose arm is dragged.
    """

    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        self._told = ""

    def event(self, phase: str, target: Pose) -> None:
        """From the browser, on the event loop: only enqueues."""
        worker = self._pendant.worker
        if phase == "end":
            worker.post(lambda: self._end(target))
        else:
            worker.latest("drag", lambda: self.follow(target))

    def follow(self, target: Pose) -> None:
        """The arm goes as near to `target`, T_base_tool, as it can and nothing is hit."""
        pendant = self._pendant
        pendant.jogging.must_not_be_stopped()
        pendant.worker.halt("move")
        result = pendant.solve(target)
        stop = pendant.advance(result.q)
        if stop is not None:
            why = words(stop, pendant.t, pendant.language)
        else:
            why = "" if result.reached else pendant.why(result)
        if why != self._told:
            if why:
                pendant.say("warning", why)
            else:
                pendant.layout.message("info", "")
            self._told = why

    def _end(self, target: Pose) -> None:
        pendant = self._pendant
        try:
            self.follow(target)
        finally:  # let go of in any case: the handle stands where the tool is
            self._told = ""
            pendant.stage.handle.place(pendant.hand())
            pendant.settle()
            pendant.page.numbers()
