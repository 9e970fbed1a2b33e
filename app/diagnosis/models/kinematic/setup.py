"""What every recording leaves open: where the instrument stands, the tool, the touched points."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.geometry import exp_so3, log_so3

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.cell import Cell, Posed
    from app.diagnosis.observations.pose_data import StaticRecording


@dataclass(frozen=True, eq=False)
class Setup:
    """The state of the nuisance.

    Args:
        rotations: (s, 3, 3) instrument from base, one a session.
        positions: (s, 3) [m] origin of the base in the instrument's frame.
        tools: (s, r, 3) [m] tool points in the flange.
        mounts: (s, 3, 3) measured body from flange.
        targets: (t, 3) [m] touched points in base; empty unless they are unknown.
    """

    rotations: np.ndarray
    positions: np.ndarray
    tools: np.ndarray
    mounts: np.ndarray
    targets: np.ndarray

    def tool_rows(self, recording: StaticRecording) -> np.ndarray:
        """(r, 3), or (m, r, 3) where sessions differ."""
        return self.tools[0] if len(self.tools) == 1 else self.tools[recording.session]


def instrument_points(recording: StaticRecording, posed: Posed, setup: Setup) -> np.ndarray:
    """(m, r, 3) [m] tool points in the instrument's frame, before its scale and zero."""
    rotation = setup.rotations[recording.session]
    return posed.points @ np.swapaxes(rotation, 1, 2) + setup.positions[recording.session][:, None]


def residual(recording: StaticRecording, posed: Posed, setup: Setup, cell: Cell) -> np.ndarray:
    """(m, k) measured minus predicted [m, rad]; 0 where nothing was measured."""
    if recording.mode == "targets":
        return setup.targets[recording.target] - posed.points[:, 0]
    points = instrument_points(recording, posed, setup)
    distance = np.linalg.norm(points, axis=-1)
    if recording.mode == "length":
        assert recording.lengths is not None
        predicted = cell.scale * distance[:, 0] + cell.zero
        return np.nan_to_num(recording.lengths - predicted)[:, None]
    assert recording.points is not None
    gain = cell.scale[:, None] + cell.zero[:, None] / np.maximum(distance, 1e-9)
    out = np.nan_to_num(recording.points - gain[:, :, None] * points).reshape(recording.size, -1)
    if recording.orientations is None:
        return out
    predicted_r = setup.rotations[recording.session] @ posed.hand @ setup.mounts[recording.session]
    seen = np.isfinite(recording.orientations).all(axis=(1, 2))
    turn = np.zeros((recording.size, 3))
    turn[seen] = log_so3(recording.orientations[seen] @ np.swapaxes(predicted_r[seen], 1, 2))
    return np.concatenate([out, turn], axis=1)


def moved(setup: Setup, recording: StaticRecording, step: np.ndarray) -> Setup:
    """The setup after a step of the nuisance parameters, in the order of `nuisance_columns`."""
    if recording.mode == "targets":
        tool, targets = step[:3], step[3:].reshape(-1, 3)
        return replace(setup, tools=setup.tools + tool, targets=setup.targets + targets)
    rotations, positions = setup.rotations.copy(), setup.positions.copy()
    tools, mounts = setup.tools.copy(), setup.mounts.copy()
    at = 0
    for s in range(len(rotations)):
        if recording.mode == "length":
            shift, at = step[at : at + 3], at + 3
            positions[s] = positions[s] + rotations[s] @ shift
        else:
            shift, turn, at = step[at : at + 3], step[at + 3 : at + 6], at + 6
            positions[s] = positions[s] + rotations[s] @ shift
            rotations[s] = rotations[s] @ exp_so3(turn)
        r = tools.shape[1]
        tools[s] = tools[s] + step[at : at + 3 * r].reshape(r, 3)
        at += 3 * r
        if recording.orientations is not None:
            mounts[s] = exp_so3(step[at : at + 3]) @ mounts[s]
            at += 3
    return Setup(rotations, positions, tools, mounts, setup.targets)
