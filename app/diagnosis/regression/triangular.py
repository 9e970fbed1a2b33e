"""Triangular systems by LAPACK's own call, without the checks that cost more than a small system."""

from __future__ import annotations

import numpy as np
from scipy.linalg import get_lapack_funcs

_TRTRS, _POTRI = get_lapack_funcs(("trtrs", "potri"), dtype=np.float64)


def lower_solved(lower: np.ndarray, right: np.ndarray, *, transposed: bool = False) -> np.ndarray:
    """L^-1 right, or L'^-1 right; L (a, a) lower triangular, right (a,) or (a, k)."""
    if (
        not right.size
    ):  # LAPACK writes a line on standard output about empty arrays, amid whatever is printed there
        return right.copy()
    # Seen by columns, as LAPACK does, the rows of L are those of an upper triangle.
    return _TRTRS(lower.T, right, lower=0, trans=0 if transposed else 1)[0]


def inverse_of(lower: np.ndarray) -> np.ndarray:
    """(L L')^-1; L (a, a) lower triangular."""
    if not len(lower):
        return np.zeros((0, 0))
    half = np.triu(_POTRI(lower.T, lower=0)[0])  # by columns L' is an upper triangle
    return half + np.triu(half, 1).T
