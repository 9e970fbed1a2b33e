"""A recording explained so far: set-up and effects with values, and what they leave over."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.kinematic.cell import Cell, Posed, pose
from app.diagnosis.models.kinematic.nuisance import nuisance_columns, starting_setup
from app.diagnosis.models.kinematic.sensitivity import Sensitivity
from app.diagnosis.models.kinematic.setup import Setup, moved, residual
from app.diagnosis.models.kinematic.terms import Term, apply_terms
from app.diagnosis.regression.design import Absorbed
from app.kinematics.chain import Frames

if TYPE_CHECKING:
    from app.diagnosis.observations.pose_data import StaticRecording


#: Gauss-Newton ends when a step changes the sum of squares by less than this share.
_SETTLED = 1e-9
#: Share of the way of the full least-norm step by which a touch's angles are brought to its target.
_DAMPING = 1e-4


@dataclass(frozen=True, eq=False)
class State:
    """Where a fit stands.

    Args:
        recording: the rows.
        setup: base, tool and touched points as fitted.
        terms: fitted effects in the model, with values.
        held: effects that are known and not fitted.
        weights: (m, k) one over sigma, times the root of the row's robust weight; 0 where nothing was measured.
        cell, posed: the exact model at these values.
        residual: (m, k) measured minus predicted [m, rad].
    """

    recording: StaticRecording
    setup: Setup
    terms: tuple[Term, ...]
    weights: np.ndarray
    cell: Cell
    posed: Posed
    residual: np.ndarray
    held: tuple[Term, ...] = ()

    @property
    def white(self) -> np.ndarray:
        """(N,) weighted residual."""
        return (self.residual * self.weights).reshape(-1)

    @property
    def squares(self) -> float:
        """Weighted sum of squares."""
        return float(self.white @ self.white)

    @property
    def misfit(self) -> float:
        """Root mean square of the position components over all rows, set aside or not [m]."""
        counted = self.recording.present & ~self.recording.angular
        return float(np.sqrt(np.mean(self.residual[counted] ** 2)))


def state_of(
    recording: StaticRecording,
    setup: Setup,
    terms: tuple[Term, ...],
    weights: np.ndarray,
    cell: Cell | None = None,
    held: tuple[Term, ...] = (),
    frames: Frames | None = None,
) -> State:
    """The exact model evaluated; touched points follow as the weighted mean of the tips that touched them.

    Args:
        cell, frames: of these very terms, where they are known already.
    """
    cell = apply_terms(recording.situation, (*held, *terms)) if cell is None else cell
    posed = pose(recording.situation, cell, setup.tool_rows(recording), frames)
    if recording.mode == "targets":
        setup = replace(setup, targets=_touched(recording, posed.points[:, 0], weights))
    return State(recording, setup, terms, weights, cell, posed, residual(recording, posed, setup, cell), held)


def started(recording: StaticRecording, held: tuple[Term, ...], weights: np.ndarray) -> State:
    """A first state from a closed-form guess of the set-up, effects held."""
    situation = recording.situation
    cell = apply_terms(situation, held)
    posed = pose(situation, cell, np.zeros((recording.reflectors, 3)))
    setup = starting_setup(recording, posed.hand, posed.frames.flange_positions)
    return state_of(recording, setup, (), weights, cell, held, posed.frames)


def settled(state: State, iterations: int = 20) -> State:
    """The set-up fitted to the end by Gauss-Newton, effects held."""
    now = state
    for _ in range(iterations):
        free, _ = free_columns(now, _plain_columns(now))
        step, gain = _least_squares(free, now.white)
        if gain <= _SETTLED * now.squares:
            break
        scale, better = 1.0, None
        for _ in range(8):
            trial = stepped(now, scale * step)
            if np.isfinite(trial.squares) and trial.squares <= now.squares:
                better = trial
                break
            scale *= 0.5
        if better is None:
            break
        gained = now.squares - better.squares
        now = better
        if gained <= _SETTLED * now.squares:
            break
    return now


def stepped(state: State, step: np.ndarray) -> State:
    """The state after a step (f,) of the set-up, in the order of `free_columns`."""
    recording, setup = state.recording, state.setup
    if recording.mode == "targets":
        setup = replace(setup, tools=setup.tools + step)
    else:
        setup = moved(setup, recording, step)
    return state_of(recording, setup, state.terms, state.weights, state.cell, state.held, state.posed.frames)


def columns_of(state: State) -> Sensitivity:
    """Elementary columns at this state.

    Touches: errors are in the angles too. A column evaluated at the recorded angles carries their error, which
    biases every coefficient towards zero; it is evaluated at the nearest angles that meet the target.
    """
    recording, posed, cell = state.recording, state.posed, state.cell
    if recording.kind == "touch":
        cell = cell.with_joints(_meeting(state))
        posed = pose(recording.situation, cell, state.setup.tool_rows(recording))
    return Sensitivity(recording, posed, state.setup, cell, state.weights)


def _plain_columns(state: State) -> Sensitivity:
    """Elementary columns at the recorded angles: good enough for steps of the set-up alone."""
    return Sensitivity(state.recording, state.posed, state.setup, state.cell, state.weights)


def free_columns(state: State, columns: Sensitivity) -> tuple[np.ndarray, Absorbed | None]:
    """Whitened columns (N, f) of the set-up, and the touched points as absorbed parameters."""
    recording = state.recording
    n = state.weights.size
    if recording.mode != "targets":
        return nuisance_columns(recording, columns).reshape(n, -1), None
    label = recording.target[:, None] * 3 + np.arange(3)
    absorbed = Absorbed(label.reshape(-1), state.weights.reshape(-1))
    # measured = target - tool point, so the tool counts against what is measured in the other modes
    return columns.tool[:, :, :3].reshape(n, 3), absorbed


def _least_squares(free: np.ndarray, white: np.ndarray) -> tuple[np.ndarray, float]:
    """The step, and by how much the sum of squares falls along the columns."""
    scale = np.sqrt(np.einsum("nf,nf->f", free, free))
    scale = np.where(scale > 0, scale, 1.0)
    scaled = free / scale
    values, vectors = np.linalg.eigh(scaled.T @ scaled)
    seen = values > 1e-10 * max(values[-1], 1e-300)
    half = vectors[:, seen]
    along = half.T @ (scaled.T @ white)
    return half @ (along / values[seen]) / scale, float(along @ (along / values[seen]))


def _touched(recording: StaticRecording, points: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(t, 3) [m]."""
    count = len(recording.target_names)
    out = np.empty((count, 3))
    squares = weights**2
    for c in range(3):
        norm = np.bincount(recording.target, squares[:, c], count)
        total = np.bincount(recording.target, squares[:, c] * points[:, c], count)
        plain = np.bincount(recording.target, points[:, c], count) / np.maximum(
            np.bincount(recording.target, minlength=count), 1
        )
        out[:, c] = np.where(norm > 0, total / np.where(norm > 0, norm, 1.0), plain)
    return out


