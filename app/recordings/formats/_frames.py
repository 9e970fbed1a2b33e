"""Tables from arrays: for formats whose numbers are no text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.recordings.table import Table


def table_of(path: Path, keys: dict[str, Any], columns: dict[str, np.ndarray]) -> Table:
    """A table of numbers; what is not finite becomes an empty cell. Rows count from 1 as messages do."""
    count = len(next(iter(columns.values())))
    frame = pl.DataFrame({name: pl.Series(values, dtype=pl.Float64) for name, values in columns.items()})
    frame = frame.with_columns(pl.when(pl.all().is_finite()).then(pl.all()).otherwise(None).name.keep())
    rows = np.arange(1, count + 1)
    return Table(path, keys, tuple(columns), lambda: (frame, rows))
