"""HDF5 (and MATLAB 7.3): datasets by their paths, with a mapping (`--map`, or an attribute `map` of the file).

    teachframe diagnose log.h5 --robot ur10e --map q=robot/positions:deg,tau=robot/torques,t=robot/stamp:ns

Only datasets of the file itself are read; links to other files and storage elsewhere are not followed.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from app.errors import FileFormatError, InputError
from app.recordings.formats._grown import check_grown
from app.recordings.mapping import recording_of
from app.recordings.options import ReadOptions, parse_mapping
from app.recordings.table import Table

_MAGIC = b"\x89HDF\r\n\x1a\n"
_MATLAB = 512  # bytes that MATLAB 7.3 puts in front
_MOST = 5_000  # datasets
_DEEPEST = 2  # dimensions


class Hdf5:
    key = "hdf5"
    title = "HDF5 and MATLAB 7.3, by a mapping"

    def matches(self, path: Path, head: bytes) -> bool:
        return path.is_file() and (head.startswith(_MAGIC) or head[_MATLAB:].startswith(_MAGIC))

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads all datasets that hold numbers in one or two dimensions.

        Raises:
            FileFormatError: damaged, or larger than is read. InputError: as the mapping says.
        """
        import h5py  # loads slowly

        try:
            with h5py.File(path, "r") as file:
                arrays = _arrays(file, path)
                stated = file.attrs.get("map")
        except InputError:
            raise
        except Exception as error:  # whatever the library raises of a damaged file
            raise FileFormatError(
                f"cannot be read ({type(error).__name__})", file=path, expected="a whole HDF5 file"
            ) from None
        text = stated.decode() if isinstance(stated, bytes) else stated
        mapping = parse_mapping(text if isinstance(text, str) else None)
        return recording_of(path, arrays, options or ReadOptions(), stated=mapping)


def _arrays(file, path: Path) -> dict[str, np.ndarray]:
    import h5py

    sets: list = []

    def visit(name: str, thing: object) -> object:
        if isinstance(thing, h5py.Dataset):
            sets.append((name, thing))
        return True if len(sets) > _MOST else None

    file.visititems(visit)
    if len(sets) > _MOST:
        raise FileFormatError(f"over {_MOST} datasets", file=path, expected="a recording")
    arrays, total = {}, 0
    for name, data in sets:
        numbers = data.dtype.kind in "fiub" and 1 <= data.ndim <= _DEEPEST and data.size > 1
        if not numbers or data.external or data.is_virtual:
            continue
        total += data.size * max(data.dtype.itemsize, 8)
        check_grown(total, path, column=name)
        arrays[name] = np.asarray(data[()], float)
    return arrays


FORMAT = Hdf5()
