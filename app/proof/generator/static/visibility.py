"""How much of an effect survives the ordinary calibration, and which other laws look the same here."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.proof.generator.effects.term import Term, same_place
from app.proof.generator.static.cell import world_with
from app.proof.generator.static.columns import (
    STEPS,
    follows_time,
    moved_reading,
    nuisance_columns,
    places,
    reading,
    term_columns,
)
from app.proof.generator.static.making import Made

RANK = 1e-8  # relative to the largest singular value
STEADY = 1e-4  # of the steps: quantities that are open and nearly alike are left where they are
ROUNDS = 5


@dataclass(frozen=True)
class Visibility:
    """What is left of one effect after everything open was fitted.

    Args:
        survives: rms of what remains over one-sigma noise, all measured components.
        norm: its length over the noise.
        nearest: how much of it the most similar other law of the library leaves over, over the noise.
        lookalikes: laws and places that differ from it by less than `limit`, with that difference.
    """

    survives: float
    norm: float
    nearest: float
    lookalikes: tuple[Mapping[str, Any], ...]


class Projector:
    """Takes away what the open quantities can imitate."""

    def __init__(self, columns: np.ndarray):
        scale = np.linalg.norm(columns, axis=0)
        columns = columns[:, scale > 0] / scale[scale > 0]
        u, s, _ = np.linalg.svd(columns, full_matrices=False)
        self.basis = u[:, s > RANK * s[0]] if s.size else u

    def __call__(self, columns: np.ndarray) -> np.ndarray:
        return columns - self.basis @ (self.basis.T @ columns)


def visibility(made: Made, index: int, *, geometry: bool, limit: float | None) -> Visibility:
    """Of the effect `index` of a recording, the other effects' strengths being open too.

    Args:
        geometry: all geometry is open, not only base, tool and targets.
        limit: difference (length over noise) below which nobody can tell two explanations apart;
            None leaves the other laws out, which is quicker.
    """
    term = made.terms[index]
    others = [t for i, t in enumerate(made.terms) if i != index]
    opened = nuisance_columns(made, others, geometry=geometry)
    columns = [opened, *(c for other in others if (c := term_columns(made, others, other)).size)]
    project = Projector(np.hstack(columns))
    left = project(
        _unexplained(made, others, np.hstack(columns), opened.shape[1], project, geometry=geometry)
    )
    norm = float(np.linalg.norm(left))
    if limit is None:
        return Visibility(norm / np.sqrt(left.size), norm, norm, ())
    gaps = [
        {"effect": other.effect, "where": dict(other.where), "gap": gap, "free": len(other.parameters)}
        for other, gap in _gaps(made, term, others, project, left)
        if not same_place(other, term)
    ]
    nearest = min((g["gap"] for g in gaps), default=norm)
    return Visibility(norm / np.sqrt(left.size), norm, nearest, alike(gaps, term, norm, limit))


def _unexplained(
    made: Made,
    others: Sequence[Term],
    columns: np.ndarray,
    opened: int,
    project: Projector,
    *,
    geometry: bool,
) -> np.ndarray:
    """(m c) what the effect leaves once the first `opened` columns' quantities were fitted exactly.

    A large effect may be wholly a matter of base and tool and yet leave the square of its size when these are
    taken for linear: a last joint's zero of three degrees with measured orientation.
    """
    full = reading(made.cell, world_with(made.cell, made.terms), made).ravel()
    sizes, left = np.zeros(opened), full - reading(made.cell, world_with(made.cell, others), made).ravel()
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0] = 1.0
    inverse = np.linalg.pinv(columns / scale, rcond=STEADY) / scale[:, None]
    best, least = left, np.inf
    for _ in range(ROUNDS):
        length = float(np.linalg.norm(project(left)))
        if not length < 0.99 * least:
            break
        best, least = left, length
        sizes = sizes + (inverse @ left)[:opened]
        left = full - moved_reading(made, others, sizes, geometry=geometry).ravel()
    return best


def alike(
    gaps: Sequence[Mapping[str, Any]], term: Term, norm: float, limit: float
) -> tuple[Mapping[str, Any], ...]:
    """Laws that nobody can tell from the term.

    Where nothing is left of the term there is nothing to mistake for another; and a law with more strengths
    than the term has bends to anything: the simpler one is to be named.
    """
    free = len(term.parameters)
    return tuple(g for g in gaps if g["gap"] < min(limit, 0.5 * norm) and g["free"] <= free)


def _gaps(
    made: Made, term: Term, others: Sequence[Term], project: Projector, left: np.ndarray
) -> Iterator[tuple[Term, float]]:
    """Every law at every place, steps at their best row where time matters, and what each leaves of the effect."""
    late = follows_time(term)
    for candidate in places(made):
        if candidate.effect in STEPS and not late:
            continue
        columns = term_columns(made, others, candidate)
        if candidate.effect in STEPS:
            row, gap = _best_row(made.cell.m, columns, project, left)
            yield replace(candidate, where={**candidate.where, "from_row": row}), gap
        else:
            yield candidate, gap_of(project(columns), left)


def _best_row(m: int, columns: np.ndarray, project: Projector, left: np.ndarray) -> tuple[int, float]:
    """Row from which on the columns explain most, and what they leave."""
    parts = columns.reshape(m, -1, columns.shape[1])
    best, best_row = np.inf, 2
    for row in range(2, m + 1):
        masked = parts * (np.arange(1, m + 1) >= row)[:, None, None]
        gap = gap_of(project(masked.reshape(-1, columns.shape[1])), left)
        if gap < best:
            best, best_row = gap, row
    return best_row, float(best)


def gap_of(columns: np.ndarray, left: np.ndarray) -> float:
    """Length of what the columns cannot explain of `left`."""
    length = np.linalg.norm(columns, axis=0)
    columns = columns[:, length > 1e-9] / length[length > 1e-9]
    if not columns.size:
        return float(np.linalg.norm(left))
    answer = np.linalg.lstsq(columns, left, rcond=1e-9)[0]
    return float(np.linalg.norm(left - columns @ answer))
