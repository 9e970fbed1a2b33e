"""Several recordings of one arm as one table: each keeps its own set-up, rows are counted through."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.errors import InputError, MissingColumnError
from app.phrases import Said
from app.recordings.table import Table
from app.recordings.wording import phrase

#: Header keys that say how a recording was made; one that differs is dropped, and that is said.
_MAY_DIFFER = ("noise_mm", "resolution_deg")
#: Header keys that say what was moved; they must agree.
_MUST_AGREE = ("kind", "payload_com_m", "compliance_rad_per_Nm")
_GAP_S = 1.0  # between the last row of a file and the first of the next, where their clocks both start anew


def joined(tables: Sequence[Table]) -> tuple[Table, tuple[Said, ...]]:
    """One table of all rows, in the order given.

    Each file is a session of its own: its instrument frame and its tool are fitted apart. Targets whose place is
    not known belong to their file alone. Rows are numbered through from 1.

    Returns:
        The table, named "a.csv + b.csv", and what a person should know of it.

    Raises:
        InputError: the files do not say the same of the arm, or have other columns; names the file.
    """
    first = tables[0]
    names, notes = _common_columns(tables)
    keys, said = _common_keys(tables)
    notes += said
    label = " + ".join(Path(t.path).name for t in tables)
    text_names = ("session", *(("target",) if "target" in names else ()))
    bodies: list[pl.DataFrame] = []
    ends, shift = 0.0, 0.0
    for number, table in enumerate(tables):
        body = table.body.select([table.columns[q].name for q in names if q not in text_names])
        mark = f"{number + 1}:"
        own = table.text("session") if table.has("session") else [""] * len(table)
        body = body.with_columns(pl.Series("session", [mark + s for s in own]))
        if "target" in names:
            known = table.has("target_x", "target_y", "target_z")
            targets = table.text("target")
            body = body.with_columns(pl.Series("target", targets if known else [mark + s for s in targets]))
        if "t" in names:
            t = table.number("t")
            shift = ends + _GAP_S - t[0] if number and t[0] <= ends else 0.0
            ends = float(t.max() + shift)
            column = table.columns["t"]
            body = body.with_columns(
                pl.Series(column.name, [repr(float(v)) for v in (t + shift) / column.factor])
            )
        bodies.append(body)
    counts = np.cumsum([0, *(len(t) for t in tables)])
    spans = tuple(
        phrase("joined.span", file=Path(t.path).name, first=int(a) + 1, last=int(b))
        for t, a, b in zip(tables, counts, counts[1:], strict=False)
    )
    notes.insert(0, Said(phrase("joined.rows", spans=spans)))
    whole = pl.concat(bodies)
    rows = np.arange(1, len(whole) + 1)
    path = Path(first.path).with_name(label)
    return Table(path, keys, tuple(whole.columns), lambda: (whole, rows)), tuple(notes)


def _common_columns(tables: Sequence[Table]) -> tuple[list[str], list[Said]]:
    """Quantities every file has, in the first one's words, and a note on those that some lack.

    Raises:
        InputError: one quantity in two units.
        MissingColumnError: a joint or a measured value that one file lacks.
    """
    first = tables[0]
    names, dropped = [], []
    for quantity, column in first.columns.items():
        lacking = next((t for t in tables if quantity not in t.columns), None)
        if lacking is not None:
            if quantity[0] in "qxyz" or quantity in ("target", "length"):
                raise MissingColumnError(
                    "this column is missing", file=lacking.path, row=lacking.header_row, column=column.name,
                    expected=f"the columns of {Path(first.path).name}",
                )  # fmt: skip
            dropped.append(column.name)
            continue
        other = next((t for t in tables if t.columns[quantity].name != column.name), None)
        if other is not None:
            raise InputError(
                f"{Path(first.path).name} has {column.name}",
                file=other.path, row=other.header_row, column=other.columns[quantity].name,
                expected="the same unit in every file",
            )  # fmt: skip
        if column.known:
            names.append(quantity)
    return names, [Said(phrase("joined.columns", columns=tuple(dropped)))] if dropped else []


def _common_keys(tables: Sequence[Table]) -> tuple[dict[str, Any], list[Said]]:
    first, notes = tables[0], list[Said]()
    keys = dict(first.keys)
    for key in _MUST_AGREE:
        other = next((t for t in tables if t.keys.get(key) != first.keys.get(key)), None)
        if other is not None:
            raise InputError(
                f"{Path(first.path).name} says {first.keys.get(key)}, this one {other.keys.get(key)}",
                file=other.path, column=key, expected="recordings of one kind and one load",
            )  # fmt: skip
    for key in _MAY_DIFFER:
        if any(t.keys.get(key) != first.keys.get(key) for t in tables):
            keys.pop(key, None)
            notes.append(Said(phrase("joined.key", key=key)))
    return keys, notes
