"""Laws that no library holds: saturating, folded, squared, jumping. A named law must do at least as well as they.

They carry no name in a report. Each has one size and, where it has a centre or a steepness, one more unknown;
both are counted against it as parameters.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.looking import without
from app.diagnosis.static.score import basis
from app.diagnosis.static.situation import Situation

_CENTRES = (0.2, 0.35, 0.5, 0.65, 0.8)  # quantiles of the driver at which a law may have its middle
_STEEPNESS = (1.0, 2.0, 5.0)  # over half the driver's range
#: BIC by which an outsider must beat one named law before its name is withheld.
MARGIN = 1.0
#: Two named laws of one driver on one joint are less likely than one without a name: they must beat it by this.
COMBINED = 9.2


def outside_laws(situation: Situation, joint: int, family: str) -> np.ndarray:
    """(m, c) one column a law, each of a size and one shape parameter.

    Args:
        joint: 0-based.
        family: "own_angle", "gravity_torque" or "approach".
    """
    q, torque = situation.q[:, joint], situation.torque[:, joint]
    if family == "approach":
        sign = situation.approach[:, joint]
        sizes = [np.abs(torque), np.sqrt(np.abs(torque)), np.abs(situation.move[:, joint])]
        sizes += [np.minimum(np.abs(situation.move[:, joint]), w) for w in (0.1, 0.3, 1.0)]
        return np.column_stack(
            [sign * s for s in sizes] + [sign * np.cos(q), sign * np.sin(q), situation.move[:, joint]]
        )
    x = q if family == "own_angle" else torque
    half = 0.5 * float(np.ptp(x))
    if half <= 0:
        return np.zeros((len(x), 0))
    out = []
    centres = [float(np.quantile(x, c)) for c in _CENTRES]
    if family == "gravity_torque":
        centres.append(0.0)
    for centre in centres:
        u = (x - centre) / half
        out += [np.tanh(k * u) for k in _STEEPNESS] + [np.abs(u), u**2, u * np.abs(u), u**3, np.sign(u)]
    return np.column_stack(out)


def outsider_advantage(fitted: Fitted, indices: list[int], joint: int, family: str) -> float:
    """How much lower the BIC gets when terms `indices` make way for the best law outside the library.

    The law may come with a constant. Positive: the outsider is better.

    Args:
        joint: 1-based.
    """
    jacobian, white = without(fitted, *indices)
    laws = outside_laws(fitted.recording.situation, joint - 1, family)
    if not laws.shape[1]:
        return -np.inf
    moved = fitted.columns.joint[:, :, joint - 1]
    columns = (moved[:, :, None] * laws[:, None, :]).reshape(-1, laws.shape[1])
    constant = moved.reshape(-1, 1)
    padding = len(fitted.white) - len(constant)
    columns = np.concatenate([columns, np.zeros((padding, columns.shape[1]))])
    constant = np.concatenate([constant, np.zeros((padding, 1))])
    n = fitted.size
    taken = sum(len(fitted.terms[i].values) for i in indices)
    mine = n * np.log(fitted.rss / n) + taken * np.log(n)
    best = np.inf
    for extra, price in ((np.zeros((len(constant), 0)), 2), (constant, 3)):
        base = basis(np.concatenate([jacobian, extra], axis=1))
        rest = white - base.q @ (base.q.T @ white)
        projected = base.project(columns)
        length = np.einsum("nc,nc->c", projected, projected)
        raw = np.einsum("nc,nc->c", columns, columns)
        seen = length > 1e-4 * np.maximum(raw, 1e-300)
        gain = np.where(seen, (projected.T @ rest) ** 2 / np.where(seen, length, 1.0), 0.0)
        rss = max(float(rest @ rest - gain.max(initial=0.0)), 1e-300)
        best = min(best, n * np.log(rss / n) + price * np.log(n))
    return float(mine - best)
