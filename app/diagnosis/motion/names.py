"""Before a name is given: does the residual follow that law, or only something like it?

A law is withheld where a free curve of the same joint explains much beyond it, or where its values are
none a real arm can have. What remains is tested against every curve.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.motion.exact import ExactFit
from app.diagnosis.motion.scoring import Board, null_scores, score_all
from app.diagnosis.motion.search import LEVEL, Search
from app.diagnosis.motion.system import Group

SHADOW = 0.05  # share of a law's own gain that a free curve may add before the name is withheld


@dataclass(frozen=True, eq=False)
class Judgement:
    """What may be named.

    Args:
        named: per term of the fit, True where its name stands.
        gains: per term, whitened fall of the sum of squares it is worth.
        leftover_p: family-wise p of the strongest curve.
        leftover_where: joint and driver of it.
        reasons: why names were withheld.
    """

    named: list[bool]
    gains: np.ndarray
    leftover_p: float
    leftover_where: dict
    reasons: tuple[str, ...]


def judge(search: Search, fit: ExactFit) -> Judgement:
    """Tests every name, and what is left over."""
    selected = [t.group for t in fit.terms]
    gains = search.losses_without(selected) if selected else np.zeros(0)
    curves = [g for g in search.system.groups if g.law is None]
    board = score_all(search.system, fit.solution, curves, {}, [])
    null = null_scores(board, search.signs)
    bar = max(float(np.quantile(null, 1 - LEVEL)), np.log10(len(board.candidates) / LEVEL))
    best = int(np.argmax(board.score))
    p_value = (1 + np.sum(null >= board.score[best])) / (1 + len(null))
    if board.score[best] < np.log10(len(board.candidates) / LEVEL):
        p_value = max(p_value, 0.05)
    where = dict(board.candidates[best].group.where)
    named, reasons = [], []
    for term, values, gain in zip(fit.terms, fit.values, gains, strict=True):
        law = term.group.law
        assert law is not None
        extra, driver = _beyond(board, term.group, bar)
        if not search.change and not law.lawful(values):
            named.append(False)
            reasons.append(f"{law.key} at {_place(term.group)} has values no real arm has")
        elif extra > SHADOW * gain:
            named.append(False)
            reasons.append(
                f"{law.key} at {_place(term.group)} is withheld: a free curve of {driver} explains more than it"
            )
        else:
            named.append(True)
    return Judgement(named, gains, float(p_value), where, tuple(reasons))


def _place(group: Group) -> str:
    return f"joint {group.where['joint']}" if "joint" in group.where else "the arm"


def _beyond(board: Board, group: Group, bar: float) -> tuple[float, str]:
    """The largest significant gain of a free curve where this law acts."""
    best, driver = 0.0, ""
    for candidate, gain, score in zip(board.candidates, board.gain, board.score, strict=True):
        if score <= bar or (group.joint is not None and candidate.group.joint != group.joint):
            continue
        spare = gain - candidate.size
        if spare > best:
            best, driver = float(spare), candidate.group.name.replace("_", " ")
    return best, driver
