"""Picks the format of a file and reads it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app import catalog
from app.errors import FileFormatError
from app.recordings.options import ReadOptions
from app.recordings.pairing import paired
from app.recordings.table import Table

FORMATS = "app.recordings.formats"


def read_table(path: str | Path, options: ReadOptions | None = None) -> Table:
    """Reads a recording.

    The format is the first one that says `matches(path, head)`; the rest of the file is not looked at until a
    column is asked for.

    Args:
        path: the file, or a folder that is one recording (a bag, a data set).
        options: how to read files that do not say everything themselves.

    Raises:
        FileFormatError: no such file, empty, or of no known format.
    """
    options = options or ReadOptions()
    table = _read(Path(path), options)
    if options.joints is None:
        return table
    return paired(table, _read(Path(options.joints), replace(options, joints=None)))


def _read(path: Path, options: ReadOptions) -> Table:
    if path.is_dir():
        for form in catalog.members(FORMATS, "FORMAT").values():
            if form.matches(path, b""):
                return form.read(path, options)
        raise FileFormatError("is a folder", file=path, expected="a file")
    if not path.is_file():
        raise FileFormatError("there is no such file", file=path)
    try:
        with path.open("rb") as file:
            head = file.read(65536)
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    if not head:
        raise FileFormatError("the file is empty", file=path, row=1, expected="a header row")
    forms = catalog.members(FORMATS, "FORMAT").values()
    for form in sorted(forms, key=lambda form: getattr(form, "fallback", False)):
        if form.matches(path, head):
            return form.read(path, options)
    raise FileFormatError(
        "binary content",
        file=path,
        row=head.partition(b"\x00")[0].count(b"\n") + 1,
        expected="UTF-8 text: '# key: value' lines, a header row, data rows",
    )
