"""Starting rows: every step of one candidate at once, by sums from the end."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.static.library import Candidate

#: Rows that must stand on either side of a step.
EDGE_ROWS = 3
SCAN_ROWS = 200


@dataclass(frozen=True, eq=False)
class Scan:
    """Gains of each starting row: rows (s,), gain (s, 1 + f), visible (s,)."""

    rows: np.ndarray
    gain: np.ndarray
    visible: np.ndarray


def scan_rows(
    block, base, white, flipped, overlap, visible_least: float, rows: np.ndarray | None = None
) -> Scan:
    """Gain of `block` (m, k, d) masked to rows >= s, for many s.

    Args:
        base: what is fitted already, orthonormal q (N, p).
        white: (N,) residual; flipped (N, f) its sign-flipped copies.
        overlap: (p, 1 + f) q^T of both.
        rows: 0-based starting rows; by default evenly spread.
    """
    m, k, d = block.shape
    if rows is None:
        count = min(max(m - 2 * EDGE_ROWS + 1, 1), SCAN_ROWS)
        rows = np.unique(np.linspace(min(EDGE_ROWS, m - 1), max(m - EDGE_ROWS, 1), count).astype(int))
    q = base.q.reshape(m, k, -1)

    def tails(products: np.ndarray) -> np.ndarray:
        """Sums from every starting row to the end."""
        pieces = np.add.reduceat(products, rows, axis=0)
        return np.cumsum(pieces[::-1], axis=0)[::-1]

    transposed = np.swapaxes(block, 1, 2)  # (m, d, k)
    gram = tails(transposed @ block)  # (s, d, d)
    cross = tails(transposed @ q)  # (s, d, p)
    both = np.concatenate([white.reshape(m, k, 1), flipped.reshape(m, k, -1)], axis=2)
    right = tails(transposed @ both) - cross @ overlap  # (s, d, 1 + f)
    left = gram - cross @ np.swapaxes(cross, 1, 2)
    scale = np.sqrt(np.maximum(np.einsum("sii->si", gram), 1e-300))
    left = left / scale[:, :, None] / scale[:, None, :]
    right = right / scale[:, :, None]
    values, vectors = np.linalg.eigh(left)
    keep = values > visible_least**2
    half = np.swapaxes(vectors, 1, 2) @ right
    weight = np.where(keep, 1.0 / np.where(keep, values, 1.0), 0.0)
    gain = np.einsum("sd,sdf->sf", weight, half**2)
    visible = np.sqrt(np.maximum(values[:, -1], 0.0) / d)
    return Scan(rows, gain, visible)


def with_row(candidate: Candidate, row: int) -> Candidate:
    """The candidate with its starting row said (1-based data row)."""
    place = candidate.place
    where = {k: v for k, v in place.where.items() if k != "from_row"}
    return Candidate(candidate.effect, replace(place, where={**where, "from_row": row}))
