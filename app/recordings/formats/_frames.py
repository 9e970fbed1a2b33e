"""Tables from arrays: for formats whose numbers are no text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.recordings.table import Table


def table_of(path: Path, keys: dict[str, Any], columns: dict[str, np.ndarray]) -> Table:
    """A table of numbers; what is not finite becomes an empty cell. Rows count from 1 as messages do.

    `columns` is empty afterwards: each is let go of as it is taken over, so that a large recording is not held twice.
    """
    names, count = tuple(columns), len(next(iter(columns.values())))
    series = []
    for name in names:
        values = np.asarray(columns.pop(name), float)
        if not np.isfinite(values).all():
            values = (
                pl.Series(name, values)
                .to_frame()
                .select(pl.when(pl.col(name).is_finite()).then(pl.col(name)))[name]
            )
        series.append(pl.Series(name, values, dtype=pl.Float64))
        del values
    frame, rows = pl.DataFrame(series), np.arange(1, count + 1)
    return Table(path, keys, names, lambda: (frame, rows))
