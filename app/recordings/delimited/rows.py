"""Every row looked at once, in pieces, before columns are made of it: so that nothing endless is ever taken in."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from app.errors import FileFormatError
from app.recordings.delimited.dialect import Dialect
from app.recordings.delimited.source import Source

_LONGEST_LINE = 1_000_000  # bytes: 1,000 columns in full precision have 25,000
#: Lines that are empty, remarks or no rows, where they outnumber the rows before them.
MOST_EMPTY = 100_000
#: How lines begin that are no rows as they stand: remarks, also as a spreadsheet quotes them, and empty ones.
_BEGINS = b"#\n\r \t"
_PART = 1 << 20  # bytes taken apart at a time, so that what is endless is known after the first
_BLANKS = b'\r\t "'  # what an empty line may hold beside the sign that parts cells


def whole_lines(source: Source, offset: int, first_row: int) -> Iterator[tuple[int, bytes]]:
    """Pieces that end with a line, each with the number of its first line.

    Raises:
        FileFormatError: binary content, not UTF-8, or a line without end.
    """
    path, rest, number = source.path, b"", first_row
    for chunk in source.chunks(offset):
        zero = chunk.find(b"\x00")
        if zero >= 0:
            row = number + rest.count(b"\n") + chunk.count(b"\n", 0, zero)
            raise FileFormatError("binary content", file=path, row=row, expected="text")
        piece = rest + chunk
        end = piece.rfind(b"\n") + 1
        whole, rest = piece[:end], piece[end:]
        if len(rest) > _LONGEST_LINE or (whole and _too_long(whole)):
            row = number + _long_line(piece)
            raise FileFormatError(
                f"a line of over {_LONGEST_LINE} bytes", file=path, row=row, expected="one row a line"
            )
        if whole:
            _check_text(whole, path, number)
            yield number, whole
            number += whole.count(b"\n")
    if rest:
        _check_text(rest, path, number)
        yield number, rest


def _too_long(piece: bytes) -> bool:
    """True where some line of a piece that ends with one is too long; looks at a few places only."""
    start = 0
    while start < len(piece):
        end = piece.rfind(b"\n", start, start + _LONGEST_LINE + 1)
        if end < 0:
            return True
        start = end + 1
    return False


def _long_line(piece: bytes) -> int:
    return next((k for k, line in enumerate(piece.split(b"\n")) if len(line) > _LONGEST_LINE), 0)


def _check_text(piece: bytes, path: Path, number: int) -> None:
    if piece.isascii():
        return
    try:
        piece.decode("utf-8")
    except UnicodeDecodeError as error:
        row = number + piece.count(b"\n", 0, error.start)
        raise FileFormatError("not UTF-8 text", file=path, row=row, expected="UTF-8") from None


def mostly_empty(path: Path, row: int) -> FileFormatError:
    """What is said of a file with more lines without a row than rows, from this row on."""
    return FileFormatError(
        f"over {MOST_EMPTY} lines that are empty or remarks", file=path, row=row, expected="one row a line"
    )


def checked_rows(
    source: Source, offset: int, header_row: int, width: int, dialect: Dialect
) -> Iterator[tuple[np.ndarray, bytes]]:
    """The rows piece by piece, with the line each stood on, without empty and comment lines.

    Raises:
        FileFormatError: a row with more or fewer cells than the header, a quote that is not closed, more empty lines
            than rows, no rows; names the first row that is wrong.
    """
    path, empty, count = source.path, 0, 0
    for first, piece in whole_lines(source, offset, header_row + 1):
        for number, rows, kept in _in_order(piece, first, width, dialect):
            empty += number - len(rows)
            count += len(rows)
            if empty > MOST_EMPTY and empty > count:
                raise mostly_empty(path, first)
            if len(rows):
                _check_width(kept, rows, width, dialect, path)
                yield rows, kept
    if not count:
        raise FileFormatError("no data rows", file=path, expected="at least one row below the header")


def _in_order(
    piece: bytes, first: int, width: int, dialect: Dialect
) -> Iterator[tuple[int, np.ndarray, bytes]]:
    """Lines, rows with the lines they stood on, and their text, of a piece of whole lines."""
    blank = dialect.delimiter.encode()
    if not _odd(piece, blank, width):
        lines = _lines(piece)
        yield lines, np.arange(first, first + lines), piece
        return
    for number, part in parts(piece, first):
        yield _lines(part), *tidied(part, number, _BLANKS + blank)


def _odd(piece: bytes, blank: bytes, width: int) -> bool:
    """True where some line may be no row, by how the lines begin."""
    bytes_ = np.frombuffer(piece, np.uint8)
    starts = np.flatnonzero(bytes_[:-1] == ord("\n")) + 1
    begins = np.unique(np.append(bytes_[starts], bytes_[:1]))
    if np.isin(begins, list(_BEGINS)).any():
        return True
    filled = blank * (width - 1)
    signs = [sign for sign in (b'"#', b'""', filled + b"\n", filled + b"\r") if sign[0] in begins]
    return any(piece.startswith(sign) or (b"\n" + sign) in piece for sign in signs)


def parts(piece: bytes, first: int) -> Iterator[tuple[int, bytes]]:
    """A piece of whole lines as smaller ones, each with the number of its first line, so as to stop soon."""
    start = 0
    while start < len(piece):
        end = piece.find(b"\n", start + _PART) + 1 or len(piece)
        part = piece[start:end]
        yield first, part
        first, start = first + _lines(part), end


def _lines(piece: bytes) -> int:
    return piece.count(b"\n") + (not piece.endswith(b"\n"))


def tidied(piece: bytes, first: int, blanks: bytes) -> tuple[np.ndarray, bytes]:
    """The rows of a piece without empty and comment lines, and the lines they stood on.

    Args:
        piece: whole lines.
        first: number of the first.
        blanks: what an empty line may hold.
    """
    kept, rows = [], []
    for number, line in enumerate(piece.split(b"\n"), first):
        if line.translate(None, blanks) and not line.lstrip().startswith((b"#", b'"#')):
            kept.append(line.rstrip(b"\r"))
            rows.append(number)
    return np.array(rows, int), b"\n".join(kept) + (b"\n" if kept else b"")


def _check_width(piece: bytes, rows: np.ndarray, width: int, dialect: Dialect, path: Path) -> None:
    """Every row has as many cells as the header; signs within quotes part none."""
    bytes_ = np.frombuffer(piece, np.uint8)
    ends = np.flatnonzero(bytes_ == ord("\n"))
    if not piece.endswith(b"\n"):
        ends = np.append(ends, len(piece))
    signs = np.flatnonzero(bytes_ == ord(dialect.delimiter))
    if b'"' in piece:
        quotes = np.flatnonzero(bytes_ == ord('"'))
        unclosed = np.flatnonzero(np.diff(np.searchsorted(quotes, ends), prepend=0) % 2)
        if len(unclosed):
            raise FileFormatError(
                "a quote is not closed", file=path, row=int(rows[unclosed[0]]), expected="a closing quote"
            )
        signs = signs[np.searchsorted(quotes, signs) % 2 == 0]
    cells = np.diff(np.searchsorted(signs, ends), prepend=0) + 1
    wrong = np.flatnonzero(cells != width)
    if len(wrong):
        k = int(wrong[0])
        raise FileFormatError(
            f"{cells[k]} cells", file=path, row=int(rows[k]), expected=f"{width} as in the header row"
        )
