"""How far numbers may grow from what a file holds of them: some kilobytes of zeros can stand for gigabytes."""

from __future__ import annotations

from pathlib import Path

from app.errors import FileFormatError

#: Bytes of numbers of a recording.
MOST = 1_000_000_000
#: Bytes of numbers for each byte of the file; logs of a drive fall to a tenth.
MOST_RATIO = 200
_SMALL = 64_000_000  # bytes of numbers a file may hold whatever its ratio is


def check_grown(numbers: int, path: Path, left: int = MOST, column: str | None = None) -> None:
    """Raises FileFormatError where so many bytes of numbers are more than is read.

    Args:
        numbers: bytes.
        path: the file that holds them.
        left: bytes that may still be read.
        column: what holds them.
    """
    if numbers > left:
        raise FileFormatError(
            "too large", file=path, column=column, expected=f"at most {MOST // 10**6} MB of numbers"
        )
    if numbers > max(_SMALL, MOST_RATIO * path.stat().st_size):
        raise FileFormatError(
            f"{numbers // 10**6} MB of numbers are packed in it",
            file=path,
            column=column,
            expected=f"at most {MOST_RATIO} times its size",
        )
