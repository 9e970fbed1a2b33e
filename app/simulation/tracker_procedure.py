"""Somebody careful who carries the whole procedure out in a simulated cell, without a screen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.relation import Relation
from app.calibration.base.result import BaseCalibration
from app.calibration.base.sequence import description_sense
from app.calibration.base.wizard import NESTS, ZERO, BaseWizard, Step, steps
from app.errors import ActionRefusedError
from app.geometry import Pose
from app.simulation.tracker_cell import TrackerCell
from app.units import from_deg

STEP = from_deg(10.0)
WIDEST = (from_deg(120.0), from_deg(60.0))  # either way, axis 1 and axis 2


@dataclass(frozen=True, eq=False)
class Outcome:
    """What came out, beside what is true.

    Args:
        wizard: the state at the end.
        bases: both calibrations.
        relation: between them.
        T_base1_base2_true: the cell's secret.
        miss: [m] how far both tools miss each other when sent to one point by the relation found.
    """

    wizard: BaseWizard
    bases: tuple[BaseCalibration, ...]
    relation: Relation
    T_base1_base2_true: Pose
    miss: float


def senses(cell: TrackerCell) -> tuple[tuple[int, int], ...]:
    """Which way each robot's controller counts axis 1 and axis 2, by its description."""
    return tuple(
        (description_sense(arm.robot, 1, arm.rest), description_sense(arm.robot, 2, arm.rest))
        for arm in cell.arms
    )


def record_step(
    cell: TrackerCell, wizard: BaseWizard, step: Step, rng: np.random.Generator, every: float = STEP
) -> BaseWizard:
    """Everything one step asks for, measured.

    Raises:
        ActionRefusedError: the tracker sees none of it; says why.
    """
    arm = step.robot - 1
    rests = [cell.arms[0].rest, cell.arms[1].rest]
    if step.kind == NESTS:
        for number in range(len(cell.nests)):
            sight = cell.nest(number, rng)
            if sight.point is not None:
                wizard = wizard.record(sight.point, name=f"N{number + 1}", sigma=sight.sigma)
        return wizard
    angles = (
        np.zeros(1)
        if step.kind == ZERO
        else cell.visible_angles(arm, step.axis, every, WIDEST[step.axis - 1])
    )
    why = ""
    for angle in angles:
        rests[arm] = cell.posture(arm, step.axis, float(angle))
        sight = cell.look(arm, (rests[0], rests[1]), rng)
        why = sight.sentence
        if sight.point is not None:
            wizard = wizard.record(sight.point, angle=float(angle), sigma=sight.sigma)
    if len(wizard.of(step.key)) < step.least:
        raise ActionRefusedError(f"{step.title}: {why}")
    return wizard


def carry_out(
    cell: TrackerCell,
    seed: int,
    *,
    pushed: Pose | None = None,
    nests: bool = True,
    every: float = STEP,
) -> Outcome:
    """The whole procedure to its end.

    Args:
        cell: two arms and a tracker.
        seed: of the tracker's noise.
        pushed: the tracker is pushed by this between the two robots.
        nests: fixed points are measured with both.
        every: degrees between two points of an arc [rad].
    """
    rng = np.random.default_rng(seed)
    wizard = BaseWizard(steps(2, nests))
    now = cell
    while (step := wizard.step) is not None:
        if pushed is not None and step.robot == 2 and now is cell:
            now = cell.moved(pushed)
        wizard = record_step(now, wizard, step, rng, every).advance()
    bases, relation = wizard.solve(tuple(a.robot for a in cell.arms), senses(cell))
    assert relation is not None
    return Outcome(wizard, bases, relation, cell.T_base1_base2, miss(cell, relation))


def miss(cell: TrackerCell, relation: Relation) -> float:
    """Both tools are sent to the meeting point by the relation found: how far apart they really are [m]."""
    if relation.T_base1_base2 is None:
        return float("nan")
    wanted_2 = relation.T_base1_base2.inverse().apply(relation.meeting)  # where robot 2 is told to go
    really = cell.T_base1_base2.apply(wanted_2)
    return float(np.linalg.norm(really - relation.meeting))
