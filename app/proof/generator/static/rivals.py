"""Every law that could be taken for a given one, as columns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from app.proof.generator.effects.term import Term, same_place
from app.proof.generator.static.columns import STEPS, follows_time, places
from app.proof.generator.static.linear import Levers

ROWS = 16  # how many rows a step is tried at, evenly over the recording


def rivals(levers: Levers, term: Term) -> Iterator[tuple[Term, np.ndarray]]:
    """Laws of the library at all places but the term's own, with (m c, k) columns of their strengths.

    Geometry is no rival: in an arm that is off everywhere it is there anyway, as wide as it is.
    """
    m = levers.cell.m
    rows = np.unique(np.linspace(2, m, ROWS).astype(int))
    late = follows_time(term)
    for candidate in places(levers.made):
        if same_place(candidate, term) or candidate.effect == "payload":
            continue
        if candidate.effect in STEPS:
            if late:
                yield from _steps(levers, candidate, rows)
            continue
        yield candidate, levers.columns([candidate])
        if candidate.effect == "gear_eccentricity":
            second = replace(candidate, where={**candidate.where, "order": 2})
            if not same_place(second, term):
                yield second, levers.columns([second])


def _steps(levers: Levers, term: Term, rows: np.ndarray) -> Iterator[tuple[Term, np.ndarray]]:
    whole = levers.columns([term]).reshape(levers.cell.m, -1, len(term.parameters))
    for row in rows:
        since = (np.arange(1, levers.cell.m + 1) >= row)[:, None, None]
        columns = (whole * since).reshape(-1, len(term.parameters))
        yield replace(term, where={**term.where, "from_row": int(row)}), columns
