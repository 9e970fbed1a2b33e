"""Non-linear least squares with analytic Jacobians: Gauss-Newton, damped when a step fails."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from app.estimation.fit import Fit
from app.estimation.linear import covariance_from_jacobian

_ROUNDING = 1e-6  # of the cost: a promised drop below this is rounding

Residual = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


def gauss_newton(
    function: Residual,
    start: np.ndarray,
    *,
    names: Sequence[str],
    units: Sequence[str],
    sigma: float | None = None,
    lower: np.ndarray | None = None,
    upper: np.ndarray | None = None,
    update: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None,
    max_iterations: int = 30,
    tolerance: float = 1e-10,
) -> Fit:
    """Minimises |r(x)|^2.

    A full Gauss-Newton step is tried first; where it does not lower the cost, Levenberg's damping grows
    until it does. A parameter that sits on a bound and is pushed against it stands still while the others go on.

    Args:
        function: x -> (measured minus predicted (m,), d predicted / d step (m, p)).
        start: (k,) first guess; k is p unless `update` is given.
        sigma: stated one-sigma noise of one residual; None estimates it.
        lower, upper: (p,) bounds on the parameters, infinite where there is none; not together with `update`.
        update: (x, step) -> x, where parameters do not simply add (poses). Default x + step.
        tolerance: stops when a step drops the cost by less than this share of it.

    Returns:
        Fit; `converged` is False with a `message` where the iteration ran out or no step lowers the cost
        although the Jacobian promises one.
    """
    x = np.array(start, float)
    low = np.full(len(x), -np.inf) if lower is None else np.asarray(lower, float)
    high = np.full(len(x), np.inf) if upper is None else np.asarray(upper, float)
    bounded = lower is not None or upper is not None
    if bounded:
        x = np.clip(x, low, high)
    add = update or (lambda value, step: value + step)
    residual, jacobian = function(x)
    cost = first_cost = float(residual @ residual)
    damping, converged, message, iteration = 0.0, False, "iterations ran out", 0
    for iteration in range(1, max_iterations + 1):  # noqa: B007  (read after the loop)
        scale = np.linalg.norm(jacobian, axis=0)
        scale = np.where(scale > 0, scale, 1.0)
        scaled = jacobian / scale
        gradient = scaled.T @ residual
        if bounded:
            held = ((x <= low) & (gradient < 0)) | ((x >= high) & (gradient > 0))
            scaled = np.where(held, 0.0, scaled)
            gradient = np.where(held, 0.0, gradient)
        hessian = scaled.T @ scaled
        accepted = False
        trial, trial_residual, trial_jacobian, trial_cost = x, residual, jacobian, cost
        for _ in range(12):
            step = np.linalg.lstsq(hessian + damping * np.eye(len(scale)), gradient, rcond=1e-13)[0] / scale
            trial = add(x, step)
            if bounded:
                trial = np.clip(trial, low, high)
            trial_residual, trial_jacobian = function(trial)
            trial_cost = float(trial_residual @ trial_residual)
            if np.isfinite(trial_cost) and trial_cost <= cost * (1.0 + 1e-14):
                accepted = True
                break
            damping = max(damping * 10.0, 1e-6)
        if not accepted:
            promised = float(gradient @ np.linalg.lstsq(hessian, gradient, rcond=1e-13)[0])
            converged = promised <= _ROUNDING * cost + _ROUNDING**3 * first_cost
            message = "converged" if converged else "no step lowers the cost"
            break
        drop = cost - trial_cost
        x, residual, jacobian, cost = trial, trial_residual, trial_jacobian, trial_cost
        damping = damping / 10.0 if damping > 1e-9 else 0.0
        if drop <= tolerance * cost + 1e-300:
            converged, message = True, "converged"
            break
    _, rank, _ = covariance_from_jacobian(jacobian, 1.0)
    dof = len(residual) - rank
    source = "stated"
    if sigma is None:
        source, sigma = "residual", float(np.sqrt(cost / dof)) if dof > 0 else float("nan")
    covariance, rank, condition = covariance_from_jacobian(jacobian, sigma)
    bound = []
    if bounded:
        bound = [name for name, at in zip(names, (x <= low) | (x >= high), strict=True) if at]
    return Fit(
        tuple(names),
        tuple(units),
        x,
        covariance,
        residual,
        dof,
        sigma,
        source,
        rank,
        condition,
        converged,
        message,
        iteration,
        tuple(bound),
    )
