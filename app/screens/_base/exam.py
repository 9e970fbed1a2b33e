"""The two-robot procedure of a session, free or as an exercise: what is measured goes there, the truth stays here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.wizard import BaseWizard
from app.geometry import Pose
from app.session import Session
from app.session.actions import Tracked, TrackerNext, TrackerUndo
from app.session.state import as_tuple
from app.simulation.tracker_cell import make_cell
from app.training.exercise import begun_exercise
from app.training.tracker import TrackerTruth, tracker_truth

#: What somebody does to the tracker between the two robots.
PUSH = Pose.exp(np.array([0.015, -0.012, 0.0, 0.0, 0.0, 0.006]))


@dataclass(frozen=True, eq=False)
class Exam:
    """One run of it.

    Args:
        session: where every point goes.
        truth: the cell, and what is drawn of it.
    """

    session: Session
    truth: TrackerTruth

    @classmethod
    def of(cls, session: Session) -> Exam | None:
        """The procedure that is being worked through; None where none is."""
        state = session.state
        if state.running is not None:
            if state.running.wizard is None:
                return None
            begun = state.running.begun
            return cls(session, tracker_truth(begun_exercise(begun).key, begun.seed))
        if state.two_robots is None:
            return None
        opened = state.two_robots.opened
        cell = make_cell(opened.first, opened.second, opened.seed)
        return cls(session, TrackerTruth(cell, cell, PUSH if opened.pushed else None))

    @property
    def free(self) -> bool:
        """Nobody examines: the cell may be closed."""
        return self.session.state.running is None

    @property
    def wizard(self) -> BaseWizard:
        """Where the procedure stands."""
        state = self.session.state
        at_hand = state.running or state.two_robots
        assert at_hand is not None and at_hand.wizard is not None
        return at_hand.wizard

    def record(self, point: np.ndarray, angle: float, name: str, sigma: float) -> BaseWizard:
        """A measured point (3,) [m]."""
        x, y, z = as_tuple(point)
        self.session.do(Tracked((x, y, z), float(angle), name, float(sigma)))
        return self.wizard

    def advance(self) -> BaseWizard:
        """On to the next step; raises ActionRefusedError."""
        self.session.do(TrackerNext())
        return self.wizard

    def undo(self) -> BaseWizard:
        """Takes the last point back; raises ActionRefusedError."""
        self.session.do(TrackerUndo())
        return self.wizard
