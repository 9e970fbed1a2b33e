"""The two-robot procedure as an exercise: what is measured goes into the session, what is true stays here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.wizard import BaseWizard
from app.session import Session
from app.session.actions import Tracked, TrackerNext, TrackerUndo
from app.session.state import Running, as_tuple
from app.training.tracker import TrackerTruth, tracker_truth


@dataclass(frozen=True, eq=False)
class Exam:
    """One attempt.

    Args:
        session: where every point goes.
        truth: the cell, and what is drawn of it.
    """

    session: Session
    truth: TrackerTruth

    @classmethod
    def of(cls, session: Session) -> Exam | None:
        """The attempt that is being made; None where none is, or it is no two-robot exercise."""
        running = session.state.running
        if running is None or running.wizard is None:
            return None
        return cls(session, tracker_truth(running.begun.exercise, running.begun.seed))

    @property
    def wizard(self) -> BaseWizard:
        """Where the procedure stands."""
        running: Running | None = self.session.state.running
        assert running is not None and running.wizard is not None
        return running.wizard

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
