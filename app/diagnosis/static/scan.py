"""Starting rows: every step of every candidate at once, by sums from the end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.static.effect import without_row
from app.diagnosis.static.library import Candidate

#: Rows that must stand on either side of a step.
EDGE_ROWS = 3
#: At most so many starting rows are looked at; between them every row belongs to the stretch it lies in.
SCAN_ROWS = 200


@dataclass(frozen=True, eq=False)
class Scan:
    """Gains of each starting row: rows (s,) 0-based, gain (s, 1 + f), visible (s,)."""

    rows: np.ndarray
    gain: np.ndarray
    visible: np.ndarray


def scan_all(blocks: Sequence[np.ndarray], q: np.ndarray, both: np.ndarray, least: float) -> list[Scan]:
    """Gain of every block (m, k, d) masked to rows >= s, for many s.

    The rows are cut into stretches of equal length; products are taken a stretch at a time and summed from the end.

    Args:
        q: (N, p) orthonormal basis of what is fitted already.
        both: (N, 1 + f) the residual and its sign-flipped copies.
        least: visible share below which a direction is not scored.
    """
    if not blocks:
        return []
    m, k, _ = blocks[0].shape
    length = -(-m // SCAN_ROWS)
    count = -(-m // length)
    joined = np.concatenate(blocks, axis=2)
    ours, free = _stretches(joined, count, length), _stretches(q.reshape(m, k, -1), count, length)
    turned = np.swapaxes(ours, 1, 2)
    gram, cross = _tails(turned @ ours), _tails(turned @ free)
    right = _tails(turned @ _stretches(both.reshape(m, k, -1), count, length))
    right = right - cross @ (q.T @ both)
    left = gram - cross @ np.swapaxes(cross, 1, 2)
    rows = np.arange(count) * length
    inside = (rows >= min(EDGE_ROWS, m - 1)) & (rows <= max(m - EDGE_ROWS, 1))
    out, at = [], 0
    for block in blocks:
        span = slice(at, at + block.shape[2])
        at = span.stop
        gain, visible = _gains(gram[inside, span, span], left[inside, span, span], right[inside, span], least)
        out.append(Scan(rows[inside], gain, visible))
    return out


def _gains(
    gram: np.ndarray, left: np.ndarray, right: np.ndarray, least: float
) -> tuple[np.ndarray, np.ndarray]:
    """Gain (s, 1 + f) and visible share (s,) of one candidate at every starting row."""
    scale = np.sqrt(np.maximum(np.einsum("sii->si", gram), 1e-300))
    if gram.shape[1] == 1:
        share = np.maximum(left[:, 0, 0] / scale[:, 0] ** 2, 0.0)
        weight = np.where(share > least**2, 1.0 / np.where(share > 0, share, 1.0), 0.0)
        return weight[:, None] * (right[:, 0] / scale) ** 2, np.sqrt(share)
    left = left / scale[:, :, None] / scale[:, None, :]
    values, vectors = np.linalg.eigh(left)
    half = np.swapaxes(vectors, 1, 2) @ (right / scale[:, :, None])
    keep = values > least**2
    weight = np.where(keep, 1.0 / np.where(keep, values, 1.0), 0.0)
    gain = np.einsum("sd,sdf->sf", weight, half**2)
    return gain, np.sqrt(np.maximum(values[:, -1], 0.0) / left.shape[1])


def _stretches(values: np.ndarray, count: int, length: int) -> np.ndarray:
    """(m, k, c) -> (count, length * k, c), filled up with zeros."""
    m, k, c = values.shape
    if m < count * length:
        values = np.concatenate([values, np.zeros((count * length - m, k, c))])
    return values.reshape(count, length * k, c)


def _tails(products: np.ndarray) -> np.ndarray:
    """Sums from every stretch to the end."""
    return np.cumsum(products[::-1], axis=0)[::-1]


def with_row(candidate: Candidate, row: int) -> Candidate:
    """The candidate with its starting row said (1-based data row)."""
    place = candidate.place
    where = without_row(place.where)
    return Candidate(candidate.effect, replace(place, where={**where, "from_row": row}))
