"""A law's shape (a speed, a time, an order) moved from the grid of the search to where the fit is best."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.diagnosis.motion.scoring import solve
from app.diagnosis.motion.system import Group, System

WIDTH = 0.8  # of the logarithm, either way


def bent(system: System, prior: np.ndarray, others: list[Group], group: Group) -> Group:
    """The group with its shape bent, the others refitted throughout; registered with the system."""
    law = group.law
    names = () if law is None else tuple(n for n in law.shape_bounds if n in group.shape)
    if law is None or not names or group.joint is None:
        return group
    from scipy.optimize import minimize_scalar  # slow to load, and many a diagnosis bends nothing

    name = names[0]
    low, high = law.shape_bounds[name]
    start = group.shape[name]
    width = 1.0 / max(start, 1.5) if law.key == "torque_ripple" else WIDTH
    bounds = (np.log(max(low, start * np.exp(-width))), np.log(min(high, start * np.exp(width))))
    j = group.joint
    part, whitener, samples = system.parts[j], system.whiteners[j], system.samples
    solution = solve(system, others, prior)
    col, pos = solution.columns[j], solution.positions[j]
    left = part.residual(col, solution.theta[pos])
    inverse = solution.covariance[np.ix_(pos, pos)]

    def loss(log_value: float) -> float:
        shape = {**group.shape, name: float(np.exp(log_value))}
        c = whitener(samples.pool(law.columns(samples.state, group.where, shape)))
        cross = part.products(c, col)
        M = c.T @ c - cross @ inverse @ cross.T
        M[np.diag_indices_from(M)] += 1e-9 * np.trace(M) + 1e-300
        s = c.T @ left
        return -float(s @ np.linalg.solve(M, s)) if len(s) > 1 else -float(s[0] ** 2 / M[0, 0])

    best = minimize_scalar(loss, bounds=bounds, method="bounded", options={"maxiter": 20, "xatol": 1e-3})
    shape = {**group.shape, name: float(np.exp(best.x))}
    new = replace(group, shape=shape)
    return system.append(new, samples.pool(law.columns(samples.state, group.where, shape)))
