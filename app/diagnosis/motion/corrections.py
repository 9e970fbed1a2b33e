"""What is undone in the samples before anything else is compared: late torques, wrong factors, a leaning base."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.motion.errors import raw_columns
from app.diagnosis.motion.exact import ExactFit
from app.diagnosis.motion.system import System
from app.kinematics.robot import GRAVITY


@dataclass(frozen=True, eq=False)
class Corrections:
    """What is undone.

    Args:
        delay: of the torques [s].
        scale: (n,) recorded = (1 + scale) * true.
        gravity: (3,) [m/s^2].
        beyond: (M, n) torque [Nm] that the laws of the last round add, where a delay was among them: it is late too.
    """

    delay: float
    scale: np.ndarray
    gravity: np.ndarray
    beyond: np.ndarray | None = None


def further(old: Corrections, system: System, fit: ExactFit) -> Corrections | None:
    """The next correction, or None where nothing moves any more."""
    delay, scale, gravity, moved = old.delay, old.scale.copy(), old.gravity.copy(), False
    for term, values, covariance in zip(fit.terms, fit.values, fit.covariances, strict=True):
        key = term.group.label
        std = np.sqrt(np.maximum(np.diag(covariance), 0.0))
        if key == "delay":
            delay += values["delay"]
            moved |= abs(values["delay"]) > 0.1 * std[0]
        elif key == "torque_constant" and term.group.joint is not None:
            j = term.group.joint
            step = float(np.clip(values["scale"], -0.5, 2.0))
            scale[j] = (1 + scale[j]) * (1 + step) - 1
            moved |= abs(step) > 0.1 * std[0]
        elif key == "gravity_direction":
            step = np.array([values[k] for k in ("gx", "gy", "gz")]) - GRAVITY
            gravity = gravity + step
            moved |= bool(np.any(np.abs(step) > 0.1 * std))
    if not moved:
        return None
    return Corrections(
        delay, scale, gravity, torque_beyond(system, fit) if delay != old.delay else old.beyond
    )


def corrected_by(corrections: Corrections, first: Corrections, fit: ExactFit) -> dict[int, np.ndarray]:
    """Term -> what the samples were corrected by, in the term's columns."""
    out: dict[int, np.ndarray] = {}
    for i, term in enumerate(fit.terms):
        if term.group.label == "delay":
            out[i] = np.array([corrections.delay - first.delay])
        elif term.group.label == "torque_constant" and term.group.joint is not None:
            j = term.group.joint
            scale = (1 + corrections.scale[j]) / (1 + first.scale[j]) - 1
            out[i] = np.array([scale / (1 + scale)])
        elif term.group.label == "gravity_direction":
            out[i] = corrections.gravity - first.gravity
    return out


def torque_beyond(system: System, fit: ExactFit) -> np.ndarray:
    """(M, n) torque [Nm] that the masses' errors and all laws but the delay add to the description's."""
    theta = fit.solution.theta.copy()
    at = len(theta) - sum(t.group.size for t in fit.terms)
    for term in fit.terms:
        if term.group.label == "delay":
            theta[at : at + term.group.size] = 0.0
        at += term.group.size
    columns = raw_columns(system, fit.solution.selected)
    return np.stack([c @ theta[pos] for c, pos in zip(columns, fit.solution.positions, strict=True)], axis=1)
