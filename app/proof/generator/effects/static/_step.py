"""From which row on a step holds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from app.errors import InputError


def step_row(rng: np.random.Generator, cell: Any, asked: Mapping[str, Any], effect: str) -> int:
    """The first row after the step, counted from 1, with a fifth of the rows or more on either side."""
    if "from_row" in asked:
        if not 2 <= asked["from_row"] <= cell.m:
            raise InputError(
                f"effect {effect}: from_row={asked['from_row']}", expected=f"a row from 2 to {cell.m}"
            )
        return asked["from_row"]
    return int(rng.integers(int(0.2 * cell.m), int(0.8 * cell.m) + 1)) + 1


def after(cell: Any, from_row: int) -> np.ndarray:
    """(m,) 1.0 from that row on; in a cell where things give way slowly, rising over `cell.settling` rows."""
    since = np.arange(1, cell.m + 1) - from_row + 1.0
    return np.clip(since / (1 + cell.settling), 0.0, 1.0)
