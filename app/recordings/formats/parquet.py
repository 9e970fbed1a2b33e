"""Parquet: one file, or a data set in LeRobot's layout (a folder with `meta/info.json`), with a mapping.

    teachframe diagnose dataset/ --robot so101.urdf --map q=observation.state:deg,qc=action:deg

LeRobot's `meta/info.json` names the features and what their columns are called; the robot's joints are found by these
names. Episodes stand one behind the other; their clocks start anew, so each begins a second after the last.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl

from app.errors import FileFormatError, InputError
from app.recordings.formats._grown import MOST, check_grown
from app.recordings.mapping import recording_of
from app.recordings.options import ReadOptions
from app.recordings.table import Table

_MAGIC = b"PAR1"
_MOST_FILES = 10_000
_GAP = 1.0  # s between episodes
_MOST_INFO = 10_000_000  # bytes


class Parquet:
    key = "parquet"
    title = "Parquet and LeRobot data sets, by a mapping"

    def matches(self, path: Path, head: bytes) -> bool:
        if path.is_dir():
            return (path / "meta" / "info.json").is_file()
        return path.is_file() and head.startswith(_MAGIC)

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads every column of numbers, single or of lists of one length.

        Raises:
            FileFormatError: damaged, or larger than is read. InputError: as the mapping says.
        """
        names = _names(path / "meta" / "info.json") if path.is_dir() else {}
        files = sorted((path / "data").rglob("*.parquet"))[:_MOST_FILES] if path.is_dir() else [path]
        if not files:
            raise FileFormatError("no data files", file=path, expected="data/**/*.parquet")
        parts: list[dict[str, np.ndarray]] = []
        total = 0
        for file in files:
            part = _arrays(file, MOST - total)
            total += sum(array.nbytes for array in part.values())
            parts.append(part)
        common = [
            key
            for key in parts[0]
            if all(key in p and p[key].shape[1:] == parts[0][key].shape[1:] for p in parts)
        ]
        whole = len(parts) == 1
        arrays = {key: parts[0][key] if whole else np.concatenate([p[key] for p in parts]) for key in common}
        if "timestamp" in arrays and "episode_index" in arrays:
            arrays["timestamp"] = _counted_on(arrays["timestamp"], arrays["episode_index"])
        return recording_of(path, arrays, options or ReadOptions(), names=names)


def _arrays(file: Path, left: int) -> dict[str, np.ndarray]:
    try:
        scan = pl.scan_parquet(file, glob=False)
        schema = scan.collect_schema()
        rows = int(scan.select(pl.len()).collect().item())
        single = [n for n, kind in schema.items() if kind.is_numeric() or kind == pl.Boolean]
        lists = [
            n
            for n, kind in schema.items()
            if isinstance(kind, pl.List | pl.Array) and kind.inner.is_numeric()
        ]
        check_grown(8 * rows * (len(single) + 6 * len(lists)), file, left)
        out = {}
        for name in (*single, *lists):  # one at a time: the others need no memory yet
            column = scan.select(name).collect()[name]
            if name in single:
                out[name] = np.array(column.cast(pl.Float64).to_numpy(), float)
                continue
            widths = column.cast(pl.List(pl.Float64)).list.len().unique().to_list()
            width = widths[0] if len(widths) == 1 and not column.null_count() else 0
            if width and 8 * rows * width <= left:
                out[name] = np.array(column.explode().cast(pl.Float64).to_numpy(), float).reshape(rows, width)
        return out
    except InputError:
        raise
    except (
        Exception,
        pl.exceptions.PanicException,
    ) as error:  # whatever the library raises of a damaged file
        raise FileFormatError(
            f"cannot be read ({type(error).__name__})", file=file, expected="a whole Parquet file"
        ) from None


def _names(info: Path) -> dict[str, tuple[str, ...]]:
    """What the columns of each feature are called."""
    try:
        if info.stat().st_size > _MOST_INFO:
            raise ValueError
        features = json.loads(info.read_text(encoding="utf-8"))["features"]
        found = {}
        for key, feature in features.items():
            names = feature.get("names")
            if isinstance(names, dict):  # {"motors": [...]}
                names = next(iter(names.values()), None)
            if isinstance(names, list) and all(isinstance(name, str) for name in names):
                found[key] = tuple(names)
        return found
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError, OSError):
        raise FileFormatError(
            "its features cannot be read", file=info, expected="LeRobot's meta/info.json"
        ) from None


def _counted_on(t: np.ndarray, episode: np.ndarray) -> np.ndarray:
    """(m,) [s] one episode behind the other."""
    out, shift = np.array(t), 0.0
    starts = np.flatnonzero(np.diff(episode, prepend=episode[:1] - 1))
    for a, b in zip(starts, [*starts[1:], len(t)], strict=True):
        out[a:b] = t[a:b] - t[a] + shift
        shift = out[b - 1] + _GAP
    return out


FORMAT = Parquet()
