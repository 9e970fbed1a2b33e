"""Groups of columns that are in or out together, and all of them sorted so that like ones are weighed at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from app.diagnosis.thresholds.evidence import WIDTHS

#: Group number -> its learnt variance gamma, in units of the noise variance.
Selection = dict[int, float]


@dataclass(frozen=True, eq=False)
class Group:
    """Columns that are in or out together.

    Args:
        columns: (d,) their numbers in the design.
        penalty: nats.
        cap: largest width in multiples of the nominal size.
        widths: gammas that are tried.
        label: whatever the caller wants to know it by.
        exclusive: groups of one and the same text are never in together.
        positive: True for a single column whose weight cannot be negative.
        turn: groups of a higher number have their widths learnt first, and fall out first where another does as well.
    """

    columns: np.ndarray
    penalty: float
    cap: float = np.inf
    widths: np.ndarray = field(default_factory=lambda: WIDTHS)
    label: object = None
    exclusive: str = ""
    positive: bool = False
    turn: int = 0


@dataclass(frozen=True, eq=False)
class Layout:
    """Groups sorted into kinds of one size and one grid of widths.

    Args:
        count: number of groups.
        kind, row: (count,) kind of each group and its row among `ids` of that kind.
        ids: columns of each kind's groups, (b, d).
        widths: grid of each kind.
        cap, penalty, positive: (count,).
    """

    count: int
    kind: np.ndarray
    row: np.ndarray
    ids: list[np.ndarray]
    widths: list[np.ndarray]
    cap: np.ndarray
    penalty: np.ndarray
    positive: np.ndarray

    @classmethod
    def of(cls, groups: Sequence[Group]) -> Layout:
        kinds: dict[tuple[int, int], int] = {}
        ids: list[list[np.ndarray]] = []
        widths: list[np.ndarray] = []
        kind, row = np.empty(len(groups), int), np.empty(len(groups), int)
        for g, group in enumerate(groups):
            k = kinds.setdefault((len(group.columns), id(group.widths)), len(kinds))
            if k == len(ids):
                ids.append([])
                widths.append(group.widths)
            kind[g], row[g] = k, len(ids[k])
            ids[k].append(group.columns)
        return cls(
            len(groups), kind, row, [np.array(some) for some in ids], widths,
            np.array([g.cap for g in groups]), np.array([g.penalty for g in groups]),
            np.array([g.positive for g in groups]),
        )  # fmt: skip
