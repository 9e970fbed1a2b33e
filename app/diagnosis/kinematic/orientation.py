"""Measured orientation beside measured points: observations with a noise of their own, and what each is worth.

Orientation mostly comes from a few marks a hand's breadth apart: besides noise it has errors that hang together from
pose to pose (a mark that was seen from the side, a lens), which many rows do not average out. What points alone say of
the arm tells how large those are: points and orientation must agree on zeros, lengths, angles and stiffness.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.models.kinematic.candidates import library_of
from app.diagnosis.models.kinematic.library import Linear, linearised
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.regression.design import Design
from app.diagnosis.regression.evidence import Evidence
from app.diagnosis.thresholds.noise import CHANCE


def with_worth(recording: StaticRecording, held: tuple[Term, ...]) -> StaticRecording:
    """The recording with the number of independent measurements that one measured angle counts for.

    Args:
        held: effects known already.
    """
    if recording.orientations is None or recording.points is None:
        return recording
    plain, _ = plain_state(recording, held)
    linear = linearised(plain, library_of(recording.situation), (Level.CALIBRATION,), set())
    return replace(recording, turn_worth=1.0 / max(1.0, _disagreement(linear)))


def _disagreement(linear: Linear) -> float:
    """By how much orientation and points disagree on the arm, in variances, along the direction where it is worst.

    With w, V the posterior of calibration by points alone, C the columns of orientation (base as the points place it,
    the mount free) and U a basis of them, u = U'(y - C w) should have the covariance sigma^2 I + U'C V C'U, sigma^2
    the mean square of y - C w off U. Errors that hang together make u larger; one that chance does not make tells how
    large they are, and weights fall until it agrees.
    Source: Birge, "The calculation of errors by the method of least squares", Phys. Rev. 40 (1932).
    """
    turns = np.broadcast_to(linear.state.recording.angular, linear.state.weights.shape).reshape(-1)
    seen = linear.state.weights.reshape(-1) > 0
    at, of = ~turns & seen, turns & seen
    columns, free, response = linear.design.raw, linear.free, linear.state.white
    points = Design(response[at], free[at], int(at.sum()))
    points.add(columns[at])
    evidence = Evidence(points, linear.groups)
    families = {g: 1.0 for g, group in enumerate(linear.groups) if isinstance(group.label, str)}
    posterior = evidence.posterior(evidence.tuned(families, 1))
    inside = posterior.columns
    if not len(inside) or not of.any():
        return 1.0
    own = np.linalg.norm(free[at], axis=0) > 0  # of base and tool; the mount's do not show in points
    placed = np.linalg.lstsq(
        free[at][:, own], np.column_stack([columns[at][:, inside], response[at]]), rcond=1e-9
    )[0]
    told = np.column_stack([columns[of][:, inside], response[of]]) - free[of][:, own] @ placed
    mount, _ = np.linalg.qr(free[of][:, ~own])
    told = told - mount @ (mount.T @ told)
    arm, left = told[:, :-1], told[:, -1] - told[:, :-1] @ posterior.weights
    basis, sizes, _ = np.linalg.svd(arm, full_matrices=False)
    basis = basis[:, sizes > 1e-6 * sizes[0]]
    along = basis.T @ left
    rest = max(len(left) - basis.shape[1] - mount.shape[1], 1)
    noise = max(float(left @ left - along @ along), 0.0) / rest
    half = basis.T @ arm
    spread = noise * np.eye(len(along)) + half @ posterior.covariance @ half.T
    sizes, directions = np.linalg.eigh(spread)
    squares = (directions.T @ along) ** 2 / sizes
    largest = float(squares.max())
    return largest if largest > 2.0 * np.log(len(squares) / CHANCE) else 1.0
