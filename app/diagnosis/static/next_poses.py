"""The poses that would best separate the two best explanations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.result import Finding
from app.diagnosis.static.fit import Fitted, fit
from app.diagnosis.static.library import Candidate
from app.diagnosis.static.looking import new_term
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.static.situation import situation_for
from app.kinematics import RobotModel

COUNT = 3
_DRAWN = 400
_MARGIN = 0.02  # rad or m kept from the joint limits
_FLOOR = 0.05  # m above the base's own height that a proposed flange keeps


def next_poses(
    robot: RobotModel, fitted: Fitted, findings: tuple[Finding, ...], wanted: tuple[Candidate, ...]
) -> tuple[tuple[float, ...], ...]:
    """Joint positions within limits where the first finding and its nearest rival differ most.

    For a pose x let e be the prediction of A minus that of B fitted to A, and M the columns of what is free: the
    pose is taken with the largest e^T (I + M H^-1 M^T)^-1 e, which counts what the free parameters cannot take up.
    """
    pair = _rivals(fitted, findings, wanted)
    if pair is None:
        return ()
    index, rival = pair
    poses = _drawn(robot, fitted)
    if not len(poses):
        return ()
    score = _separation(robot, fitted, index, rival, poses)
    order = np.argsort(-score)
    chosen: list[int] = []
    for at in order:
        apart = all(np.linalg.norm(poses[at] - poses[c]) > 0.5 for c in chosen)
        if apart and score[at] > 0:
            chosen.append(int(at))
        if len(chosen) == COUNT:
            break
    return tuple(tuple(float(v) for v in poses[c]) for c in chosen)


def _rivals(fitted: Fitted, findings, wanted) -> tuple[int, Candidate] | None:
    """The finding with the nearest alternative that differs at all, and that alternative."""
    best, pair = np.inf, None
    for finding in findings:
        index = next(
            (
                i
                for i, t in enumerate(fitted.terms)
                if t.effect.key == finding.effect and dict(t.where) == dict(finding.where)
            ),
            None,
        )
        if index is None or "from_row" in finding.where:
            continue
        for other in finding.alternatives:
            rival = next(
                (
                    c
                    for c in wanted
                    if c.effect.key == other.effect and dict(c.place.where) == dict(other.where)
                ),
                None,
            )
            if rival is not None and not rival.place.scan and other.delta_bic < best:
                best, pair = other.delta_bic, (index, rival)
    return pair


def _drawn(robot: RobotModel, fitted: Fitted) -> np.ndarray:
    """Random poses inside the limits, the flange not below the base and no nearer to it than the recorded ones."""
    rng = np.random.default_rng(0)
    low = np.maximum(robot.lower, -np.pi) + _MARGIN
    high = np.minimum(robot.upper, np.pi) - _MARGIN
    if np.any(low >= high):
        return np.zeros((0, robot.joint_count))
    poses = rng.uniform(low, high, (_DRAWN, robot.joint_count))
    flange = robot.chain.frames(poses).flange_positions
    seen = fitted.posed.frames.flange_positions
    least = 0.8 * np.linalg.norm(seen[:, :2], axis=1).min()
    good = (flange[:, 2] > min(_FLOOR, seen[:, 2].min())) & (np.linalg.norm(flange[:, :2], axis=1) > least)
    return poses[good]


def _separation(
    robot: RobotModel, fitted: Fitted, index: int, rival: Candidate, poses: np.ndarray
) -> np.ndarray:
    """(m,) information a pose adds for A against B."""
    here = _imagined(robot, fitted, poses)
    weights = np.broadcast_to(fitted.weights.max(axis=0), (here.size, fitted.weights.shape[1]))
    with_a = fit(here, fitted.setup, fitted.terms, weights, held=fitted.held, iterations=0)
    terms = list(fitted.terms)
    terms[index] = new_term(rival, fitted)
    other = fit(fitted.recording, fitted.setup, tuple(terms), fitted.weights, held=fitted.held)
    with_b = fit(here, other.setup, other.terms, weights, held=other.held, iterations=0)
    k = weights.shape[1]
    difference = (with_a.white - with_b.white)[: len(poses) * k].reshape(len(poses), k)
    columns = with_b.jacobian[: len(poses) * k].reshape(len(poses), k, -1)
    hessian = other.jacobian.T @ other.jacobian
    inverse = np.linalg.pinv(hessian, rcond=1e-12, hermitian=True)
    spread = np.eye(k) + columns @ inverse @ np.swapaxes(columns, 1, 2)
    solved = np.linalg.solve(spread, difference[:, :, None])[:, :, 0]
    return np.einsum("mk,mk->m", difference, solved)


def _imagined(robot: RobotModel, fitted: Fitted, poses: np.ndarray) -> StaticRecording:
    """A recording of those poses, in the first session, whose measured values do not matter.

    One row a further session follows them, so that the unknowns are those of the recording itself.
    """
    old = fitted.recording
    others = np.arange(1, old.session_count)
    session = np.concatenate([np.zeros(len(poses), int), others])
    poses = np.concatenate([poses, np.repeat(poses[:1], len(others), axis=0)])
    m = len(poses)
    situation = situation_for(robot, poses, declared_compliance=old.situation.declared_compliance)
    situation = replace(
        situation,
        time=np.full(m, old.situation.time[-1]),
        approach=np.zeros_like(poses),
        order=np.full(m, old.situation.order[-1]),
    )
    if old.situation.temperature is not None:
        situation = replace(situation, temperature=np.full(m, old.situation.temperature[-1]))
    return replace(
        old,
        rows=np.arange(m),
        points=None if old.points is None else np.zeros((m, *old.points.shape[1:])),
        orientations=None if old.orientations is None else np.broadcast_to(np.eye(3), (m, 3, 3)),
        lengths=None if old.lengths is None else np.zeros(m),
        target=np.zeros(m, int),
        session=session,
        pose=np.arange(m),
        situation=situation,
    )
