"""A saved model put to use: where the arm really is at given joint positions."""

from __future__ import annotations

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.models.kinematic.cell import Posed, pose
from app.diagnosis.models.kinematic.saved import held_terms
from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.models.kinematic.terms import apply_terms
from app.kinematics import RobotModel


def posed_by(robot: RobotModel, model: SavedModel, q: np.ndarray, tool: np.ndarray | None = None) -> Posed:
    """Everything in base at q (m, n) [rad or m] with the model's effects in it.

    Slow effects stand as at the start of their recording, steps as after they happened, play as not yet taken up.

    Args:
        tool: (3,) [m] tool point in the flange; by default the flange itself.
    """
    q = np.atleast_2d(np.asarray(q, float))
    situation = situation_for(robot, q, order=np.full(len(q), np.iinfo(np.int64).max), time=np.zeros(len(q)))
    cell = apply_terms(situation, held_terms(model, situation))
    return pose(situation, cell, np.zeros((1, 3)) if tool is None else np.asarray(tool, float).reshape(1, 3))


def tool_points(robot: RobotModel, model: SavedModel, q: np.ndarray, tool: np.ndarray) -> np.ndarray:
    """(m, 3) [m] tool points in base at q (m, n)."""
    return posed_by(robot, model, q, tool).points[:, 0]


def model_flange_matrix(robot: RobotModel, model: SavedModel, q: np.ndarray) -> np.ndarray:
    """(4, 4) T_base_flange at q (n,) with the model's effects in it; a slipped tool moves with it."""
    situation = situation_for(
        robot, np.atleast_2d(q), order=np.full(1, np.iinfo(np.int64).max), time=np.zeros(1)
    )
    cell = apply_terms(situation, held_terms(model, situation))
    posed = pose(situation, cell, np.zeros((1, 3)))
    out = np.eye(4)
    out[:3, :3] = posed.hand[0]
    out[:3, 3] = posed.points[0, 0]
    return out
