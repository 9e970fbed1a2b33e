"""MATLAB's .mat to version 7 (7.3 is HDF5): variables and fields of structures by name, with a mapping.

    teachframe diagnose log.mat --robot ur10e --map q=data.q:deg,tau=data.torque,t=data.time

The mapping may also stand in a text variable `map` of the file itself.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from app.errors import FileFormatError
from app.recordings.mapping import recording_of
from app.recordings.options import ReadOptions, parse_mapping
from app.recordings.table import Table

_MAGIC = b"MATLAB 5.0 MAT-file"
_LARGEST = 500_000_000  # bytes of the file, and of what it unpacks to
_PACKED = 15  # the tag of a compressed variable
_HEADER = 128
_DEEPEST, _MOST = 4, 5_000  # structures within structures, arrays


class Matlab:
    key = "matlab"
    title = "MATLAB .mat, by a mapping"

    def matches(self, path: Path, head: bytes) -> bool:
        return path.is_file() and head.startswith(_MAGIC)

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads every array of numbers in one or two dimensions.

        Raises:
            FileFormatError: damaged, or unpacks to more than is read. InputError: as the mapping says.
        """
        from scipy.io import loadmat  # loads slowly

        if path.stat().st_size > _LARGEST:
            raise FileFormatError("too large", file=path, expected=f"at most {_LARGEST // 10**6} MB")
        _check_unpacked(path)
        try:
            held = loadmat(path, simplify_cells=True)
        except Exception as error:  # whatever the library raises of a damaged file
            raise FileFormatError(
                f"cannot be read ({type(error).__name__})", file=path, expected="a whole .mat file"
            ) from None
        stated = held.get("map")
        arrays: dict[str, np.ndarray] = {}
        _collect("", {k: v for k, v in held.items() if not k.startswith("__")}, arrays, 0)
        mapping = parse_mapping(stated if isinstance(stated, str) else None)
        return recording_of(path, arrays, options or ReadOptions(), stated=mapping)


def _collect(front: str, held: dict[str, Any], arrays: dict[str, np.ndarray], depth: int) -> None:
    for name, value in held.items():
        if len(arrays) >= _MOST:
            return
        if isinstance(value, dict) and depth < _DEEPEST:
            _collect(f"{front}{name}.", value, arrays, depth + 1)
        elif (
            isinstance(value, np.ndarray)
            and value.dtype.kind in "fiub"
            and value.ndim in (1, 2)
            and value.size > 1
        ):
            arrays[front + name] = np.asarray(value, float)


def _check_unpacked(path: Path) -> None:
    """Unpacks every compressed variable piece by piece and lets go of it again: kilobytes can stand for gigabytes."""
    total = 0
    with path.open("rb") as file:
        head = file.read(_HEADER)
        order = ">" if head[126:128] == b"MI" else "<"
        while len(tag := file.read(8)) == 8:
            kind, size = struct.unpack(order + "II", tag)
            if kind != _PACKED:
                file.seek(size, 1)
                continue
            unpacker, left = zlib.decompressobj(), size
            while left > 0 and (piece := file.read(min(left, 1 << 16))):
                left -= len(piece)
                try:
                    while piece:
                        total += len(unpacker.decompress(piece, 1 << 22))
                        piece = unpacker.unconsumed_tail
                        if total > _LARGEST:
                            raise FileFormatError(
                                f"unpacks to over {_LARGEST // 10**6} MB", file=path, expected="a recording"
                            )
                except zlib.error:
                    raise FileFormatError(
                        "cannot be read (damaged)", file=path, expected="a whole .mat file"
                    ) from None


FORMAT = Matlab()
