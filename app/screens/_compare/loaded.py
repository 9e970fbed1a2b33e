"""A recording with its robot and what is known of it so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from app.diagnosis.judging import judge
from app.diagnosis.model import SavedModel
from app.diagnosis.preview import preview
from app.diagnosis.report.curves import residual_vectors
from app.diagnosis.report.drawing.arrows import magnification
from app.diagnosis.result import Diagnosis, Evidence, Judged, Progress, Quality
from app.kinematics import RobotModel
from app.recordings.arm import read_with_arm
from app.steps import listened, part

#: Shares of the work that are done when the file's robot is there (of a joint log also its rows), and when the
#: simulation stands beside it, where a model is judged too.
_READ, _BESIDE = 0.15, 0.6


@dataclass(frozen=True, eq=False)
class Loaded:
    """One recording on the screen.

    Args:
        path: the file.
        robot: whose recording it is.
        named: what was asked for as the robot; None takes the file's own.
        evidence: what is drawn: before the search the bare description, after it the diagnosis's.
        diagnosis: None until somebody searched.
        applied: True while the findings are in the simulation.
        truth: what a simulated cell has hidden; empty for real recordings.
        model: one that was given; before the search `evidence` stands with it on one side.
        judged: the given model on this recording.
    """

    path: Path
    robot: RobotModel
    named: str | None
    evidence: Evidence
    diagnosis: Diagnosis | None = None
    applied: bool = False
    truth: tuple[dict, ...] = field(default=())
    model: SavedModel | None = None
    judged: Judged | None = None

    @property
    def moving(self) -> bool:
        """A log over time, not single poses."""
        return self.evidence.unit == "Nm"

    @property
    def count(self) -> int:
        return len(self.evidence.q)

    @property
    def change(self) -> tuple[Quality, Quality] | None:
        """Error without and with what can be put into the simulation; None where there is nothing to put in."""
        found = self.diagnosis
        if found is not None:
            changed = bool(found.findings) or found.before != found.after
            return (found.before, found.after) if changed else None
        if self.judged is None:
            return None
        steps = list(self.judged.steps.values())
        return steps[0], steps[-1]

    @property
    def start(self) -> float:
        """Time of the first sample [s]; 0 for poses."""
        seconds = self.evidence.seconds
        return 0.0 if seconds is None else float(seconds[0])

    @property
    def seconds(self) -> float:
        """How long a log lasts [s]."""
        return self.moment(self.count - 1)

    def moment(self, index: int) -> float:
        """Time of a row since the first [s]."""
        seconds = self.evidence.seconds
        return 0.0 if seconds is None else float(seconds[index]) - self.start

    def index_at(self, moment: float) -> int:
        """The row at a time since the first [s]."""
        seconds = self.evidence.seconds
        if seconds is None:
            return 0
        return min(int(np.searchsorted(seconds, moment + self.start)), self.count - 1)

    @property
    def factor(self) -> float:
        """How much longer than life residuals are best drawn."""
        return 1.0 if residual_vectors(self.evidence)[0] is None else magnification(self.evidence)

    def vectors(self, share: float) -> np.ndarray:
        """(m, 3) residuals in base [m], `share` of the way from before (0) to after (1)."""
        before, after = residual_vectors(self.evidence)
        if before is None or after is None:
            return np.zeros((self.count, 3))
        return np.nan_to_num((1.0 - share) * before + share * after)

    def off(self, index: int, share: float) -> np.ndarray:
        """(n,) torque error of one sample [Nm], `share` of the way from before (0) to after (1)."""
        before, after = self.evidence.before[index], self.evidence.after[index]
        return (1.0 - share) * before + share * after

    @property
    def worst(self) -> int:
        """Index of the row that is furthest off, outliers aside: where the difference is best seen."""
        return (
            0
            if self.moving
            else int(np.argmax(np.linalg.norm(self.vectors(0.0), axis=1) * self.evidence.kept))
        )

    @property
    def telling_joint(self) -> int:
        """Index of the joint whose torque error fell most, or of the first before anybody searched."""
        before, after = (np.nan_to_num(r) for r in (self.evidence.before, self.evidence.after))
        return int(np.argmax(np.sum(before**2 - after**2, axis=0)))

    @property
    def points(self) -> np.ndarray | None:
        """(m, 3) where the simulation puts the tool, in base [m]."""
        return self.evidence.points_predicted_before

    def with_diagnosis(self, found: Diagnosis) -> Loaded:
        """The same recording, searched."""
        evidence = found.evidence if found.evidence is not None else self.evidence
        return replace(self, diagnosis=found, evidence=evidence, applied=False, judged=found.judged)


def load(
    path: Path,
    *,
    robot: str | None = None,
    truth: tuple[dict, ...] = (),
    model: SavedModel | None = None,
    progress: Progress | None = None,
) -> Loaded:
    """Reads a recording and sets it beside the bare description, and beside a model where one is given.

    Raises:
        InputError, DegenerateGeometryError: it cannot be used.
    """
    with listened(progress or (lambda share, doing: None), "reading"):
        with part(0.0, _READ):
            table, arm = read_with_arm(path, robot)
        with part(_READ, 1.0 if model is None else _BESIDE):
            evidence = preview(table, arm, model)
        if model is None:
            return Loaded(path, arm, robot, evidence, truth=truth)
        with part(_BESIDE, 1.0, "beside the simulation"):
            said = judge(table, arm, model)
    return Loaded(path, arm, robot, evidence, truth=truth, model=model, judged=said)
