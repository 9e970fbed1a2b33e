"""Laws that only imitate one whose values no arm can have.

A joint that seems to be pushed along by its friction is not explained by a dozen couplings: where one law with
an impossible sign does nearly as well as all that was taken in its stead, none of them is named.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.scoring import score_all, solve
from app.diagnosis.wording import effect, reason
from app.phrases import Phrase

if TYPE_CHECKING:
    from app.diagnosis.motion.search import Search, Term

SHARE = 0.7  # of what they explain together


def imitators(
    search: Search, terms: list[Term], response: np.ndarray, done: Mapping[int, np.ndarray]
) -> dict[int, Phrase]:
    """Term -> why it may not be named; nothing where signs are free (a change since a reference).

    Args:
        response: (M, n) what the model was fitted to [Nm].
        done: term -> what the samples were corrected by, in its columns. It is put back here: nothing is left of
            such a law in the samples, and anything would explain as much as nothing.
    """
    out: dict[int, Phrase] = {}
    if search.change:
        return out
    for joint in {t.group.joint for t in terms if t.group.joint is not None}:
        here = [
            i
            for i, t in enumerate(terms)
            if t.group.joint == joint and t.group.law and not t.group.law.common
        ]
        corrected = [i for i in here if i in done]
        if corrected:
            whole = response.copy()
            whole[:, joint] += sum(search.system.raw[terms[i].group] @ done[i] for i in corrected)
            search.system.replace_response(whole)
        if here:
            out |= _on_joint(search, terms, joint, here)
        if corrected:
            search.system.replace_response(response)
    return out


def _on_joint(search: Search, terms: list[Term], joint: int, here: list[int]) -> dict[int, Phrase]:
    others = [t.group for i, t in enumerate(terms) if i not in here]
    without = solve(search.system, others, search.prior)
    together = without.rss - solve(search.system, [t.group for t in terms], search.prior).rss
    tried = [g for g in search.groups if g.joint == joint and g.law and g.law.positive and g not in others]
    board = score_all(search.system, without, tried, {}, [], null=False)
    out: dict[int, Phrase] = {}
    for index in np.flatnonzero(board.gain > SHARE * together).tolist():
        group = board[index].group
        if not search.possible(group, others):
            out |= dict.fromkeys(here, reason("imitated", effect=effect(group.label)))
    return out
