"""Whitened columns of an event where they are not nothing, and their products with a selection and what it leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.noise import SKIPPED

if TYPE_CHECKING:
    from app.diagnosis.models.dynamic.design import TorqueDesign


@dataclass(frozen=True, eq=False)
class WhitePart:
    """Columns of one joint from a whitened row on; before and after they are nothing.

    Args:
        first: that row.
        white: (rows, d).
    """

    first: int
    white: np.ndarray

    @property
    def rows(self) -> slice:
        return slice(self.first, self.first + len(self.white))


@dataclass(frozen=True, eq=False)
class Sums:
    """Products of an event's columns.

    Args:
        gram: (d, d) with themselves; cross: (d, a) with a selection's; right: (d,) with what it leaves.
        squares: of what the selection leaves in the event's rows; rows: how many these are, of all joints.
    """

    gram: np.ndarray
    cross: np.ndarray
    right: np.ndarray
    squares: float = 0.0
    rows: int = 0


def white_parts(
    columns: Mapping[int, np.ndarray], design: TorqueDesign, begin: int = 0
) -> dict[int, WhitePart]:
    """Columns (m, d) of some joints from row `begin` of the log on, in nominal widths, whitened.

    An event is nothing outside its window and what the filter remembers of it.
    """
    out, total = {}, len(design.y)
    for j, values in columns.items():
        rows = np.flatnonzero(values.any(axis=1))
        if not design.alive[j] or not len(rows):
            continue
        low, high = begin + int(rows[0]), begin + int(rows[-1]) + 1
        first, whitener = max(low, SKIPPED) - SKIPPED, design.whiteners[j]
        padded = np.zeros((min(high + whitener.memory, total) - first, values.shape[1]))
        padded[low - first : high - first] = values[rows[0] : rows[-1] + 1]
        out[j] = WhitePart(first, whitener(padded))
    return out


def sums_of(
    white: Mapping[int, WhitePart],
    parts: Sequence[tuple[np.ndarray, np.ndarray]],
    residual: Sequence[np.ndarray],
    size: int,
    counts: np.ndarray | None = None,
) -> Sums:
    """Products with a selection of `size` columns.

    Args:
        parts: of each joint the selection's whitened columns, and their places.
        residual: what the selection leaves of each.
        counts: (M, n) False for rows that do not count.
    """
    d = next(iter(white.values())).white.shape[1] if white else 1
    gram, cross, right, squares, count = np.zeros((d, d)), np.zeros((d, size)), np.zeros(d), 0.0, 0
    for j, part in white.items():
        columns, left = part.white, residual[j][part.rows]
        if counts is not None:
            own = counts[SKIPPED:][part.rows, j]
            columns, left = columns * own[:, None], left * own
            count += int(own.sum())
        else:
            count += len(left)
        squares += float(left @ left)
        gram += columns.T @ columns
        cross[:, parts[j][1]] += columns.T @ parts[j][0][part.rows]
        right += columns.T @ left
    return Sums(gram, cross, right, squares, count)


def changed(
    sums: Sums,
    white: Mapping[int, WhitePart],
    change: Mapping[int, WhitePart],
    parts: Sequence[tuple[np.ndarray, np.ndarray]],
    residual: Sequence[np.ndarray],
) -> Sums:
    """Products once the columns `white` are changed in a few rows."""
    gram, cross, right = sums.gram.copy(), sums.cross.copy(), sums.right.copy()
    for j, part in change.items():
        more = part.white
        cross[:, parts[j][1]] += more.T @ parts[j][0][part.rows]
        right += more.T @ residual[j][part.rows]
        gram += more.T @ more
        if j not in white:
            continue
        old = white[j]
        low, high = max(old.first, part.first), min(old.rows.stop, part.rows.stop)
        if low < high:
            both = (
                more[low - part.first : high - part.first].T @ old.white[low - old.first : high - old.first]
            )
            gram += both + both.T
    return Sums(gram, cross, right)
