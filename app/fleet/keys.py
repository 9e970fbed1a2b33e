"""What makes two pieces of work the same: the recording's content with its robot's, the program, the settings."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

import msgspec

from app import __version__
from app.fleet.work import Settings

#: The robot that a header names, and further files that belong to it.
_NAMED = re.compile(rb"^#\s*(?:robot|calibration)\s*:\s*(.+?)\s*$", re.MULTILINE)
_HEAD = 65536


def content_key(path: Path) -> str:
    """SHA-256 of a recording's bytes (of a folder: names and bytes of all its files), with the description's that it
    names beside it. Raises OSError."""
    whole = hashlib.sha256()
    for part in sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path]:
        if path.is_dir():
            whole.update(f"\0{part.relative_to(path)}\0".encode())
        head = _add(whole, part)
        for named in [] if path.is_dir() else _NAMED.findall(head):
            beside = path.parent / named.decode("utf-8", "replace").strip("\"'").partition("#")[0]
            if _is_file(beside):
                whole.update(b"\0robot\0")
                _add(whole, beside)
    return whole.hexdigest()


def settings_key(settings: Settings) -> str:
    """SHA-256 of what was asked for, with the content of the robot that was chosen."""
    whole = hashlib.sha256(msgspec.json.encode(settings.asked(), order="sorted"))
    for named in (settings.robot, *(str(p) for p in (settings.reference, settings.model) if p)):
        place = Path((named or "").partition("#")[0])
        if named and _is_file(place):
            _add(whole, place)
    return whole.hexdigest()


def program() -> str:
    """The version whose results these are."""
    return __version__


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name too long, a zero byte
        return False


def _add(whole, path: Path) -> bytes:
    """Adds a file's content; its first bytes."""
    with path.open("rb") as file:
        head = file.read(_HEAD)
        whole.update(head)
        while piece := file.read(1 << 20):
            whole.update(piece)
    return head
