"""Which recordings a folder or a list names; whose each is and when it was made, where the file does not say."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

from app.errors import FileFormatError, InputError

#: What recordings' files are called; other files of a folder (notes, descriptions, pictures) are passed over. A list
#: may name anything.
ENDINGS = (".csv", ".tsv", ".txt", ".bag", ".mcap", ".mat", ".h5", ".hdf5", ".parquet")
_NOT = (".truth.json",)
#: A folder that holds one of these is one recording.
_MARKS = ("metadata.yaml", "meta/info.json")
_DATE = re.compile(
    r"(?<!\d)(20\d\d)[-_.]?(0[1-9]|1[0-2])[-_.]?(0[1-9]|[12]\d|3[01])(?:[T_-]?([01]\d|2[0-3])[-_:]?([0-5]\d))?(?!\d)"
)
_MOST_LIST = 1 << 30  # bytes of a list


def recordings(where: Path, *, but: Path | None = None) -> list[Path]:
    """Recordings, in the order of their paths, or of the list; each once.

    Args:
        where: a folder, searched with all below it, or a text file with one path a line (relative to the list; empty
            lines and those that begin with `#` are passed over).
        but: a file that is none (the results).

    Raises:
        InputError: there is no such place, or it names nothing.
    """
    if where.is_dir():
        found = [path for path in _below(where) if but is None or path.resolve() != but.resolve()]
        expected = f"files that end in {', '.join(ENDINGS)}"
    elif where.is_file():
        found = list(dict.fromkeys(_listed(where)))
        expected = "one path a line"
    else:
        raise FileFormatError("there is no such folder or list", file=where)
    if not found:
        raise InputError("no recordings here", file=where, expected=expected)
    return found


def arm_of(path: Path, root: Path) -> str:
    """Whose recording a file is, by where it lies: its folder below `root`; empty where it lies in `root` itself."""
    folder = path.parent
    try:
        parts = folder.resolve().relative_to(root.resolve()).parts
    except ValueError:
        return folder.name
    return "/".join(parts)


def dated(path: Path, said: object) -> tuple[float, str]:
    """When a recording was made [s since 1970] and what says so: its header, its name, or its file's last change.

    Args:
        path: the recording.
        said: the header's `# recorded:`, ISO 8601; None where there is none, or where it is no time.
    """
    for text, source in ((str(said or ""), "header"), (path.name, "name")):
        when = _time(text) if source == "header" else _named(text)
        if when is not None:
            return when, source
    try:
        return path.stat().st_mtime, "file"
    except OSError:
        return 0.0, ""


def _time(text: str) -> float | None:
    try:
        when = datetime.fromisoformat(text.strip())
    except ValueError:
        return None
    try:
        return (when if when.tzinfo else when.replace(tzinfo=UTC)).timestamp()
    except (OverflowError, ValueError, OSError):
        return None


def _named(text: str) -> float | None:
    found = _DATE.search(text)
    if found is None:
        return None
    try:
        return datetime(*(int(part) for part in found.groups(default="0")), tzinfo=UTC).timestamp()
    except ValueError:  # the 31st of a short month
        return None


def _below(root: Path) -> Iterator[Path]:
    for folder, folders, files in os.walk(root):
        at = Path(folder)
        if at != root and any((at / mark).is_file() for mark in _MARKS):
            folders.clear()
            yield at
            continue
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            if name.lower().endswith(ENDINGS) and not name.startswith(".") and not name.endswith(_NOT):
                yield at / name


def _listed(where: Path) -> Iterator[Path]:
    if where.stat().st_size > _MOST_LIST:
        raise FileFormatError("too large for a list", file=where, expected=f"at most {_MOST_LIST} bytes")
    with where.open("rb") as lines:
        for number, line in enumerate(lines, 1):
            try:
                text = line.decode("utf-8-sig" if number == 1 else "utf-8").strip()
            except UnicodeDecodeError:
                text = "\0"
            if "\0" in text or len(text) > os.pathconf("/", "PC_PATH_MAX"):
                raise FileFormatError(
                    "this is no list of paths", file=where, row=number, expected="one path a line, in UTF-8"
                )
            if text and not text.startswith("#"):
                yield where.parent / text
