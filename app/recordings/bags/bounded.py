"""Chunks of a bag are decompressed within bounds: some ten kilobytes can stand for gigabytes.

rosbags keeps its decompressors in tables by name; those that have no bound of their own are replaced once.
"""

from __future__ import annotations

import bz2
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from types import SimpleNamespace
from typing import Any

#: Bytes of one chunk: recorders write 1 to 16 MB, and one message (a picture, a cloud of points) may be larger.
MOST_IN_CHUNK = 256_000_000
#: Bytes of all chunks for each byte of the file; joint states fall to a tenth, pictures of nothing to a hundredth.
MOST_RATIO = 200
_LEAST_TOTAL = 500_000_000
_LEAST_CHUNK = 64_000_000  # bytes a piece may have whatever its ratio is

_state = threading.local()


class BombError(Exception):
    """A bag stands for far more than it should."""


@contextmanager
def bounded(size: int) -> Iterator[None]:
    """Within, a bag of `size` bytes may not grow beyond MOST_RATIO times its size."""
    _install()
    _state.left = max(_LEAST_TOTAL, MOST_RATIO * size)
    try:
        yield
    finally:
        _state.left = None


def _count(data: bytes, most: int | None = None) -> bytes:
    most = MOST_IN_CHUNK if most is None else most
    if len(data) > most:
        raise BombError(f"a compressed piece of over {most // 1_000_000} MB")
    left = getattr(_state, "left", None)
    if left is not None:
        _state.left = left - len(data)
        if _state.left < 0:
            raise BombError(f"it grows to over {MOST_RATIO} times its size")
    return data


@cache
def _install() -> None:
    from lz4.frame import LZ4FrameDecompressor
    from rosbags.rosbag1 import reader as first
    from rosbags.rosbag2 import reader as second
    from rosbags.rosbag2 import storage_mcap

    zstd: Any = vars(storage_mcap)["zstd"]

    def least(make: Callable[[], Any]) -> Callable[..., bytes]:
        def decompress(data: bytes, *_: Any) -> bytes:
            most = min(MOST_IN_CHUNK, max(_LEAST_CHUNK, MOST_RATIO * len(data)))
            return _count(make().decompress(data, max_length=most + 1), most)

        return decompress

    frames = least(LZ4FrameDecompressor)
    standard = least(zstd.ZstdDecompressor)
    storage_mcap.DECOMPRESSORS.update({"lz4": frames, "zstd": standard})
    first.decompressors.update({"bz2": least(bz2.BZ2Decompressor), "lz4": frames})
    counted = SimpleNamespace(
        decompress=standard, open=lambda *given: _Counted(zstd.open(*given)), ZstdError=zstd.ZstdError
    )
    reader: Any = second
    reader.zstd = counted


class _Counted:
    """A file that is decompressed while it is read."""

    def __init__(self, file: Any):
        self._file = file

    def read(self, size: int = -1) -> bytes:
        return _count(self._file.read(size if size > 0 else MOST_IN_CHUNK))

    def __enter__(self) -> _Counted:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()
