"""How every measured component moves with every elementary displacement of the cell: the linear columns.

Everything an effect can do is one of these times a driver: turn a joint, shift or turn a link, the base or the
tool, stretch the instrument. They are computed once for all rows; effects only combine them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.static.cell import Cell, Posed
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.static.setup import Setup, instrument_points
from app.diagnosis.static.situation import Situation


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """Columns (m, k, …): change of component k of row m per unit, whitened (times `weights`).

    Args:
        situation: the drivers.
        weights: (m, k) one over sigma; 0 where nothing was measured.
        joint: (m, k, n) per rad (or m).
        base: (m, k, 6) base displacement [1/m] and turn about its origin [1/rad].
        tool: (m, k, 6) tool displacement and turn in the flange; all reflectors together.
        link: (m, k, n, 4) in the order of geometry.AXES.
        stretch: (m, k, n) per relative growth of link k's vector.
        scale: (m, k) per relative stretch of the instrument.
        zero: (m, k) per metre of range.
        press: (m, k) per metre of depth.
    """

    situation: Situation
    weights: np.ndarray
    joint: np.ndarray
    base: np.ndarray
    tool: np.ndarray
    link: np.ndarray
    stretch: np.ndarray
    scale: np.ndarray
    zero: np.ndarray
    press: np.ndarray


class Mapper:
    """Carries displacements in base (points and turns) into whitened measured components."""

    def __init__(
        self, recording: StaticRecording, posed: Posed, setup: Setup, cell: Cell, weights: np.ndarray
    ):
        self.recording, self.weights = recording, weights
        self.points = instrument_points(recording, posed, setup)  # (m, r, 3)
        self.rotation = setup.rotations[recording.session]  # (m, 3, 3)
        self.gain = cell.scale
        distance = np.linalg.norm(self.points, axis=-1, keepdims=True)
        self.beam = self.points / np.maximum(distance, 1e-9)

    def __call__(self, points: np.ndarray, turn: np.ndarray | None) -> np.ndarray:
        """(m, r, 3, c) and (m, 3, c) in base -> (m, k, c)."""
        mode = self.recording.mode
        m, r, _, c = points.shape
        if mode == "targets":
            out = points[:, 0]
        else:
            moved = self.rotation[:, None] @ points * self.gain[:, None, None, None]
            if mode == "length":
                out = np.einsum("mi,mic->mc", self.beam[:, 0], moved[:, 0])[:, None]
            else:
                out = moved.reshape(m, 3 * r, c)
                if self.recording.orientations is not None:
                    turned = np.zeros((m, 3, c)) if turn is None else self.rotation @ turn
                    out = np.concatenate([out, turned], axis=1)
        return out * self.weights[:, :, None]

    def measured(self, points: np.ndarray) -> np.ndarray:
        """(m, r, 3) displacement in the instrument's frame -> (m, k)."""
        m = len(points)
        if self.recording.mode == "targets":
            return np.zeros((m, 3))
        if self.recording.mode == "length":
            out = np.einsum("mi,mi->m", self.beam[:, 0], points[:, 0])[:, None]
        else:
            out = points.reshape(m, -1)
            if self.recording.orientations is not None:
                out = np.concatenate([out, np.zeros((m, 3))], axis=1)
        return out * self.weights


def sensitivity(
    recording: StaticRecording, posed: Posed, setup: Setup, cell: Cell, weights: np.ndarray
) -> Sensitivity:
    """All elementary columns at the present state of the cell."""
    situation, frames = recording.situation, posed.frames
    chain = situation.chain
    m, n = cell.q.shape
    carry = Mapper(recording, posed, setup, cell, weights)
    points = posed.points  # (m, r, 3) in base, the base's own displacement included (small: lever arms only)
    r = points.shape[1]

    axes = np.swapaxes(frames.axes, 1, 2)  # (m, 3, n)
    turning = ~chain.prismatic
    arms = points[:, :, None] - frames.joint_positions[:, None]  # (m, r, n, 3)
    swing = np.swapaxes(np.cross(frames.axes[:, None], arms), 2, 3)  # (m, r, 3, n)
    slide = np.broadcast_to(axes[:, None], swing.shape)
    joint = carry(np.where(turning, swing, slide), np.where(turning, axes, 0.0))

    eye = np.eye(3)
    unit = np.broadcast_to(eye, (m, 3, 3))
    none = np.zeros((m, 3, 3))
    base = carry(
        np.concatenate([np.broadcast_to(eye, (m, r, 3, 3)), _cross_columns(unit, points)], axis=3),
        np.concatenate([none, unit], axis=2),
    )
    hand = frames.flange_rotations  # columns: flange axes in base
    lever = points - frames.flange_positions[:, None]
    tool = carry(
        np.concatenate([np.broadcast_to(hand[:, None], (m, r, 3, 3)), _cross_columns(hand, lever)], axis=3),
        np.concatenate([none, hand], axis=2),
    )

    next_r = np.concatenate([frames.joint_rotations[:, 1:], frames.flange_rotations[:, None]], axis=1)
    next_p = np.concatenate([frames.joint_positions[:, 1:], frames.flange_positions[:, None]], axis=1)
    directions = np.einsum("mnij,naj->mnai", next_r, situation.links.vectors)  # (m, n, 4, 3)
    reach = points[:, :, None] - next_p[:, None]  # (m, r, n, 3)
    shift = np.broadcast_to(directions[:, None, :, :2], (m, r, n, 2, 3))
    turn = np.cross(directions[:, None, :, 2:], reach[:, :, :, None])  # (m, r, n, 2, 3)
    moves = np.concatenate([shift, turn], axis=3).reshape(m, r, n * 4, 3)
    turns = np.concatenate([np.zeros((m, n, 2, 3)), directions[:, :, 2:]], axis=2).reshape(m, n * 4, 3)
    link = carry(np.swapaxes(moves, 2, 3), np.swapaxes(turns, 1, 2)).reshape(m, -1, n, 4)
    vectors = np.einsum("mnij,nj->min", next_r, situation.links.lengths)  # (m, 3, n)
    stretch = carry(np.broadcast_to(vectors[:, None], (m, r, 3, n)), None)
    press = carry(np.broadcast_to(-hand[:, None, :, 2:], (m, r, 3, 1)), None)[:, :, 0]
    return Sensitivity(
        situation, weights, joint, base, tool, link, stretch,
        carry.measured(carry.points), carry.measured(carry.beam), press,
    )  # fmt: skip


def _cross_columns(directions: np.ndarray, arms: np.ndarray) -> np.ndarray:
    """Columns direction_c x arm; (m, 3, c) and (m, r, 3) -> (m, r, 3, c)."""
    crossed = np.cross(np.swapaxes(directions, 1, 2)[:, None], arms[:, :, None])  # (m, r, c, 3)
    return np.swapaxes(crossed, 2, 3)
