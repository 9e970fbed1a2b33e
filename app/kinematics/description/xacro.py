"""Macros expanded (xacro), in a process of its own that may read the description's own folders and nothing else.

`$(find PACKAGE)` is a folder with a package.xml: the one the file is in, or one beside it. Arguments take their
defaults. Macros hold expressions that are evaluated as Python; hence the other process, with a limit on time and
memory, an empty environment, and no way to open other files, programs or connections.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

from app.errors import FileFormatError

_MARK = re.compile(rb"<xacro:|xmlns:xacro")
_PATIENCE = 120.0  # s by the clock, on a busy machine; of the processor it gets less, see xacro_child.py
_HEAD = 65536  # bytes in which a file says that it holds macros
_LARGEST = 20_000_000


def is_xacro(path: Path, data: bytes) -> bool:
    """True for files that hold macros."""
    return path.suffix == ".xacro" or bool(_MARK.search(data[:_HEAD]))


def expanded(path: Path) -> bytes:
    """The URDF a xacro file stands for.

    Raises:
        FileFormatError: it cannot be expanded, reads other folders, or takes too long.
    """
    child = Path(__file__).with_name("xacro_child.py")
    try:
        done = subprocess.run(
            [sys.executable, "-I", str(child), str(path.resolve()), str(readable(path))],
            capture_output=True,
            timeout=_PATIENCE,
            env={"PATH": os.defpath, "PYTHONWARNINGS": "ignore"},
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise _too_long(path) from None
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        raise _too_long(path)
    if done.returncode or not done.stdout or len(done.stdout) > _LARGEST:
        said = done.stderr.decode("utf-8", errors="replace").strip().splitlines()
        reason = said[-1] if said else f"no description came out (exit {done.returncode})"
        raise FileFormatError(f"xacro: {reason}", file=path, expected="macros that can be expanded")
    return done.stdout


def _too_long(path: Path) -> FileFormatError:
    return FileFormatError("its macros take too long", file=path, expected="a description")


def readable(path: Path) -> Path:
    """The folder whose files a description may use: of a ROS package all packages beside it, else its own folder."""
    for folder in list(path.resolve().parents)[:6]:
        if (folder / "package.xml").is_file():
            return folder.parent
    return path.resolve().parent
