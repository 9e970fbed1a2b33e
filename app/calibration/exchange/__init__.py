"""Tool frames in and out: one file a format, found through its object `FORMAT`.

text = formats()["kuka_krl"].write(frame)
frame = read_frame("torch.src")                    finds the format by looking at the text
frame = read_frame("cell.mod", tool="tLong")       one of several, by its name or number
"""

from __future__ import annotations

from pathlib import Path
from typing import cast

from app import catalog
from app.calibration.exchange._frame import LARGEST, ToolFrame
from app.calibration.exchange._tools import ExchangeFormat
from app.errors import FileFormatError, UnknownNameError
from app.files import read_bytes

__all__ = ["ExchangeFormat", "ToolFrame", "exchange_format", "formats", "holds_tools", "read_frame"]


def formats() -> dict[str, ExchangeFormat]:
    """All formats by key."""
    return catalog.members(__name__, "FORMAT")


def exchange_format(key: str) -> ExchangeFormat:
    """One format.

    Raises:
        UnknownNameError: there is none of this key.
    """
    return cast(ExchangeFormat, catalog.member(__name__, "FORMAT", key, what="format"))


def read_frame(path: str | Path, key: str | None = None, *, tool: str | None = None) -> ToolFrame:
    """A tool frame from a file, in the format given or in the first that knows the text.

    Args:
        path: a controller's file, read to its end.
        key: its format.
        tool: name or number of the tool meant, where the file holds several.

    Raises:
        FileFormatError: not readable, of no known format, without a tool, or with several and none named.
        UnknownNameError: no such format, or no such tool; lists what there is.
    """
    path = Path(path)
    text = _text(path)
    form = exchange_format(key) if key is not None else _format_of(text, path)
    if form is None:
        raise FileFormatError(
            "no tool frame of a known format", file=path, row=1, expected="one of " + ", ".join(formats())
        )
    try:
        return form.read(text, tool)
    except UnknownNameError as error:
        raise UnknownNameError(error.name, available=error.available, what="tool", file=path) from None
    except FileFormatError as error:
        raise FileFormatError(
            error.problem, file=path, row=error.row, column=error.column, expected=error.expected
        ) from None


def holds_tools(path: str | Path) -> bool:
    """True where a file is a controller's by its text or its ending, whether or not a tool stands in it."""
    path = Path(path)
    return path.is_file() and _format_of(_text(path), path) is not None


def _format_of(text: str, path: Path) -> ExchangeFormat | None:
    every = formats().values()
    known = next((form for form in every if form.knows(text)), None)
    return known or next((form for form in every if path.suffix.lower() in form.suffixes), None)


def _text(path: Path) -> str:
    """The whole file as text. Controllers write their comments in code pages of their own; the rest is ASCII."""
    data = read_bytes(path, LARGEST, "a tool frame")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")
