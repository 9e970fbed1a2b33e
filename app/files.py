"""Files in and out: regular ones only, up to a stated size, written whole or not at all.

A FIFO never ends, a device answers for ever, a link may lead to either: what a person names as a file is looked at
before it is opened, and nothing but a regular file is read or replaced.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import stat
from pathlib import Path

from app.errors import FileFormatError, one_line

#: The longest name a folder takes on common file systems [bytes].
LONGEST_NAME = 255


def read_bytes(path: str | Path, most: int, expected: str) -> bytes:
    """The content of a regular file.

    Args:
        path: the file; a link counts as what it leads to.
        most: largest size that is read [bytes].
        expected: what it should be, for the error.

    Raises:
        FileFormatError: no such file, not a regular one, larger, or not readable.
    """
    path = Path(path)
    check_readable(path, expected)
    try:
        with path.open("rb") as file:
            data = file.read(most + 1)
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    if len(data) > most:
        raise FileFormatError(f"too large for {expected}", file=path, expected=f"at most {most} bytes")
    return data


def check_readable(path: str | Path, expected: str) -> None:
    """Raises FileFormatError unless the path leads to a regular file."""
    path = Path(path)
    try:
        kind = path.stat().st_mode
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        reason = getattr(error, "strerror", None) or "not a file name"
        raise FileFormatError(f"cannot be read ({reason})", file=one_line(str(path), 200)) from None
    if not stat.S_ISREG(kind):
        what = "a folder" if stat.S_ISDIR(kind) else "not a regular file"
        raise FileFormatError(f"this is {what}", file=path, expected=expected)


def check_writable(path: str | Path) -> None:
    """Raises FileFormatError where a result may not be written: something other than a regular file stands there, the
    name is too long, or the folder does not exist."""
    path = Path(path)
    if len(os.fsencode(path.name)) > LONGEST_NAME or "\0" in str(path):
        raise FileFormatError(
            "the name is too long", file=one_line(str(path), 120), expected=f"at most {LONGEST_NAME} bytes"
        )
    try:
        if not path.parent.is_dir():
            raise FileFormatError(
                "there is no such folder", file=path.parent, expected="a folder to write to"
            )
        kind = path.lstat().st_mode
    except FileNotFoundError:
        return
    except OSError as error:
        raise FileFormatError(f"cannot be written ({error.strerror})", file=path) from None
    if not stat.S_ISREG(kind):
        raise FileFormatError("only a regular file is replaced", file=path, expected="a new name, or a file")


def write_bytes(path: str | Path, data: bytes) -> None:
    """Writes a file whole or not at all: beside it first, then in its place.

    Raises:
        FileFormatError: it cannot be written; what stood there still does.
    """
    path = Path(path)
    check_writable(path)
    beside = path.with_name(f".{secrets.token_hex(6)}.part")
    try:
        beside.write_bytes(data)
        if path.exists():
            beside.chmod(stat.S_IMODE(path.stat().st_mode))
        beside.replace(path)
    except OSError as error:
        raise FileFormatError(f"cannot be written ({error.strerror})", file=path) from None
    finally:
        with contextlib.suppress(OSError):
            beside.unlink(missing_ok=True)


def write_text(path: str | Path, text: str) -> None:
    """The same for text, in UTF-8."""
    write_bytes(path, text.encode("utf-8", errors="replace"))
