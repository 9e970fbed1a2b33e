"""A table's rows as columns: text where the file is small, so that every digit counts, numbers where it is large."""

from __future__ import annotations

import io

import numpy as np
import polars as pl

from app.errors import FileFormatError
from app.recordings.columns import TEXT, parse_column
from app.recordings.delimited.dialect import Dialect
from app.recordings.delimited.rows import checked_rows
from app.recordings.delimited.source import Source
from app.steps import done

_LARGE = 64_000_000  # bytes: beyond, cells kept as text would take several times the file


class Body:
    """The rows of one file.

    Args:
        source: its text.
        offset: bytes in front of the first row.
        header_row: line number of the header row.
        names: columns as they stand in the header, those without a name among them.
        dialect: how cells are parted.
    """

    def __init__(
        self, source: Source, offset: int, header_row: int, names: tuple[str, ...], dialect: Dialect
    ):
        self._source, self._offset, self._header_row = source, offset, header_row
        self._names, self._dialect = names, dialect
        self._numeric = {name for name in names if _is_number(name)}

    def load(self) -> tuple[pl.DataFrame, np.ndarray]:
        """Columns, and the line number of every row.

        Raises:
            FileFormatError: rows that are none; names the first.
        """
        large = self._source.size() - self._offset > _LARGE
        frame, rows = self._frame(list(self._names), typed=large)
        if not large:
            frame = frame.with_columns(pl.col(pl.String).str.strip_chars().replace("", None))
        return frame, rows

    def text(self, name: str) -> pl.Series:
        """One column as it is written."""
        series = self._frame([name], typed=False)[0][name]
        return series.str.strip_chars().replace("", None)

    def _frame(self, columns: list[str], *, typed: bool) -> tuple[pl.DataFrame, np.ndarray]:
        frames: list[pl.DataFrame] = []
        numbers: list[np.ndarray] = []
        given = (self._source, self._offset, self._header_row, len(self._names), self._dialect)
        taken, size = 0, max(self._source.size() - self._offset, 1)
        for rows, piece in checked_rows(*given):
            frame = self._parsed(piece, columns, typed)
            taken += len(piece)
            done(taken / size)
            frames.append(frame)
            numbers.append(rows[: len(frame)])
        return pl.concat(frames), np.concatenate(numbers)

    def _parsed(self, piece: bytes, columns: list[str], typed: bool) -> pl.DataFrame:
        comma = self._dialect.decimal_comma
        try:
            frame = pl.read_csv(
                io.BytesIO(piece),
                has_header=False,
                schema={n: pl.Float64 if typed and n in self._numeric else pl.String for n in self._names},
                columns=[self._names.index(name) for name in columns],
                separator=self._dialect.delimiter,
                null_values="",
                ignore_errors=typed,
                decimal_comma=comma and typed,
            )
        except pl.exceptions.PolarsError as error:
            raise FileFormatError(
                f"cannot read the rows ({str(error).splitlines()[0]})",
                file=self._source.path,
                row=self._header_row + 1,
                expected=f"rows parted by {self._dialect.delimiter!r}",
            ) from None
        if comma and not typed:
            numbers = [name for name in frame.columns if name in self._numeric]
            frame = frame.with_columns(pl.col(numbers).str.replace(r"^(\s*[+-]?\d*),(\d+)", "$1.$2"))
        return frame


def _is_number(name: str) -> bool:
    column = parse_column(name)
    return column.known and not column.moment and name not in TEXT
