"""Both tools sent to one point by the relation that was found: the proof an operator understands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.relation import Relation
from app.calibration.base.wording import refused
from app.estimation import reach
from app.simulation.tracker_cell import CellArm, TrackerCell

POINTER = 0.22  # share of the reach: length of the pointer on each flange
_STEPS, _DAMPING, _CLOSE = 400, 1e-3, 1e-7
_SHARES = (0.0, -0.06, 0.06, -0.12, 0.12)  # around the place that suits both reaches
_HEIGHTS = (0.0, 0.2, -0.2, 0.4)


@dataclass(frozen=True, eq=False)
class Meeting:
    """Where both tools stand in the end.

    Args:
        postures: joints of both arms [rad].
        tips: (2, 3) [m] where the two tips really are, in the world.
        miss: [m] between them.
        predicted: [m] longest half axis of the region that holds the miss in 95 of 100 cases.
    """

    postures: tuple[np.ndarray, np.ndarray]
    tips: np.ndarray
    miss: float
    predicted: float


def pointer(arm: CellArm) -> np.ndarray:
    """(3,) the pointer's tip in the flange [m]."""
    return np.array([0.0, 0.0, POINTER * arm.robot.reach])


def meet(cell: TrackerCell, relation: Relation) -> Meeting:
    """Sends both tips to a point between the arms.

    Robot 1 is told a point in its own frame; robot 2 is told the same point through the relation. Each goes there
    by its own description; only the world knows where that is.

    Raises:
        ActionRefusedError: there is no relation, or no point both reach.
    """
    T12 = relation.T_base1_base2
    if T12 is None:
        raise refused("no_relation")
    one, two = cell.arms
    frame_1, frame_2 = one.T_world_frame, two.T_world_frame
    between = frame_1.inverse().apply(frame_2.position)
    middle = one.robot.reach / (one.robot.reach + two.robot.reach)
    for height in _HEIGHTS:
        for share in _SHARES:
            told_1 = (middle + share) * between + np.array([0.0, 0.0, height * one.robot.reach])
            told_2 = T12.inverse().apply(told_1)
            found = [
                _reach(arm, (arm.T_world_base.inverse() @ frame).apply(told))
                for arm, frame, told in ((one, frame_1, told_1), (two, frame_2, told_2))
            ]
            if found[0] is None or found[1] is None:
                continue
            tips = np.array([a.flange(q).apply(pointer(a)) for a, q in ((one, found[0]), (two, found[1]))])
            off = float(np.linalg.norm(tips[0] - tips[1]))
            return Meeting((found[0], found[1]), tips, off, _region(relation, told_1))
    raise refused("no_meeting")


def _region(relation: Relation, p_base1: np.ndarray) -> float:
    from app.calibration.base.frame import point_jacobian

    assert relation.T_base1_base2 is not None
    at = point_jacobian(relation.T_base1_base2.inverse().apply(p_base1))
    return reach(0) * float(np.sqrt(np.linalg.eigvalsh(at @ relation.covariance @ at.T)[-1]))


def _reach(arm: CellArm, p_base: np.ndarray) -> np.ndarray | None:
    """Joints whose tip stands at p_base (3,) [m], by damped least squares inside the limits; None where none do."""
    robot, tip = arm.robot, pointer(arm)
    q = arm.rest.copy()
    for _ in range(_STEPS):
        frames = robot.chain.frames(q[None])
        point = frames.flange_positions[0] + frames.flange_rotations[0] @ tip
        miss = p_base - point
        if float(np.linalg.norm(miss)) < _CLOSE:
            return q
        jacobian = robot.chain.jacobian_columns(frames, point[None])[0]
        step = jacobian.T @ np.linalg.solve(
            jacobian @ jacobian.T + _DAMPING * (miss @ miss + 1e-9) * np.eye(3), miss
        )
        q = np.clip(q + np.clip(step, -0.2, 0.2), robot.lower, robot.upper)
    return None
