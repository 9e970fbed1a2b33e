"""A model learnt anywhere, on a joint log: the torque error before and after, nothing fitted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.dynamic.ready import ready
from app.diagnosis.model import SavedModel
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.samples import Samples, take
from app.diagnosis.models.dynamic.saved import fingerprint, holding, predict
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.result import Quality
from app.kinematics import RobotModel
from app.recordings import Table
from app.steps import part


@dataclass(frozen=True, eq=False)
class JudgedLog:
    """A log beside its description and a model.

    Args:
        samples: windows of the log as it is given.
        before, after: (M, n) residuals [Nm].
        heldout: held-out error after [Nm] where these are the rows it was learnt from, else None.
    """

    log: Log
    samples: Samples
    before: np.ndarray
    after: np.ndarray
    heldout: float | None

    @property
    def qualities(self) -> tuple[Quality, Quality]:
        """Error of the description alone, and with the model."""
        before, after = self._rms(self.before), self._rms(self.after)
        return Quality(before, before, "Nm"), Quality(
            after, after if self.heldout is None else self.heldout, "Nm"
        )

    def _rms(self, residual: np.ndarray) -> float:
        within = float(np.mean(self.samples.within))
        return float(np.sqrt(np.mean(residual[self.samples.used] ** 2) + within))


def judged(table: Table, robot: RobotModel, model: SavedModel) -> JudgedLog:
    """The model on a log; events are left out unless these are the rows they were found in.

    Raises:
        InputError: the log cannot be used.
    """
    with part(0.0, 0.7):
        log, motion, _ = ready(table, robot)
    with part(0.7, 0.85, "beside the simulation"):
        bare = take(log, robot, motion, as_given(robot.joint_count))
        rows = fingerprint(log)
    with part(0.85, 1.0, "beside the simulation"):
        found = predict(log, robot, motion, holding(model, rows))
    own = model.taught.heldout_rms if rows == model.taught.rows else None
    return JudgedLog(log, bare, bare.y - bare.description, found.residual, own)
