"""What a recording's header states of its noise and of the description's masses, checked."""

from __future__ import annotations

import numpy as np

from app.errors import CellValueError
from app.recordings.table import Table

#: How far the description's masses are to be trusted; without the key `cad`: a fifth of each link's.
INERTIALS = ("exact", "cad", "unknown")
_USUAL = "cad"


def stated_inertials(table: Table) -> str:
    """`# inertials: exact | cad | unknown`; `cad` where nothing is said.

    Raises:
        CellValueError: another word.
    """
    value = table.keys.get("inertials", _USUAL)
    if value not in INERTIALS:
        raise CellValueError(
            f"found {str(value)[:40]!r}",
            file=table.path,
            column="# inertials",
            expected="one of exact, cad, unknown",
        )
    return str(value)


def stated_noise(table: Table, key: str, count: int) -> np.ndarray | None:
    """(count,) one-sigma noise in the key's own unit, `noise_mm` or `noise_Nm`; None where nothing is said.

    One number holds for all, a list has one a joint (or an axis).

    Raises:
        CellValueError: negative, not finite, or another number of values.
    """
    value = table.keys.get(key)
    if value is None:
        return None
    try:
        noise = np.broadcast_to(np.array(value, float).reshape(-1), (count,)).astype(float)
    except (TypeError, ValueError):
        noise = np.full(count, np.nan)
    if not np.all(np.isfinite(noise)) or np.any(noise < 0):
        raise CellValueError(
            f"found {str(value)[:60]!r}",
            file=table.path,
            column=f"# {key}",
            expected=f"one number of 0 or more, or {count} of them",
        )
    return noise
