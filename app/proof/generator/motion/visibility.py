"""How much of a motion effect survives what is open in a log, and which other laws look the same in it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from app.errors import InputError
from app.proof.generator.effects.term import Term, same_place
from app.proof.generator.motion.columns import Thin, inertial_columns, places, term_columns, thinned
from app.proof.generator.motion.making import MadeMotion
from app.proof.generator.static.visibility import Visibility, alike, gap_of


class Believed:
    """Takes away what inertial errors can imitate, as far as the description may be wrong.

    The errors are Gaussian with the widths the columns carry, so a deviation costs: least squares with a ridge.
    """

    def __init__(self, believed: np.ndarray, open_columns: np.ndarray, weight: float):
        ridge = np.eye(believed.shape[1]) / weight
        self.rows = believed.shape[1]
        stacked = np.vstack([believed, ridge])
        if open_columns.shape[1]:
            free = np.vstack([open_columns, np.zeros((self.rows, open_columns.shape[1]))])
            stacked = np.hstack([stacked, free / np.maximum(np.linalg.norm(free, axis=0), 1e-12)])
        u, s, _ = np.linalg.svd(stacked, full_matrices=False)
        self.basis = u[:, s > 1e-10 * s[0]]

    def __call__(self, columns: np.ndarray) -> np.ndarray:
        """What is left, the price of the inertial errors included."""
        flat = columns.reshape(len(columns), -1)
        full = np.vstack([flat, np.zeros((self.rows, flat.shape[1]))])
        left = full - self.basis @ (self.basis.T @ full)
        return left if columns.ndim == 2 else left[:, 0]


@lru_cache(maxsize=1)
def _prepared(made: MadeMotion) -> tuple[Thin, np.ndarray]:
    """What all effects of one log share."""
    thin = thinned(made)
    return thin, inertial_columns(thin)


def motion_visibility(made: MadeMotion, index: int, *, limit: float | None) -> Visibility:
    """Of the effect `index` of a log, the other effects' strengths being open too; see `visibility`."""
    thin, inertial = _prepared(made)
    term = made.terms[index]
    others: Sequence[Term] = [*made.everywhere, *(t for i, t in enumerate(made.terms) if i != index)]
    effect = thin.effect([*others, term], term)
    blocks = [c for other in others if (c := term_columns(thin, others, other)).shape[1]]
    open_columns = np.hstack(blocks) if blocks else np.zeros((effect.size, 0))
    project = Believed(inertial, open_columns, thin.weight)
    left = project(effect)
    norm = float(np.linalg.norm(left)) * thin.weight
    per_joint = left[: effect.size].reshape(-1, made.cell.arm.n)
    survives = float(np.sqrt(np.mean(per_joint**2, axis=0)).max())
    if limit is None:
        return Visibility(survives, norm, norm, ())
    gaps = []
    for candidate in places(thin):
        if same_place(candidate, term):
            continue
        try:
            columns = project(term_columns(thin, others, candidate))
        except InputError:  # this arm cannot have it there: it is no rival
            continue
        gap = gap_of(columns, left) * thin.weight
        gaps.append(
            {
                "effect": candidate.effect,
                "where": dict(candidate.where),
                "gap": gap,
                "free": len(candidate.parameters),
            }
        )
    nearest = min((g["gap"] for g in gaps), default=norm)
    return Visibility(survives, norm, nearest, alike(gaps, term, norm, limit))
