"""Rows as they come: each on the disk before the next, one a file; when all are there they become the results' file.

SQLite beside the results, until they are written: a run that is ended at any moment leaves whole rows only.
"""

from __future__ import annotations

import contextlib
import secrets
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from pathlib import Path

import msgspec
import polars as pl

from app.errors import FileFormatError, InputError, one_line
from app.files import check_writable
from app.fleet.work import Row

#: Column -> type of the results, in their order.
COLUMNS = {
    "file": pl.String, "arm": pl.String, "recorded_s": pl.Float64, "dated": pl.String, "kind": pl.String,
    "robot": pl.String, "samples": pl.Int64, "verdict": pl.String, "before": pl.Float64, "after": pl.Float64,
    "unit": pl.String, "error": pl.String, "reason": pl.String, "seconds": pl.Float64, "limit_s": pl.Float64,
    "diagnosis": pl.String, "key": pl.String, "version": pl.String, "settings": pl.String, "run": pl.Int64,
}  # fmt: skip
#: Names of a row that carry their unit in a column.
_FIELDS = {"recorded_s": "recorded", "limit_s": "limit"}
_AT_ONCE = 1000  # rows in memory
_BUSY = 2.0  # seconds until a second run on the same results gives up


class Ledger:
    """The rows of one results file.

    Args:
        out: the results.
        fresh: True forgets what was done before.

    Raises:
        InputError: another run writes there, or what stands there is not ours.
    """

    def __init__(self, out: Path, *, fresh: bool = False):
        check_writable(out)
        self._out, self._path = out, out.with_name(out.name + ".part")
        check_writable(self._path)
        try:
            self._open(fresh)
        except sqlite3.OperationalError as error:
            said = "another run writes there" if "locked" in str(error) else one_line(str(error), 120)
            raise InputError(said, file=self._path, expected="another --out, or its end") from None
        except sqlite3.DatabaseError as error:
            what = f"cannot be gone on with ({one_line(str(error), 120)})"
            raise FileFormatError(
                what, file=self._path, expected="a part of these results; delete it"
            ) from None
        if out.exists() and not fresh:
            self._take_before()
        (last,) = self._base.execute("SELECT max(run) FROM rows").fetchone()
        self.run = (last or 0) + 1

    def give(self, files: list[str]) -> None:
        """The files whose rows are wanted, in their order."""
        with self._base:
            self._base.execute("DELETE FROM given")
            self._base.executemany("INSERT OR IGNORE INTO given (file) VALUES (?)", ((f,) for f in files))

    def row(self, file: str) -> Row | None:
        """The row of a file, if there is one."""
        return self._one("SELECT row FROM rows WHERE file = ?", file)

    def same(self, key: str, version: str, settings: str) -> Row | None:
        """A row of the same work, of whichever file."""
        found = (
            "SELECT row FROM rows WHERE key = ? AND version = ? AND settings = ? ORDER BY run DESC LIMIT 1"
        )
        return self._one(found, key, version, settings)

    def add(self, row: Row) -> None:
        """Keeps a row, in the place of an earlier one of the same file."""
        said = (row.file, row.key, row.version, row.settings, row.run, msgspec.json.encode(row).decode())
        try:
            with self._base:
                self._base.execute("INSERT OR REPLACE INTO rows VALUES (?, ?, ?, ?, ?, ?)", said)
        except sqlite3.Error as error:
            raise FileFormatError(
                f"cannot be written ({one_line(str(error), 80)})", file=self._path
            ) from None

    def rows(self) -> Iterator[Row]:
        """Rows of the files given, in their order; not all of them in memory."""
        wanted = "SELECT row FROM given JOIN rows USING (file) ORDER BY n"
        for (text,) in self._base.execute(wanted):
            yield msgspec.json.decode(text, type=Row)

    def left_out(self) -> int:
        """Rows of files that are not among those given."""
        return self._base.execute(
            "SELECT count(*) FROM rows WHERE file NOT IN (SELECT file FROM given)"
        ).fetchone()[0]

    def write(self) -> None:
        """Writes the results, whole or not at all; the rows are theirs from then on."""
        beside = self._out.with_name(f".{secrets.token_hex(6)}.part")
        parts = Path(tempfile.mkdtemp(prefix="teachframe-fleet-"))
        try:
            batch: list[Row] = []
            for row in self.rows():
                batch.append(row)
                if len(batch) == _AT_ONCE:
                    _write_part(parts, batch)
            if batch or not list(parts.iterdir()):
                _write_part(parts, batch)
            pl.scan_parquet(parts / "*.parquet").sink_parquet(beside)
            beside.replace(self._out)
        except OSError as error:
            raise FileFormatError(f"cannot be written ({error.strerror})", file=self._out) from None
        finally:
            beside.unlink(missing_ok=True)
            shutil.rmtree(parts, ignore_errors=True)
        self.close()
        self._path.unlink(missing_ok=True)

    def close(self) -> None:
        """Lets go of the file; what is in it stays."""
        with contextlib.suppress(sqlite3.Error):
            self._base.close()

    def _open(self, fresh: bool) -> None:
        self._base = sqlite3.connect(self._path, timeout=_BUSY)
        base = self._base
        base.execute("PRAGMA locking_mode=EXCLUSIVE")
        base.execute("PRAGMA journal_mode=WAL")
        base.execute(
            "PRAGMA synchronous=NORMAL"
        )  # a killed process loses nothing; a fallen machine its last rows
        with base:
            base.execute(
                "CREATE TABLE IF NOT EXISTS rows (file TEXT PRIMARY KEY, key TEXT, version TEXT, settings TEXT,"
                " run INTEGER, row TEXT)"
            )
            base.execute("CREATE INDEX IF NOT EXISTS same ON rows (key)")
            base.execute("CREATE TABLE IF NOT EXISTS given (n INTEGER PRIMARY KEY, file TEXT UNIQUE)")
            if fresh:
                base.execute("DELETE FROM rows")

    def _one(self, query: str, *values: str) -> Row | None:
        found = self._base.execute(query, values).fetchone()
        return None if found is None else msgspec.json.decode(found[0], type=Row)

    def _take_before(self) -> None:
        known = {file for (file,) in self._base.execute("SELECT file FROM rows")}
        for row in read_rows(self._out):
            if row.file not in known:
                self.add(row)


def read_rows(results: Path) -> Iterator[Row]:
    """Rows of a results file, a thousand of them in memory.

    Raises:
        FileFormatError: it is none of ours.
    """
    try:
        scan = pl.scan_parquet(results)
        if set(scan.collect_schema()) < set(COLUMNS):
            raise FileFormatError(
                "these are other columns", file=results, expected="results of teachframe fleet"
            )
        count = scan.select(pl.len()).collect().item()
        for begin in range(0, count, _AT_ONCE):
            for said in scan.slice(begin, _AT_ONCE).collect().iter_rows(named=True):
                yield Row(**{_FIELDS.get(name, name): said[name] for name in COLUMNS})
    except (pl.exceptions.PolarsError, OSError) as error:
        raise FileFormatError(
            f"cannot be read ({one_line(str(error), 100)})",
            file=results,
            expected="results of teachframe fleet",
        ) from None


def _write_part(folder: Path, batch: list[Row]) -> None:
    columns = {name: [getattr(row, _FIELDS.get(name, name)) for row in batch] for name in COLUMNS}
    number = len(list(folder.iterdir()))
    pl.DataFrame(columns, schema=COLUMNS).write_parquet(folder / f"{number:06d}.parquet")
    batch.clear()
