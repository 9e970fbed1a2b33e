"""The SQLite file before anything is asked of it: whose it is, whether it is whole, and which version made it.

Sessions are somebody's work and scores are personal: the folder that is made for them is for its owner alone (700), and
so is the file (600); SQLite gives its own files beside it the same rights.
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
import stat
from pathlib import Path

from app.errors import InputError, one_line
from app.session.migrations import steps

FOLDER_MODE, FILE_MODE = 0o700, 0o600
#: Seconds another program may hold the file while it is looked at.
_BUSY = 5.0


def prepare(path: Path) -> None:
    """Makes the folder and the file where they are missing, and looks at the file where it is there.

    Raises:
        InputError: it cannot be written, is damaged, is no database, or was made by a later version.
    """
    ours = make_folder(path.parent)
    new = not path.exists()
    try:
        os.close(os.open(path, os.O_RDWR | os.O_CREAT, FILE_MODE))
        if ours or new:
            path.chmod(FILE_MODE)
    except OSError as error:
        raise InputError(
            f"cannot be written ({error.strerror})", file=path, expected="a file that can be written"
        ) from None
    _look_at(path)


def make_folder(folder: Path) -> bool:
    """Makes a folder for its owner alone; True where it was made here. One that is there keeps the rights it has."""
    if folder.is_dir():
        return False
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=FOLDER_MODE, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", file=folder) from None
    return True


def close_folder(folder: Path) -> None:
    """Takes others' rights from a data folder that an earlier version made open: it holds our file already."""
    with contextlib.suppress(OSError):
        mode = folder.stat().st_mode
        if mode & (stat.S_ISVTX | stat.S_ISGID) or not mode & (stat.S_IRWXG | stat.S_IRWXO):
            return
        folder.chmod(FOLDER_MODE)


def _look_at(path: Path) -> None:
    try:
        with contextlib.closing(sqlite3.connect(path, timeout=_BUSY)) as connection:
            (version,) = connection.execute("PRAGMA user_version").fetchone()
            if version > (known := int(steps()[-1])):
                raise InputError(
                    f"this database was made by a later version (schema {version})",
                    file=path,
                    expected=f"schema {known}; update teachframe, or choose another --data folder",
                )
            damage = [row[0] for row in connection.execute("PRAGMA quick_check(1)")]
            if damage != ["ok"]:
                raise _damaged(path, damage[0] if damage else "no answer")
    except sqlite3.OperationalError as error:
        raise InputError(f"cannot be used ({one_line(str(error), 120)})", file=path) from None
    except sqlite3.DatabaseError as error:
        raise _damaged(path, str(error)) from None


def _damaged(path: Path, said: str) -> InputError:
    return InputError(
        f"the database is damaged ({one_line(said, 120)}); it is left as it is",
        file=path,
        expected="a copy from before: move this file away and put the copy in its place",
    )
