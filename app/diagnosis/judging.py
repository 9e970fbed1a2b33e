"""A model learnt on other recordings, judged on one it has not seen: the error before and after, nothing searched."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.diagnosis.result import Judged, Quality
from app.kinematics import RobotModel
from app.recordings import Table

if TYPE_CHECKING:
    from app.diagnosis.model import SavedModel


BARE, WITH = "description alone", "with the model"


def judge(table: Table, robot: RobotModel, model: SavedModel) -> Judged:
    """Error of the bare description and of the model.

    Static recordings: base, tool and targets are fitted in both, which every recording leaves open, and nothing
    else; rows that do not belong even to the model count in neither. Joint logs: nothing is fitted at all.

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used.
    """
    steps = _motion(table, robot, model) if model.kind == "motion" else _static(table, robot, model)
    return Judged(model.source, steps)


def _static(table: Table, robot: RobotModel, model: SavedModel) -> dict[str, Quality]:
    from app.diagnosis.kinematic.judging import judged
    from app.diagnosis.observations.pose_reading import read_static

    found = judged(read_static(table, robot), robot, model)
    return {BARE: found.before_quality, WITH: found.after_quality}


def _motion(table: Table, robot: RobotModel, model: SavedModel) -> dict[str, Quality]:
    from app.diagnosis.dynamic.judging import judged

    before, after = judged(table, robot, model).qualities
    return {BARE: before, WITH: after}
