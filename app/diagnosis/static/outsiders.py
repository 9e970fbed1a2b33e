"""Laws that no library holds: saturating, folded, squared, jumping. A named law must do at least as well as they.

They carry no name in a report. Each has one size and, where it has a centre or a steepness, one more unknown;
both are counted against it as parameters.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.looking import without
from app.diagnosis.static.score import basis
from app.diagnosis.static.situation import Situation

_CENTRES = np.linspace(0.1, 0.9, 9)  # quantiles of the driver at which a law may have its middle
_STEEPNESS = (1.0, 2.0, 3.0, 6.0)  # over half the driver's range
_WIDTHS = (0.05, 0.1, 0.2, 0.3, 0.45)  # of play that remembers, as a share of the joint's range
#: What an outside law may follow.
FAMILIES = ("own_angle", "gravity_torque", "approach", "play", "product")
#: BIC by which an outsider must beat one named law before its name is withheld.
MARGIN = 1.0
#: Two named laws of one driver on one joint are less likely than one without a name: they must beat it by this.
COMBINED = 9.2


def outside_laws(situation: Situation, joint: int, family: str) -> np.ndarray:
    """(m, c) one column a law, each of a size and one shape parameter.

    Args:
        joint: 0-based.
        family: one of FAMILIES.
    """
    if family == "play":
        return np.column_stack([_play(situation.q[:, joint], share) for share in _WIDTHS])
    if family == "product":
        middle = situation.q - 0.5 * (situation.q.max(axis=0) + situation.q.min(axis=0))
        return middle[:, [joint]] * np.delete(middle, joint, axis=1)
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
    centres = [*np.quantile(x, _CENTRES), 0.5 * float(x.max() + x.min())]
    if family == "gravity_torque":
        centres.append(0.0)
    for centre in centres:
        u = (x - centre) / half
        out += [np.tanh(k * u) for k in _STEEPNESS] + [np.abs(u), u**2, u * np.abs(u), u**3, np.sign(u)]
    return np.column_stack(out)


def _play(q: np.ndarray, share: float) -> np.ndarray:
    """(m,) how far a link that is dragged along within play trails the joint's middle position.

    Source: the play operator (Prandtl; Krasnosel'skii and Pokrovskii 1983).
    """
    width = share * float(np.ptp(q))
    place = np.empty_like(q)
    place[0] = now = q[0]
    for row in range(1, len(q)):
        now = min(max(now, q[row] - width), q[row] + width)
        place[row] = now
    return place - q


def outsider_advantage(fitted: Fitted, indices: list[int], joint: int, family: str) -> float:
    """How much lower the BIC gets when terms `indices` make way for the best law outside the library.

    The law may come with a constant. Positive: the outsider is better.

    Args:
        joint: 1-based.
    """
    return best_outsider(fitted, indices, [(joint, family)])[0]


def best_outsider(
    fitted: Fitted, indices: list[int], places: Iterable[tuple[int, str]]
) -> tuple[float, tuple[int, str] | None]:
    """The largest advantage (see `outsider_advantage`) at any of these joints (1-based) and families, and where."""
    jacobian, white = without(fitted, *indices)
    base = basis(jacobian)
    rest = white - base.q @ (base.q.T @ white)
    n = fitted.size
    taken = sum(len(fitted.terms[i].values) for i in indices)
    mine = n * np.log(fitted.rss / n) + taken * np.log(n)
    most, at = -np.inf, None
    for joint, family in places:
        laws = outside_laws(fitted.recording.situation, joint - 1, family)
        if not laws.shape[1]:
            continue
        moved = fitted.columns.joint[:, :, joint - 1]
        columns = (moved[:, :, None] * laws[:, None, :]).reshape(-1, laws.shape[1])
        constant = moved.reshape(-1, 1)
        padding = len(white) - len(constant)
        columns = np.concatenate([columns, np.zeros((padding, columns.shape[1]))])
        constant = base.project(np.concatenate([constant, np.zeros((padding, 1))]))[:, 0]
        left = [_rss(base.project(columns), columns, rest)]
        length = float(constant @ constant)
        if length > 0:
            unit = constant / np.sqrt(length)
            beside = base.project(columns)
            beside -= unit[:, None] * (unit @ beside)
            left.append(_rss(beside, columns, rest - unit * float(unit @ rest)))
        best = min(n * np.log(rss / n) + price * np.log(n) for rss, price in zip(left, (2, 3), strict=False))
        if mine - best > most:
            most, at = float(mine - best), (joint, family)
    return most, at


def _rss(projected: np.ndarray, columns: np.ndarray, rest: np.ndarray) -> float:
    """Sum of squares that the best single column leaves of `rest`."""
    length = np.einsum("nc,nc->c", projected, projected)
    raw = np.einsum("nc,nc->c", columns, columns)
    seen = length > 1e-4 * np.maximum(raw, 1e-300)
    gain = np.where(seen, (projected.T @ rest) ** 2 / np.where(seen, length, 1.0), 0.0)
    return max(float(rest @ rest - gain.max(initial=0.0)), 1e-300)
