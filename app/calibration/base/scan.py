"""Looks for one row that does not belong, or a row from which on the reflector sat elsewhere.

Both are a shift of two numbers (along the axis, outwards) on a window of rows: one row, or all rows from k on.
The drop of the squared sum that such a shift would bring follows from the residuals and the orthonormal
columns of the fit without fitting again, for every window at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy import special

from app.geometry.circle import AxisFit


@dataclass(frozen=True, eq=False)
class Shift:
    """The most telling window.

    Args:
        kind: one row, or all rows from it on.
        index: (first) row of the window.
        size: [m] length of the shift it would need.
        p_value: chance of so large a drop by noise alone, times the number of windows tried.
    """

    kind: Literal["row", "step"]
    index: int
    size: float
    p_value: float


def largest_shift(fit: AxisFit, weights: np.ndarray, *, steps: bool, stated: bool) -> Shift | None:
    """The window whose shift explains most, or None where too few residuals are left over to say.

    Args:
        fit: of one arc (no batch).
        weights: (n,) 1/sigma^2 where `stated`, else any; 0 for rows already set aside.
        steps: also tries windows from a row on (one reflector only).
        stated: True where the noise is known: then a shift must be unlikely by that noise, too.
    """
    used = np.flatnonzero(weights > 0)
    n, p = len(used), fit.jacobian.shape[-1]
    dof = 2 * n - p
    if dof < 4 or n < 5:
        return None
    root = np.sqrt(weights[used])
    q, _ = np.linalg.qr((fit.jacobian[used] * root[:, None, None]).reshape(2 * n, p))
    q = q.reshape(n, 2, p)
    residual = fit.residuals[used] * root[:, None]
    sse = float(np.sum(residual**2))
    if sse <= 0.0:
        return None
    found = [_drops(q * root[:, None, None], residual * root[:, None], weights[used], n)]
    kinds: list[Literal["row", "step"]] = ["row"]
    if steps and n >= 6:
        tail = np.cumsum((q * root[:, None, None])[::-1], axis=0)[::-1][2 : n - 1]
        right = np.cumsum((residual * root[:, None])[::-1], axis=0)[::-1][2 : n - 1]
        mass = np.cumsum(weights[used][::-1])[::-1][2 : n - 1]
        found.append(_drops(tail, right, mass, n - 3))
        kinds.append("step")
    best = max(range(len(found)), key=lambda k: found[k][0].max())
    drops, sizes = found[best]
    place = int(np.argmax(drops))
    drop = min(float(drops[place]), sse * (1.0 - 1e-12))
    windows = sum(len(f[0]) for f in found)
    p_value = float(special.fdtrc(2, dof - 2, (drop / 2.0) / ((sse - drop) / (dof - 2))))
    if stated:
        p_value = max(p_value, float(np.exp(-0.5 * drop)))  # chi-squared with two degrees of freedom
    index = int(used[place + (2 if kinds[best] == "step" else 0)])
    return Shift(kinds[best], index, float(sizes[place]), min(1.0, windows * p_value))


def _drops(q: np.ndarray, right: np.ndarray, mass: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Drop of the squared sum and size of the shift for each window; q (k, 2, p), right (k, 2), mass (k,)."""
    a, b = q[:, 0], q[:, 1]
    g_aa = mass - np.einsum("kp,kp->k", a, a)
    g_bb = mass - np.einsum("kp,kp->k", b, b)
    g_ab = -np.einsum("kp,kp->k", a, b)
    determinant = g_aa * g_bb - g_ab**2
    good = determinant > 1e-9 * mass**2
    safe = np.where(good, determinant, 1.0)
    shift_a = (g_bb * right[:, 0] - g_ab * right[:, 1]) / safe
    shift_b = (g_aa * right[:, 1] - g_ab * right[:, 0]) / safe
    drop = np.where(good, shift_a * right[:, 0] + shift_b * right[:, 1], 0.0)
    return drop, np.where(good, np.hypot(shift_a, shift_b), 0.0)
