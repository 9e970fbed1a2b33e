"""The poses that would best separate the two best explanations."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.kinematic.description import Description
from app.diagnosis.models.kinematic.candidates import Candidate
from app.diagnosis.models.kinematic.situation import Situation, situation_for
from app.diagnosis.models.kinematic.state import columns_of, free_columns, state_of
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.result import Finding
from app.kinematics import RobotModel

if TYPE_CHECKING:
    from app.diagnosis.kinematic.findings import Named


COUNT = 3
_DRAWN = 300
_MARGIN = 0.02  # rad or m kept from the joint limits
_FLOOR = 0.05  # m above the base's own height that a proposed flange keeps
_APART = 0.5  # rad or m between two proposals, over all joints: another of the same says nothing new


def next_poses(
    robot: RobotModel, found: Description, names: list[Named], said: tuple[Finding, ...]
) -> tuple[tuple[float, ...], ...]:
    """Joint positions within limits where a finding and its nearest rival differ most.

    With a and b the columns of finding and rival, b scaled to imitate a as well as the recording lets it, a pose is
    worth e' (I + M H^-1 M')^-1 e: e the difference there, M the columns of all that is free and H their information.
    """
    pair = _rivals(found, names, said)
    if pair is None:
        return ()
    poses = _drawn(robot, found)
    if not len(poses):
        return ()
    score = _separation(robot, found, pair, poses)
    chosen: list[int] = []
    for at in np.argsort(-score):
        if score[at] > 0 and all(np.linalg.norm(poses[at] - poses[c]) > _APART for c in chosen):
            chosen.append(int(at))
        if len(chosen) == COUNT:
            break
    return tuple(tuple(float(v) for v in poses[c]) for c in chosen)


def _rivals(
    found: Description, names: list[Named], said: tuple[Finding, ...]
) -> tuple[Named, Candidate] | None:
    """The finding with the nearest alternative that does not hang on a row, and that alternative."""
    own = said[len(said) - len(names) :]
    best, pair = np.inf, None
    for name, finding in zip(names, own, strict=True):
        if "from_row" in finding.where:
            continue
        for other in finding.alternatives:
            for candidate in found.library.fixed:
                same = candidate.effect.key == other.effect and dict(candidate.place.where) == dict(
                    other.where
                )
                if same and not candidate.place.scan and other.delta_bic < best:
                    best, pair = other.delta_bic, (name, candidate)
    return pair


def _drawn(robot: RobotModel, found: Description) -> np.ndarray:
    """Random poses inside the limits, the flange not below the base and no nearer to it than the recorded ones."""
    rng = np.random.default_rng(0)
    low = np.maximum(robot.lower, -np.pi) + _MARGIN
    high = np.minimum(robot.upper, np.pi) - _MARGIN
    if np.any(low >= high):
        return np.zeros((0, robot.joint_count))
    poses = rng.uniform(low, high, (_DRAWN, robot.joint_count))
    flange = robot.chain.frames(poses).flange_positions
    seen = found.state.posed.frames.flange_positions
    least = 0.8 * np.linalg.norm(seen[:, :2], axis=1).min()
    good = (flange[:, 2] > min(_FLOOR, seen[:, 2].min())) & (np.linalg.norm(flange[:, :2], axis=1) > least)
    return poses[good]


def _separation(
    robot: RobotModel, found: Description, pair: tuple[Named, Candidate], poses: np.ndarray
) -> np.ndarray:
    """(m,) information a pose adds for one explanation against the other."""
    name, rival = pair
    first = found.library.fixed[name.number]
    linear = found.linear
    here = _imagined(robot, found.state.recording, poses)
    sigma = found.state.weights.max(axis=0)
    weights = np.broadcast_to(sigma, (here.size, len(sigma)))
    there = state_of(here, found.state.setup, (), weights)
    columns = columns_of(there)
    k = weights.shape[1]

    def at(candidate: Candidate) -> np.ndarray:
        return (
            candidate.effect.columns(columns, candidate.place).reshape(here.size * k, -1) * candidate.widths
        )

    free, _ = free_columns(there, columns)
    a_here, b_here = at(first), at(rival)
    a, b = linear.raw(first), linear.raw(rival)
    values = name.values / first.widths
    known = np.hstack([linear.free, b])
    told = np.linalg.lstsq(known, a @ values, rcond=1e-8)[0]
    new = np.hstack([free, b_here])
    difference = (a_here @ values - new @ told).reshape(here.size, k)
    inverse = np.linalg.pinv(known.T @ known, rcond=1e-12, hermitian=True)
    m = new.reshape(here.size, k, -1)
    spread = np.eye(k) + m @ inverse @ np.swapaxes(m, 1, 2)
    solved = np.linalg.solve(spread, difference[:, :, None])[:, :, 0]
    return np.einsum("mk,mk->m", difference, solved)[: len(poses)]


def _imagined(robot: RobotModel, old: StaticRecording, poses: np.ndarray) -> StaticRecording:
    """A recording of those poses, in the first session, whose measured values do not matter.

    One row a further session follows them, so that the unknowns are those of the recording itself.
    """
    others = np.arange(1, old.session_count)
    session = np.concatenate([np.zeros(len(poses), int), others])
    poses = np.concatenate([poses, np.repeat(poses[:1], len(others), axis=0)])
    m = len(poses)
    return replace(
        old,
        kind="tracker",
        rows=np.arange(m),
        points=None if old.points is None else np.zeros((m, *old.points.shape[1:])),
        orientations=None if old.orientations is None else np.broadcast_to(np.eye(3), (m, 3, 3)),
        lengths=None if old.lengths is None else np.zeros(m),
        target=np.zeros(m, int),
        session=session,
        pose=np.arange(m),
        situation=_situation(robot, old.situation, poses),
    )


def _situation(robot: RobotModel, old: Situation, poses: np.ndarray) -> Situation:
    m = len(poses)
    new = situation_for(robot, poses, declared_compliance=old.declared_compliance)
    warm = None if old.temperature is None else np.full(m, old.temperature[-1])
    return replace(
        new,
        time=np.full(m, old.time[-1]),
        time_unit=old.time_unit,
        approach=np.zeros_like(poses),
        order=np.full(m, old.order[-1]),
        temperature=warm,
    )