def _meeting(state: State) -> np.ndarray:
    """(m, n) the joint angles nearest to the recorded ones at which the tip meets its target."""
    recording, chain = state.recording, state.recording.situation.chain
    q, base = state.cell.q.copy(), state.cell.base
    arm = replace(state.cell, base=np.zeros((1, 6)))  # the goal is put where the arm's own base has it
    tool = state.setup.tool_rows(recording)
    missing = state.residual[:, :3]
    if recording.mode != "targets":
        missing = np.einsum("mji,mj->mi", state.setup.rotations[recording.session], missing)
    goal = state.posed.points[:, 0] + missing - base[:, :3]
    goal = (goal[:, None] @ state.posed.base_rotation)[:, 0]
    for _ in range(2):
        posed = pose(recording.situation, arm.with_joints(q), tool)
        jacobian = chain.jacobian_columns(posed.frames, posed.points[:, 0])  # (m, 3, n)
        gram = jacobian @ np.swapaxes(jacobian, 1, 2)
        damping = _DAMPING * np.trace(gram, axis1=1, axis2=2)[:, None, None] * np.eye(3)
        need = np.linalg.solve(gram + damping, (goal - posed.points[:, 0])[:, :, None])
        q = q + (np.swapaxes(jacobian, 1, 2) @ need)[:, :, 0]
    return q
