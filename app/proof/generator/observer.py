"""What an observer who knew the structure of an arm could learn from a recording: the measure of the search.

All is linear about the truth, in readings divided by their noise: y = P theta + N eta + e with the deviations theta,
what every recording leaves open eta, and noise e. Two observers are asked. The *oracle* knows which parameters
there are and nothing of their sizes: ordinary least squares. The *informed* one knows the widths they were drawn from
too, and weighs them by these: the least error anybody can have on average.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

RANK = 1e-5  # of the largest singular value of columns of equal length: below, a parameter cannot be seen
DRAWS = 64


@dataclass(frozen=True, eq=False)
class Linear:
    """One recording, linear about the truth.

    Args:
        columns: (r, p) readings per unit of each deviation.
        opened: (r, q) readings per unit of what is left open.
        error: (r,) noise.
        counted: (r,) True for the readings that an error in millimetres or newton-metres is told of.
    """

    columns: np.ndarray
    opened: np.ndarray
    error: np.ndarray
    counted: np.ndarray

    @cached_property
    def basis(self) -> np.ndarray:
        """(r, q') an orthonormal basis of what is left open."""
        return basis_of(self.opened)

    def freed(self, values: np.ndarray) -> np.ndarray:
        """What is left of (r,) or (r, k) once the open quantities are fitted."""
        basis = self.basis
        return values - basis @ (basis.T @ values)


def basis_of(columns: np.ndarray) -> np.ndarray:
    """Orthonormal basis of the span."""
    length = np.linalg.norm(columns, axis=0)
    columns = columns[:, length > 0] / length[length > 0]
    if not columns.shape[1]:
        return columns
    u, s, _ = np.linalg.svd(columns, full_matrices=False)
    return u[:, s > 1e-9 * s[0]]


def oracle_error(first: Linear) -> np.ndarray:
    """(p,) how far ordinary least squares on one recording is from the truth; what it cannot see stays put."""
    length = np.linalg.norm(first.columns, axis=0)
    length[length == 0] = 1.0
    columns = first.freed(first.columns)
    return np.linalg.lstsq(columns / length, first.freed(first.error), rcond=RANK)[0] / length


def informed_error(first: Linear, values: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """(p,) how far the best estimate is from the truth.

    Args:
        values: (p,) the truth; widths: (p,) one sigma of each, infinite where nothing is known.
    """
    columns = first.freed(first.columns)
    weight = np.where(np.isfinite(widths), 1.0 / widths**2, 0.0)
    scale = np.where(np.isfinite(widths), widths, 1.0 / np.maximum(np.linalg.norm(columns, axis=0), 1e-300))
    gram = (columns * scale).T @ (columns * scale) + np.diag(weight * scale**2)
    right = (columns * scale).T @ first.freed(first.error) - scale * weight * values
    return scale * np.linalg.solve(gram, right)


def carried_rms(second: Linear, off: np.ndarray) -> float:
    """Rms on another recording (its own open quantities fitted) of a model that is off by `off`, over the noise."""
    left = second.freed(second.error - second.columns @ off)
    return float(np.sqrt(np.mean(left[second.counted] ** 2)))


def share_uncertainty(
    first: Linear, values: np.ndarray, widths: np.ndarray, members: Mapping[str, Sequence[int]]
) -> dict[str, float]:
    """One sigma of each family's share as the informed observer knows it.

    Args:
        members: family -> places of its deviations.
    """
    columns = first.freed(first.columns)
    gram = columns.T @ columns
    scale = np.where(np.isfinite(widths), widths, np.maximum(np.abs(values), 1e-300))
    prior = np.where(np.isfinite(widths), 1.0, 0.0)
    inner = scale[:, None] * gram * scale + np.diag(prior + 1e-12)
    upper = np.linalg.cholesky(inner).T
    drawn = np.random.default_rng(0).normal(size=(len(values), DRAWS))
    theta = values[:, None] + scale[:, None] * np.linalg.solve(upper, drawn)
    whole = np.maximum(np.einsum("pd,pr,rd->d", theta, gram, theta, optimize=True), 1e-300)
    out = {}
    for family, places in members.items():
        part = theta[list(places)]
        inner = gram[np.ix_(list(places), list(places))]
        out[family] = float(np.std(np.einsum("pd,pr,rd->d", part, inner, part, optimize=True) / whole))
    return out


class Rest:
    """Takes away what is open and, as far as their widths allow, all deviations but the one looked at."""

    def __init__(self, first: Linear, others: np.ndarray, widths: np.ndarray):
        self.first = first
        self.others = first.freed(others) * widths
        self.inverse = np.linalg.inv(self.others.T @ self.others + np.eye(self.others.shape[1]))

    def products(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """(k, l) inner products of freed columns (r, k) and (r, l) in which the rest no longer counts."""
        return a.T @ b - (self.others.T @ a).T @ self.inverse @ (self.others.T @ b)


def gaps(rest: Rest, effect: np.ndarray, blocks: Sequence[np.ndarray]) -> tuple[float, list[float]]:
    """Length of an effect (r,), and what of it each block of columns (r, k) leaves, over the noise."""
    effect = rest.first.freed(effect)[:, None]
    whole = float(rest.products(effect, effect)[0, 0])
    out = []
    for block in blocks:
        columns = rest.first.freed(block)
        length = np.linalg.norm(columns, axis=0)
        columns = columns[:, length > 1e-9] / length[length > 1e-9]
        if not columns.shape[1]:
            out.append(np.sqrt(max(whole, 0.0)))
            continue
        square, across = rest.products(columns, columns), rest.products(columns, effect)[:, 0]
        taken = float(across @ np.linalg.lstsq(square, across, rcond=1e-9)[0])
        out.append(float(np.sqrt(max(whole - taken, 0.0))))
    return float(np.sqrt(max(whole, 0.0))), out
