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
from app.geometry import skew


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

    # All columns side by side, carried at once; turns matter only where orientations were measured.
    sizes = {"joint": n, "base": 6, "tool": 6, "link": 4 * n, "stretch": n, "press": 1}
    ends = np.cumsum([0, *sizes.values()]).tolist()
    at = {name: slice(a, b) for name, a, b in zip(sizes, ends, ends[1:], strict=False)}
    moves, turns = np.zeros((m, r, 3, ends[-1])), np.zeros((m, 3, ends[-1]))

    axes = np.moveaxis(frames.axes, 2, 0)  # (3, m, n)
    _crossed(axes[:, :, None], _arms(points, frames.joint_positions), moves[..., at["joint"]])
    turns[:, :, at["joint"]] = np.swapaxes(frames.axes, 1, 2)
    for j in np.flatnonzero(chain.prismatic):
        moves[..., j], turns[:, :, j] = frames.axes[:, None, j], 0.0

    moves[..., n : n + 3] = turns[:, :, n + 3 : n + 6] = np.eye(3)
    moves[..., n + 3 : n + 6] = -skew(points)  # columns: unit vectors x point
    hand = frames.flange_rotations  # columns: flange axes in base
    lever = points - frames.flange_positions[:, None]
    moves[..., n + 6 : n + 9] = hand[:, None]
    turns[:, :, n + 9 : n + 12] = hand
    hands = np.moveaxis(hand, 1, 0)  # (3, m, columns)
    _crossed(hands[:, :, None], np.moveaxis(lever, 2, 0)[..., None], moves[..., n + 9 : n + 12])

    next_r = np.concatenate([frames.joint_rotations[:, 1:], frames.flange_rotations[:, None]], axis=1)
    next_p = np.concatenate([frames.joint_positions[:, 1:], frames.flange_positions[:, None]], axis=1)
    along = np.concatenate([situation.links.vectors, situation.links.lengths[:, None]], axis=1)  # (n, 5, 3)
    tall = np.moveaxis(next_r, 1, 0).reshape(n, m * 3, 3) @ np.swapaxes(along, 1, 2)  # link by link
    directions = tall.reshape(n, m, 3, 5).transpose(2, 1, 0, 3)  # (3, m, n, 5)
    link = moves[..., at["link"]].reshape(m, r, 3, n, 4)
    link[..., :2] = directions[..., :2].transpose(1, 0, 2, 3)[:, None]
    reach = _arms(points, next_p)[..., None]
    _crossed(directions[:, :, None, :, 2:4], reach, link[..., 2:])
    moves[..., at["link"]] = link.reshape(m, r, 3, 4 * n)
    turning = turns[:, :, at["link"]].reshape(m, 3, n, 4)
    turning[..., 2:] = directions[..., 2:4].transpose(1, 0, 2, 3)
    turns[:, :, at["link"]] = turning.reshape(m, 3, 4 * n)
    moves[..., at["stretch"]] = directions[..., 4].transpose(1, 0, 2)[:, None]
    moves[..., -1] = -hand[:, None, :, 2]

    every = carry(moves, turns)
    return Sensitivity(
        situation, weights, every[:, :, at["joint"]], every[:, :, at["base"]], every[:, :, at["tool"]],
        every[:, :, at["link"]].reshape(m, -1, n, 4), every[:, :, at["stretch"]],
        carry.measured(carry.points), carry.measured(carry.beam), every[:, :, -1],
    )  # fmt: skip


def _arms(points: np.ndarray, origins: np.ndarray) -> np.ndarray:
    """(3, m, r, n) from origins (m, n, 3) to points (m, r, 3)."""
    return np.moveaxis(points, 2, 0)[..., None] - np.moveaxis(origins, 2, 0)[:, :, None]


def _crossed(a: np.ndarray, b: np.ndarray, out: np.ndarray) -> None:
    """a x b, components first, into out (m, r, 3, ...): numpy's own product is several times slower."""
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        np.subtract(a[i] * b[j], a[j] * b[i], out=out[:, :, k])
