"""How every measured component moves with every elementary displacement of the cell: the linear columns.

Everything an effect can do is one of these times a driver: turn a joint, shift or turn a link, the base or the
tool, stretch the instrument. Each kind is computed for all rows at once when it is first asked for; effects only
combine them.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.kinematic.setup import Setup, instrument_points
from app.geometry import skew

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.cell import Cell, Posed
    from app.diagnosis.observations.pose_data import StaticRecording


class Sensitivity:
    """Columns (m, k, …): change of component k of row m per unit, whitened (times `weights`).

    Attributes:
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

    def __init__(
        self, recording: StaticRecording, posed: Posed, setup: Setup, cell: Cell, weights: np.ndarray
    ):
        self.situation, self.weights = recording.situation, weights
        self._posed = posed
        # what belongs to the arm moves as the arm does, before its base is displaced, and is turned with the base
        displaced = bool(np.any(cell.base))
        self._points = posed.points
        self._base_turn: np.ndarray | None = None
        if displaced:
            self._base_turn = posed.base_rotation
            self._points = (posed.points - cell.base[:, None, :3]) @ posed.base_rotation
        self._carry = Mapper(recording, posed, setup, cell, weights)
        self._turned = (
            recording.orientations is not None
        )  # turns matter only where orientations were measured

    def _of_arm(self, moves: np.ndarray, turns: np.ndarray | None) -> np.ndarray:
        """(m, r, 3, c) and (m, 3, c) in a base that stands where the description has it -> (m, k, c)."""
        turn = self._base_turn
        if turn is not None:
            moves = turn[:, None] @ moves
            turns = None if turns is None else turn @ turns
        return self._carry(moves, turns)

    @cached_property
    def joint(self) -> np.ndarray:
        frames, points = self._posed.frames, self._points
        m, r = points.shape[:2]
        axes = np.moveaxis(frames.axes, 2, 0)  # (3, m, n)
        moves = np.empty((m, r, 3, axes.shape[2]))
        _crossed(axes[:, :, None], _arms(points, frames.joint_positions), moves)
        turns = np.swapaxes(frames.axes, 1, 2).copy() if self._turned else None
        for j in np.flatnonzero(self.situation.chain.prismatic):
            moves[..., j] = frames.axes[:, None, j]
            if turns is not None:
                turns[:, :, j] = 0.0
        return self._of_arm(moves, turns)

    @cached_property
    def base(self) -> np.ndarray:
        points = self._posed.points
        m, r = points.shape[:2]
        moves, turns = np.zeros((m, r, 3, 6)), None
        moves[..., :3] = np.eye(3)
        moves[..., 3:] = -skew(points)  # columns: unit vectors x point
        if self._turned:
            turns = np.zeros((m, 3, 6))
            turns[:, :, 3:] = np.eye(3)
        return self._carry(moves, turns)

    @cached_property
    def tool(self) -> np.ndarray:
        frames, points = self._posed.frames, self._points
        m, r = points.shape[:2]
        hand = frames.flange_rotations  # columns: flange axes in base
        moves, turns = np.empty((m, r, 3, 6)), None
        moves[..., :3] = hand[:, None]
        lever = points - frames.flange_positions[:, None]
        hands = np.moveaxis(hand, 1, 0)  # (3, m, columns)
        _crossed(hands[:, :, None], np.moveaxis(lever, 2, 0)[..., None], moves[..., 3:])
        if self._turned:
            turns = np.zeros((m, 3, 6))
            turns[:, :, 3:] = hand
        return self._of_arm(moves, turns)

    @cached_property
    def link(self) -> np.ndarray:
        frames, points = self._posed.frames, self._points
        directions = self._directions[..., :4]
        m, r, n = *points.shape[:2], directions.shape[2]
        moves, turns = np.empty((m, r, 3, n, 4)), None
        moves[..., :2] = directions[..., :2].transpose(1, 0, 2, 3)[:, None]
        next_p = np.concatenate([frames.joint_positions[:, 1:], frames.flange_positions[:, None]], axis=1)
        _crossed(directions[:, :, None, :, 2:], _arms(points, next_p)[..., None], moves[..., 2:])
        if self._turned:
            turns = np.zeros((m, 3, n, 4))
            turns[..., 2:] = directions[..., 2:].transpose(1, 0, 2, 3)
            turns = turns.reshape(m, 3, -1)
        return self._of_arm(moves.reshape(m, r, 3, -1), turns).reshape(m, -1, n, 4)

    @cached_property
    def stretch(self) -> np.ndarray:
        m, r = self._posed.points.shape[:2]
        along = self._directions[..., 4].transpose(1, 0, 2)[:, None]
        return self._of_arm(np.broadcast_to(along, (m, r, *along.shape[2:])), None)

    @cached_property
    def scale(self) -> np.ndarray:
        return self._carry.measured(self._carry.points)

    @cached_property
    def zero(self) -> np.ndarray:
        return self._carry.measured(self._carry.beam)

    @cached_property
    def press(self) -> np.ndarray:
        m, r = self._posed.points.shape[:2]
        down = -self._posed.frames.flange_rotations[:, None, :, 2, None]
        return self._of_arm(np.broadcast_to(down, (m, r, 3, 1)), None)[:, :, 0]

    @cached_property
    def _directions(self) -> np.ndarray:
        """(3, m, n, 5) in base: the axes of every link's geometry and its own vector."""
        frames, links = self._posed.frames, self.situation.links
        m, n = frames.axes.shape[:2]
        next_r = np.concatenate([frames.joint_rotations[:, 1:], frames.flange_rotations[:, None]], axis=1)
        along = np.concatenate([links.vectors, links.lengths[:, None]], axis=1)  # (n, 5, 3)
        tall = np.moveaxis(next_r, 1, 0).reshape(n, m * 3, 3) @ np.swapaxes(along, 1, 2)  # link by link
        return tall.reshape(n, m, 3, 5).transpose(2, 1, 0, 3)


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


def _arms(points: np.ndarray, origins: np.ndarray) -> np.ndarray:
    """(3, m, r, n) from origins (m, n, 3) to points (m, r, 3)."""
    return np.moveaxis(points, 2, 0)[..., None] - np.moveaxis(origins, 2, 0)[:, :, None]


def _crossed(a: np.ndarray, b: np.ndarray, out: np.ndarray) -> None:
    """a x b, components first, into out (m, r, 3, ...): numpy's own product is several times slower."""
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        np.subtract(a[i] * b[j], a[j] * b[i], out=out[:, :, k])
