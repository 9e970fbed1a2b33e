"""A file somebody sent from the page: on the disk, under a name that leads nowhere else."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

_LONGEST_NAME = 120


@dataclass(frozen=True)
class Upload:
    """One file.

    Args:
        name: its name alone, as the person knows it.
        path: where it lies until its job has been done.
        folder: the folders it came from, inside what was dropped; empty for a single file.
    """

    name: str
    path: Path
    folder: str = ""

    @property
    def size(self) -> int:
        """Bytes."""
        return self.path.stat().st_size

    @property
    def content(self) -> bytes:
        """All of it; for files whose size was looked at."""
        return self.path.read_bytes()

    def into(self, folder: Path, otherwise: str) -> Path:
        """Moved into `folder`, with the sub-folders it came from; `otherwise` names a file that has no name."""
        place = folder / safe_folder(self.folder)
        place.mkdir(parents=True, exist_ok=True)
        target = place / (safe_name(self.name) or otherwise)
        shutil.move(self.path, target)
        return target


def safe_name(name: str) -> str:
    """The last part of a name a browser gave; empty where it has none."""
    last = PurePosixPath(name.replace("\\", "/").replace("\0", "")).name
    return "" if last in (".", "..") else last[-_LONGEST_NAME:]


def safe_folder(folder: str) -> Path:
    """Folders a browser gave, without any part that leads upwards."""
    parts = folder.replace("\\", "/").replace("\0", "").split("/")
    return Path(*(part[:_LONGEST_NAME] for part in parts if part not in ("", ".", "..")))
