"""The orientations that are allowed for a touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry import exp_so3
from app.units import from_deg

_AROUND, _TILTS, _TURNS = 24, 3, 5


@dataclass(frozen=True)
class TouchLimits:
    """How far the tool may be turned away from the reference orientation.

    Args:
        tilt: largest angle between the tool's axis and its reference direction [rad].
        turn: largest turn about the tool's own axis, either way [rad].
    """

    tilt: float = from_deg(30.0)
    turn: float = from_deg(45.0)


def tilted(
    reference: np.ndarray, axis: np.ndarray, tilt: np.ndarray, around: np.ndarray, turn: np.ndarray
) -> np.ndarray:
    """Flange rotations with the tool turned about its axis by `turn` and leant by `tilt` towards `around`.

    Args:
        reference: (3, 3) R_base_flange of the reference orientation.
        axis: (3,) the tool's axis in the flange, unit.
        tilt, around, turn: (m,) [rad].

    Returns:
        (m, 3, 3).
    """
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    a = np.cross(axis, helper)
    a /= np.linalg.norm(a)
    b = np.cross(axis, a)
    lean = tilt[:, None] * (np.cos(around)[:, None] * a + np.sin(around)[:, None] * b)
    return reference @ exp_so3(lean) @ exp_so3(turn[:, None] * axis)


def candidates(reference: np.ndarray, axis: np.ndarray, limits: TouchLimits) -> np.ndarray:
    """(m, 3, 3) an even choice of the allowed orientations, the far ones included."""
    around = np.arange(_AROUND) * (2.0 * np.pi / _AROUND)
    tilts = np.linspace(limits.tilt / (_TILTS - 1), limits.tilt, _TILTS - 1)
    turns = np.linspace(-limits.turn, limits.turn, _TURNS)
    grid = np.stack(np.meshgrid(tilts, around, turns, indexing="ij"), axis=-1).reshape(-1, 3)
    upright = np.stack([np.zeros(_TURNS), np.zeros(_TURNS), turns], axis=1)
    grid = np.concatenate([upright, grid])
    return tilted(reference, axis, grid[:, 0], grid[:, 1], grid[:, 2])
