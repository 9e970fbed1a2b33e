"""How far the description's masses are believed.

Each link may be heavier or lighter as a whole, its centre of mass may be elsewhere and its inertia may
differ; all Gaussian, by default as below or by the header's `# inertial_prior: 0.1` (relative mass error).
The width is raised to what the log itself asks for (marginal likelihood), never lowered.
"""

from __future__ import annotations

import numpy as np

from app.kinematics import RobotModel
from app.kinematics.dynamics import PER_LINK, inertial_parameters

MASS = 0.03  # relative
CENTRE = 0.03  # of the link's size
INERTIA = 0.10  # relative
_UNKNOWN = (5.0, 1.0, 1.0)  # kg, kg m, kg m^2 where the description states no masses
SCALES = (1.0, 2.0, 4.0, 8.0, 16.0, 32.0)


def prior_factor(robot: RobotModel, mass: float = MASS) -> np.ndarray:
    """(10 n, 10 n) F with covariance F F^T of the inertial parameters' error."""
    nominal = inertial_parameters(robot)
    n = robot.joint_count
    out = np.zeros((PER_LINK * n, PER_LINK * n))
    heaviest = max(float(np.max(nominal[::PER_LINK])), 1e-9)
    for k in range(n):
        part = slice(PER_LINK * k, PER_LINK * (k + 1))
        p = nominal[part]
        if not robot.has_inertials:
            out[part, part] = np.diag([_UNKNOWN[0], *[_UNKNOWN[1]] * 3, *[_UNKNOWN[2]] * 6])
            continue
        # A link drawn without mass still has some: a share of what the others weigh.
        m = max(float(p[0]), 0.01 * heaviest)
        trace = max(float(p[4] + p[6] + p[9]), 2 * m * 0.02**2)
        size = max(float(np.sqrt(trace / (2 * m))), 0.05)
        covariance = mass**2 * np.outer(p, p)
        spread = np.array(
            [mass * m, *[(mass / MASS) * CENTRE * m * size] * 3, *[(mass / MASS) * INERTIA * trace / 3] * 6]
        )
        covariance += np.diag((spread * np.array([0.3, *[1.0] * 9])) ** 2)
        out[part, part] = np.linalg.cholesky(covariance)
    return out


def choose_scale(gram: np.ndarray, rhs: np.ndarray, factor: np.ndarray) -> float:
    """The prior's width the log asks for, by marginal likelihood over SCALES.

    Args:
        gram: (p, p) information on the inertial parameters once everything else is projected off.
        rhs: (p,) likewise.
        factor: from `prior_factor`.
    """
    G, g = factor.T @ gram @ factor, factor.T @ rhs
    values, vectors = np.linalg.eigh(G)
    values, h = np.maximum(values, 0.0), vectors.T @ g
    best, best_scale = -np.inf, SCALES[0]
    for scale in SCALES:
        s = scale**2
        evidence = 0.5 * np.sum(s * h**2 / (1 + s * values)) - 0.5 * np.sum(np.log1p(s * values))
        if evidence > best + 3.0:  # wider only for a reason
            best, best_scale = evidence, scale
    return best_scale
