"""Tool frames in and out: one file a format, found through its object `FORMAT`.

text = formats()["kuka_krl"].write(frame)
frame = read_frame("torch.src")          finds the format by looking at the text
"""

from __future__ import annotations

from pathlib import Path
from typing import cast

from app import catalog
from app.calibration.exchange._frame import LARGEST, ExchangeFormat, ToolFrame
from app.errors import FileFormatError

__all__ = ["ExchangeFormat", "ToolFrame", "exchange_format", "formats", "read_frame"]


def formats() -> dict[str, ExchangeFormat]:
    """All formats by key."""
    return catalog.members(__name__, "FORMAT")


def exchange_format(key: str) -> ExchangeFormat:
    """One format.

    Raises:
        UnknownNameError: there is none of this key.
    """
    return cast(ExchangeFormat, catalog.member(__name__, "FORMAT", key, what="format"))


def read_frame(path: str | Path, key: str | None = None) -> ToolFrame:
    """A tool frame from a file, in the format given or in the first that knows the text.

    Raises:
        FileFormatError: not readable, or of no known format.
        UnknownNameError: no such format.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    if len(data) > LARGEST:
        raise FileFormatError("too large for a tool frame", file=path, expected=f"at most {LARGEST} bytes")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise FileFormatError("not UTF-8 text", file=path, row=1, expected="a tool frame") from None
    try:
        if key is not None:
            return exchange_format(key).read(text)
        for form in formats().values():
            if form.knows(text):
                return form.read(text)
    except FileFormatError as error:
        raise FileFormatError(
            error.problem, file=path, row=error.row, column=error.column, expected=error.expected
        ) from None
    raise FileFormatError(
        "no tool frame of a known format", file=path, row=1, expected="one of " + ", ".join(formats())
    )
