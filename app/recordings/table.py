"""A table as read from a file: header keys, and columns that are checked when they are asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.errors import CellValueError, FileFormatError, MissingColumnError, UnitError
from app.recordings.columns import Column, parse_column


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of one file. Numbers come out in SI units; the body is only read when a column is asked for.

    Args:
        path: where it came from, for messages.
        keys: header keys (`# key: value`), parsed as YAML.
        names: column names as written.
        load: gives the body as text columns and the line number of every row.
    """

    path: Path
    keys: dict[str, Any]
    names: tuple[str, ...]
    load: Callable[[], tuple[pl.DataFrame, np.ndarray]] = field(repr=False)

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
    def _body(self) -> tuple[pl.DataFrame, np.ndarray]:
        return self.load()

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
        text = self._body[0][column.name]
        values = text.cast(pl.Float64, strict=False).to_numpy().astype(float)
        bad = ~np.isfinite(values)
        if bad.any():
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
                    expected="a finite number",
                )
        return values * column.factor

    def tolerant(self, quantity: str) -> np.ndarray:
        """One column in SI units with NaN wherever a cell is no finite number; for logs with broken rows.

        Returns:
            (n,).
        """
        self.require([quantity])
        column = self.columns[quantity]
        values = self._body[0][column.name].cast(pl.Float64, strict=False).to_numpy().astype(float)
        return np.where(np.isfinite(values), values, np.nan) * column.factor

    def numbers(self, quantities: Iterable[str], *, missing: bool = False) -> np.ndarray:
        """Several columns side by side, (n, k), in SI units."""
        quantities = list(quantities)
        self.require(quantities)
        return np.stack([self.number(q, missing=missing) for q in quantities], axis=1)

    def text(self, quantity: str) -> list[str]:
        """One column as text, stripped; empty cells are ''."""
        self.require([quantity])
        series = self._body[0][self.columns[quantity].name]
        return [(value or "").strip() for value in series.to_list()]

    def raw(self, quantity: str) -> list[str | None]:
        """One column exactly as written, for finding its resolution."""
        self.require([quantity])
        return self._body[0][self.columns[quantity].name].to_list()

    def resolution(self, quantity: str) -> float:
        """The step of the last digit written, in SI units; 0 where the numbers are written in full (> 9 places).

        Example: angles written as 44.8, 19 and -126.6 have a resolution of 0.1 degree.
        """
        places = 0
        for cell in self.raw(quantity):
            if not cell:
                continue
            mantissa, _, exponent = cell.strip().lower().partition("e")
            decimals = len(mantissa.partition(".")[2]) - (int(exponent) if exponent else 0)
            places = max(places, decimals)
        return 0.0 if places > 9 else 10.0**-places * self.columns[quantity].factor
