"""A recording beside the simulation before anybody has searched: what the Compare screen shows first."""

from __future__ import annotations

import numpy as np

from app.diagnosis.dispatch import family, kind_of
from app.diagnosis.model import SavedModel
from app.diagnosis.result import Evidence
from app.errors import InputError
from app.kinematics import RobotModel
from app.recordings import Table
from app.recordings.matching import check_joints
from app.steps import part


def preview(table: Table, robot: RobotModel, model: SavedModel | None = None) -> Evidence:
    """Evidence without a search: `before` is the bare description, `after` has the given model in it.

    Without a model both are the same. Touch and tracker recordings have base and tool fitted; joint logs nothing.

    Raises:
        InputError, DegenerateGeometryError: the recording cannot be used, or the model is of another kind.
    """
    kind, _ = kind_of(table)
    check_joints(table, robot)
    if model is not None and model.kind != family(kind):
        raise InputError(
            f"the model was learnt from {model.kind} recordings and this one is of kind {kind}",
            file=table.path,
            expected=f"a model of kind {family(kind)}",
        )
    return (_motion if family(kind) == "motion" else _static)(table, robot, model)


def _static(table: Table, robot: RobotModel, model: SavedModel | None) -> Evidence:
    from app.diagnosis.kinematic.judging import bare, judged
    from app.diagnosis.kinematic.pictures import evidence_of
    from app.diagnosis.observations.pose_reading import read_static

    with part(0.0, 0.85):
        recording = read_static(table, robot)
    with part(0.85, 1.0, "beside the simulation"):
        return evidence_of(recording, bare(recording) if model is None else judged(recording, robot, model))


def _motion(table: Table, robot: RobotModel, model: SavedModel | None) -> Evidence:
    from app.diagnosis.dynamic.judging import judged

    found = judged(table, robot, model or SavedModel("motion", robot.name))
    samples = found.samples
    return Evidence(
        rows=found.log.rows[samples.centre],
        measured=samples.y,
        before=found.before,
        after=found.after,
        components=tuple(f"joint {j + 1}" for j in range(robot.joint_count)),
        unit="Nm",
        q=samples.state.q,
        drivers={},
        kept=np.asarray(samples.used.all(axis=1)),
        t=samples.state.t,
    )
