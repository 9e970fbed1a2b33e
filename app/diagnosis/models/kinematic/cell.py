"""The exact forward model of a cell: shown angles in, measured values out; effects change it before it is run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.geometry import exp_so3
from app.kinematics.chain import Frames

if TYPE_CHECKING:
    from app.diagnosis.models.kinematic.situation import Situation


#: (1, 3, 3) of a base that has not turned.
_STRAIGHT = np.eye(3)[None]


@dataclass(frozen=True, eq=False)
class Cell:
    """What is true of every row, as far as the effects say. Arrays broadcast over the m rows.

    Args:
        q: (m, n) where the joints really are [rad or m].
        shifts: (1 or m, n, 3) displacement of the placement after link k, in its own frame [m].
        turns: (1 or m, n, 3) its turn, as a rotation vector [rad].
        base: (1 or m, 6) displacement [m] and turn [rad] of the arm's base, in base.
        tool: (1 or m, 6) displacement and turn of the tool, in the flange.
        reflectors: (1 or m, r, 3) displacement of each reflector beside the others, in the flange [m].
        scale: (1 or m,) measured = scale * true.
        zero: (1 or m,) range or length that the instrument shows too much [m].
        press: (1 or m,) depth by which the tip stands beyond the target, along flange Z [m].
    """

    q: np.ndarray
    shifts: np.ndarray
    turns: np.ndarray
    base: np.ndarray
    tool: np.ndarray
    reflectors: np.ndarray
    scale: np.ndarray
    zero: np.ndarray
    press: np.ndarray

    def add_joint(self, joint: int, amount: np.ndarray | float) -> Cell:
        """The cell with joint `joint` (0-based) displaced by `amount` (scalar or (m,)) [rad or m]."""
        q = self.q.copy()
        q[:, joint] += amount
        return replace(self, q=q)

    def with_joints(self, q: np.ndarray) -> Cell:
        """The cell with its joints at q (m, n)."""
        return replace(self, q=q)

    def add_link(self, link: int, shift: np.ndarray, turn: np.ndarray) -> Cell:
        """The cell with the placement after link `link` (0-based) moved; (3,) or (m, 3) each."""
        return replace(self, shifts=_added(self.shifts, link, shift), turns=_added(self.turns, link, turn))


def _added(array: np.ndarray, link: int, amount: np.ndarray) -> np.ndarray:
    if not amount.any():
        return array
    rows = len(amount) if amount.ndim == 2 else 1
    out = np.repeat(array, rows, axis=0) if rows > len(array) else array.copy()
    out[:, link] += amount
    return out


def nominal_cell(situation: Situation) -> Cell:
    """The cell in which the description is right."""
    n = situation.joint_count
    return Cell(
        q=situation.q,
        shifts=np.zeros((1, n, 3)),
        turns=np.zeros((1, n, 3)),
        base=np.zeros((1, 6)),
        tool=np.zeros((1, 6)),
        reflectors=np.zeros((1, situation.reflectors, 3)),
        scale=np.ones(1),
        zero=np.zeros(1),
        press=np.zeros(1),
    )


@dataclass(frozen=True, eq=False)
class Posed:
    """Where everything is, in base.

    Args:
        frames: of the joints and the flange, before the base's own displacement.
        points: (m, r, 3) [m] tool points after it.
        hand: (m, 3, 3) rotation of the flange, tool turn included, after it.
        base_rotation: (1 or m, 3, 3) the base's own turn.
    """

    frames: Frames
    points: np.ndarray
    hand: np.ndarray
    base_rotation: np.ndarray


def pose(situation: Situation, cell: Cell, tool: np.ndarray, frames: Frames | None = None) -> Posed:
    """Runs the forward model.

    Args:
        tool: (r, 3) or (m, r, 3) tool points in the flange [m].
        frames: of this very cell, where they are known already.
    """
    if frames is None:
        chain, moved = situation.chain, bool(np.any(cell.shifts) or np.any(cell.turns))
        frames = chain.frames(cell.q, *_placements(cell)) if moved else chain.frames(cell.q)
    local, hand, base_rotation = tool if tool.ndim == 3 else tool[None], frames.flange_rotations, _STRAIGHT
    if cell.reflectors.any():
        local = local + cell.reflectors
    if cell.tool.any():
        tool_turn = exp_so3(cell.tool[:, 3:])
        local = local @ np.swapaxes(tool_turn, 1, 2) + cell.tool[:, None, :3]
        hand = hand @ tool_turn
    points = _turned(frames.flange_rotations, local) + frames.flange_positions[:, None]
    if cell.press.any():
        points = points - cell.press[:, None, None] * frames.flange_rotations[:, None, :, 2]
    if cell.base.any():
        base_rotation = exp_so3(cell.base[:, 3:])
        points = _turned(base_rotation, points) + cell.base[:, None, :3]
        hand = base_rotation @ hand
    return Posed(frames, points, hand, base_rotation)


def _turned(rotations: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(m, r, 3) points (1 or m, r, 3) turned by (1 or m, 3, 3)."""
    return points @ np.swapaxes(rotations, 1, 2)


def _placements(cell: Cell) -> tuple[np.ndarray, np.ndarray]:
    """Displacements for Chain.frames: none before joint 1, then after every link."""
    shifts = np.concatenate([np.zeros_like(cell.shifts[:, :1]), cell.shifts], axis=1)
    turns = exp_so3(np.concatenate([np.zeros_like(cell.turns[:, :1]), cell.turns], axis=1))
    return (shifts[0], turns[0]) if len(shifts) == 1 and len(turns) == 1 else (shifts, turns)
