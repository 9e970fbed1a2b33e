"""A table as read from a file: header keys, and columns that are checked when they are asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.errors import CellValueError, FileFormatError, MissingColumnError, UnitError
from app.phrases import Said
from app.recordings.columns import Column, parse_column


class Once:
    """Rows that are read once, shared by all tables that are made of one, and may be let go.

    Args:
        make: reads them.
    """

    def __init__(self, make: Callable[[], tuple[pl.DataFrame, np.ndarray]]):
        self._make = make
        self._held: tuple[pl.DataFrame, np.ndarray] | None = None

    def __call__(self) -> tuple[pl.DataFrame, np.ndarray]:
        if self._held is None:
            self._held = self._make()
        return self._held

    def forget(self) -> None:
        """Lets them go; they are read anew when they are asked for again."""
        self._held = None


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of one file. Numbers come out in SI units; the body is only read when a column is asked for.

    Args:
        path: where it came from, for messages.
        keys: header keys (`# key: value`): scalars and flat lists.
        names: column names as written.
        load: gives the body, text or numbers, and the line number of every row.
        written: gives one column as text, where `load` gives numbers and the file holds text.
        notes: what a person should know of how the file was read.
    """

    path: Path
    keys: dict[str, Any]
    names: tuple[str, ...]
    load: Callable[[], tuple[pl.DataFrame, np.ndarray]] = field(repr=False)
    written: Callable[[str], pl.Series] | None = field(default=None, repr=False)
    notes: tuple[Said, ...] = ()

    @cached_property
    def columns(self) -> dict[str, Column]:
        """Columns by quantity (`q1`, `x`, `role`).

        Raises:
            UnitError: a known quantity came without its unit, or with a wrong one.
            FileFormatError: the same quantity stands there twice.
        """
        found: dict[str, Column] = {}
        for name in self.names:
            column = parse_column(name)
            if column.missing_unit:
                raise UnitError(
                    "no unit in the column's name",
                    file=self.path,
                    row=self.header_row,
                    column=name,
                    expected=" or ".join(f"{column.quantity}_{u}" for u in column.missing_unit),
                )
            if column.quantity in found:
                raise FileFormatError(
                    "this quantity stands there twice",
                    file=self.path,
                    row=self.header_row,
                    column=name,
                    expected="one column a quantity",
                )
            found[column.quantity] = column
        return found

    @property
    def header_row(self) -> int:
        return int(self.keys.get("__header_row__", 1))

    @property
    def kind(self) -> str | None:
        """The header's `kind`, or None."""
        kind = self.keys.get("kind")
        return None if kind is None else str(kind)

    @cached_property
    def _own(self) -> tuple[pl.DataFrame, np.ndarray]:
        return self.load()

    @property
    def _body(self) -> tuple[pl.DataFrame, np.ndarray]:
        return self.load() if isinstance(self.load, Once) else self._own

    def forget(self) -> None:
        """Lets go of the rows, where they take much and their reader has what it needs."""
        if isinstance(self.load, Once):
            self.load.forget()

    def some(self, first: np.ndarray, count: int) -> Table:
        """The same with some of its rows: `count` from each of some rows on, which rise and do not overlap."""
        body, rows = self._body
        starts = first.tolist()
        some = pl.concat([body.slice(start, count) for start in starts], rechunk=True)
        part = (some, np.concatenate([rows[start : start + count] for start in starts]))
        written = self.written

        def text(name: str) -> pl.Series:
            assert written is not None
            return pl.concat([written(name).slice(start, count) for start in starts])

        return replace(self, load=lambda: part, written=None if written is None else text)

    @cached_property
    def kept(self) -> dict[Any, Any]:
        """What readers have worked out of it once, by a key of their own."""
        return {}

    def __len__(self) -> int:
        return len(self._body[0])

    @property
    def body(self) -> pl.DataFrame:
        """Every cell as text, one column a name."""
        return self._body[0]

    @property
    def rows(self) -> np.ndarray:
        """(n,) line number in the file of every data row."""
        return self._body[1]

    def has(self, *quantities: str) -> bool:
        """True where all of these quantities have a column."""
        return all(q in self.columns for q in quantities)

    def numbered(self, prefix: str) -> list[str]:
        """Quantities prefix1, prefix2, … as far as they go without a gap."""
        out: list[str] = []
        while f"{prefix}{len(out) + 1}" in self.columns:
            out.append(f"{prefix}{len(out) + 1}")
        return out

    def require(self, quantities: Iterable[str]) -> None:
        """Raises MissingColumnError for the first of `quantities` that has no column."""
        from app.recordings.columns import units_of

        for quantity in quantities:
            if quantity not in self.columns:
                units = units_of(quantity)
                named = " or ".join(f"{quantity}_{u}" for u in units) if units else quantity
                raise MissingColumnError(
                    "this column is missing",
                    file=self.path,
                    row=self.header_row,
                    column=named,
                    expected=f"it beside {', '.join(self.names[:12])}",
                )

    def number(self, quantity: str, *, missing: bool = False) -> np.ndarray:
        """One column in SI units.

        Args:
            quantity: name without unit.
            missing: True lets empty cells through as NaN; False refuses them.

        Returns:
            (n,).

        Raises:
            MissingColumnError: there is no such column.
            CellValueError: a cell is no finite number.
        """
        self.require([quantity])
        column = self.columns[quantity]
        values = self._values(column)
        bad = ~np.isfinite(values)
        if bad.any():
            text = self._text(column.name)
            empty = text.is_null().to_numpy()
            wrong = np.flatnonzero(bad & ~empty if missing else bad)
            if len(wrong):
                index = int(wrong[0])
                found = text[index]
                raise CellValueError(
                    "the cell is empty" if found is None else f"found {found[:40]!r}",
                    file=self.path,
                    row=int(self.rows[index]),
                    column=column.name,
                    expected="a moment such as 2026-01-31T12:00:00.5" if column.moment else "a finite number",
                )
        return values if column.factor == 1.0 else values * column.factor

    def tolerant(self, quantity: str) -> np.ndarray:
        """One column in SI units with NaN wherever a cell is no finite number; for logs with broken rows.

        Returns:
            (n,).
        """
        self.require([quantity])
        column = self.columns[quantity]
        values = self._values(column)
        return np.where(np.isfinite(values), values, np.nan) * column.factor

    def numbers(self, quantities: Iterable[str], *, missing: bool = False) -> np.ndarray:
        """Several columns side by side, (n, k), in SI units."""
        quantities = list(quantities)
        self.require(quantities)
        return np.stack([self.number(q, missing=missing) for q in quantities], axis=1)

    def text(self, quantity: str) -> list[str]:
        """One column as text, stripped; empty cells are ''."""
        self.require([quantity])
        return [(value or "").strip() for value in self._text(self.columns[quantity].name).to_list()]

    def raw(self, quantity: str) -> list[str | None]:
        """One column exactly as written, for finding its resolution."""
        self.require([quantity])
        return self._text(self.columns[quantity].name).to_list()

    def resolution(self, quantity: str) -> float:
        """The step of the last digit written, in SI units; 0 where the numbers are written in full (> 9 places).

        Example: angles written as 44.8, 19 and -126.6 have a resolution of 0.1 degree.
        """
        key = ("resolution", quantity)
        if key not in self.kept:
            self.kept[key] = self._resolution(quantity)
        return self.kept[key]

    def _resolution(self, quantity: str) -> float:
        self.require([quantity])
        text = self._text(self.columns[quantity].name)
        for first in text.head(_FIRST).to_list():
            if (
                len((first or "").strip().partition(".")[2]) > _MOST_DIGITS
                and "e" not in (first or "").lower()
            ):
                return 0.0  # one number that is written in full is enough
        parts = text.str.to_lowercase().str.extract_groups(_DIGITS)
        decimals = parts.struct.field("1").fill_null("").str.len_chars().cast(pl.Int64)
        exponent = parts.struct.field("2").cast(pl.Int64, strict=False).fill_null(0)
        most = (decimals - exponent).max()
        places = max(int(most), 0) if isinstance(most, int) else 0
        return 0.0 if places > _MOST_DIGITS else 10.0**-places * self.columns[quantity].factor

    def _values(self, column: Column) -> np.ndarray:
        """(n,) in the column's unit, NaN where a cell is empty or none."""
        series = self._body[0][column.name]
        return _seconds(series) if column.moment and series.dtype == pl.String else _floats(series)

    def _text(self, name: str) -> pl.Series:
        """One column as text; of a file whose numbers are no text, as they are written out."""
        series = self._body[0][name]
        if series.dtype == pl.String:
            return series
        return self.written(name) if self.written is not None else series.cast(pl.String)


#: Digits behind the point, and the exponent, of a number as it is written.
#: Places from which on a number counts as written in full; cells that are looked at before all are.
_MOST_DIGITS, _FIRST = 9, 20
_DIGITS = r"^[^.e]*(?:\.([0-9]*))?(?:e([+-]?[0-9]+))?\s*$"


def _floats(series: pl.Series) -> np.ndarray:
    """(n,) NaN where a cell is empty or no number; an array of its own."""
    return np.array(series.cast(pl.Float64, strict=False).to_numpy(), float)


def _seconds(series: pl.Series) -> np.ndarray:
    """(n,) seconds since 1970 of moments by ISO 8601; without a zone they are taken as UTC."""
    text = (
        series.str.strip_chars().str.replace(r"^([0-9-]{10}) ", "${1}T").str.replace(",", ".", literal=True)
    )
    zoned = text.str.replace(r"(T[0-9:.]+)$", "${1}Z").str.replace(r"(T[0-9:.]+[+-][0-9]{2})$", "${1}:00")
    moments = zoned.str.to_datetime("%+", time_unit="ns", time_zone="UTC", strict=False)
    return np.array((moments.dt.epoch("ns") / 1).to_numpy(), float) * 1e-9
