"""A recording beside the simulation before anybody has searched: what the Compare screen shows first."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from app.diagnosis.dispatch import check_joints, family, kind_of
from app.diagnosis.model import SavedModel
from app.diagnosis.result import Evidence
from app.errors import InputError
from app.kinematics import RobotModel
from app.recordings import Table


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
    from app.diagnosis.static.evidence import evidence_of
    from app.diagnosis.static.models import held_terms, undone
    from app.diagnosis.static.plain import plain_fit
    from app.diagnosis.static.reading import read_static

    recording = read_static(table, robot)
    before = after = plain_fit(recording, ())
    if model is not None:
        told = undone(model, recording, robot)
        after = plain_fit(told, held_terms(model, told.situation, told.file))
    outcome = SimpleNamespace(
        before=before, found=SimpleNamespace(fitted=after), outliers=np.zeros(recording.size, bool)
    )
    return evidence_of(recording, outcome)


def _motion(table: Table, robot: RobotModel, model: SavedModel | None) -> Evidence:
    from app.diagnosis.judging import WITH, torque_residuals
    from app.diagnosis.motion.engine import ready

    log, motion, _ = ready(table, robot)
    samples, residuals = torque_residuals(log, robot, motion, model or SavedModel("motion", robot.name))
    after = residuals[WITH]
    return Evidence(
        rows=log.rows[samples.centre],
        measured=samples.y + samples.pool(samples.state.torque),
        before=samples.y,
        after=after,
        components=tuple(f"joint {j + 1}" for j in range(robot.joint_count)),
        unit="Nm",
        q=samples.pool(samples.state.q),
        drivers={},
        kept=np.asarray(samples.usable.any(axis=1)),
        t=samples.t,
    )
