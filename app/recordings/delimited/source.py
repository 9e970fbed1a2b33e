"""A file's bytes as UTF-8 text with line feeds, whatever wrote it."""

from __future__ import annotations

import codecs
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from app.errors import FileFormatError

CHUNK = 1 << 22  # bytes read at a time: after each one somebody may hear how far it is
_CONVERTED = 300_000_000  # bytes that are converted in memory: other codes, other line ends
_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


@dataclass(frozen=True, eq=False)
class Source:
    """Text of one file.

    Args:
        path: the file.
        data: its text where it had to be converted; None where the file itself is it.
    """

    path: Path
    data: bytes | None = None

    def chunks(self, offset: int, size: int = CHUNK) -> Iterator[bytes]:
        """The text from `offset` on, piece by piece."""
        if self.data is not None:
            for start in range(offset, len(self.data), size):
                yield self.data[start : start + size]
            return
        with self.path.open("rb") as file:
            file.seek(offset)
            while chunk := file.read(size):
                yield chunk

    def size(self) -> int:
        """Bytes of text."""
        return self.path.stat().st_size if self.data is None else len(self.data)

    def rest(self, offset: int) -> bytes:
        """All text from `offset` on."""
        return b"".join(self.chunks(offset))


def open_source(path: Path, head: bytes) -> Source:
    """The file's text; `head` its first bytes.

    Raises:
        FileFormatError: it has to be converted and is too long for that, or is not in the code it says.
    """
    wide = head.startswith(_UTF16)
    lone = b"\r" in head and b"\n" not in head and b"\x00" not in head
    if not wide and not lone:
        return Source(path)
    if path.stat().st_size > _CONVERTED:
        raise FileFormatError(
            "too long for UTF-16 or lines that end in a carriage return alone",
            file=path,
            row=1,
            expected="UTF-8 with LF or CR LF line ends",
        )
    data = path.read_bytes()
    if wide:
        try:
            data = data.decode("utf-16").encode()
        except UnicodeError:
            raise FileFormatError("not UTF-16 text", file=path, row=1, expected="UTF-8") from None
    return Source(path, data.replace(b"\r\n", b"\n").replace(b"\r", b"\n"))
