"""Factors of every joint, or masses that are not those described? Both scale torques; the evidence tells.

Friction, rotor and offset of each joint are projected off; what is left is the description's error in masses, within a
trust whose width is learnt. Source: as in app/diagnosis/regression/evidence.py.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.effects.dynamic._law import Law
from app.diagnosis.models.dynamic.hypothesis import Read
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.thresholds.readings import COST, TOGETHER
from app.kinematics.dynamics import PER_LINK


def masses_do_worse(given: Read, factored: Read) -> bool:
    """True where a log read with factors of its joints is plainly likelier than one of other masses."""
    noise = _noise(given)
    factors = factored.samples.state.hypothesis.factors / given.samples.state.hypothesis.factors
    before, after = _evidence(given, noise), _evidence(factored, noise / factors)
    rows = len(given.samples.y) / TOGETHER
    return after - 0.5 * len(factors) * float(np.log(rows)) > before + COST


def _link() -> Law:
    """The law of the masses that the description states."""
    return next(law for law in laws().values() if law.stated)


def _columns(read: Read, j: int) -> np.ndarray:
    """(M, p) masses of all links beyond joint j, in their nominal widths, friction projected off."""
    state = read.samples.state
    link = _link()
    widths = np.concatenate([link.widths(state, place) for place in link.places(state)])
    return read.off(j, state.regressor[:, j, PER_LINK * j :] * widths[PER_LINK * j :])


def _noise(read: Read) -> np.ndarray:
    """(n,) what any masses leave of each joint [Nm]."""
    samples, out = read.samples, np.ones(read.samples.state.joints)
    for j in np.flatnonzero(samples.alive).tolist():
        columns = _columns(read, j)
        left = read.off(j, samples.y[:, j] - samples.description[:, j])
        left = left - columns @ np.linalg.lstsq(columns, left, rcond=1e-9)[0]
        out[j] = np.sqrt(np.mean(left**2)) + 1e-6 * float(np.std(samples.y[:, j])) + 1e-12
    return out


def _evidence(read: Read, noise: np.ndarray) -> float:
    """Log evidence [nats] of the description's masses within the likeliest trust."""
    samples = read.samples
    size = PER_LINK * samples.state.joints
    gram, right, total = np.zeros((size, size)), np.zeros(size), 0.0
    for j in np.flatnonzero(samples.alive).tolist():
        columns = _columns(read, j) / noise[j]
        left = read.off(j, samples.y[:, j] - samples.description[:, j]) / noise[j]
        own = slice(PER_LINK * j, None)
        gram[own, own] += columns.T @ columns / TOGETHER
        right[own] += columns.T @ left / TOGETHER
        total += float(left @ left) / TOGETHER
    values, vectors = np.linalg.eigh(gram)
    values, along = np.maximum(values, 0.0), vectors.T @ right
    scores = [
        0.5 * float(np.sum(along**2 * trust / (1.0 + trust * values)))
        - 0.5 * float(np.sum(np.log1p(trust * values)))
        for trust in _link().spread
    ]
    return max(scores) - 0.5 * total
