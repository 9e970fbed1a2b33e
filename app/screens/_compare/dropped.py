"""What somebody dropped: a recording, a robot description with its meshes, a folder, a zip of any of these."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.errors import InputError
from app.panel import Upload
from app.panel.uploads import safe_folder, safe_name

_DESCRIPTIONS = frozenset({".urdf", ".xml"})
_BESIDE = frozenset({".stl", ".dae", ".obj", ".mtl", ".ply", ".glb", ".png", ".jpg", ".yaml", ".md", ".txt"})
_BAGS = frozenset({".mcap", ".db3", ".bag"})
_MOST_FILES = 2_000  # in one zip
_MOST_BYTES = 400_000_000  # unpacked
_MOST_RATIO = 200.0  # unpacked over packed, from where on it is no recording
_SMALL = 1_000_000  # bytes a zip may unpack to whatever its ratio is


@dataclass(frozen=True)
class Dropped:
    """What was found.

    Args:
        recordings: files that may be recordings.
        description: the robot's description, where there is one.
    """

    recordings: tuple[Path, ...]
    description: Path | None


def take_in(files: Sequence[Upload], folder: Path) -> Dropped:
    """Copies what was dropped into `folder` and says what is what.

    Raises:
        InputError: a zip that cannot be unpacked, or two descriptions that cannot both be meant.
    """
    paths: list[Path] = []
    for file in files:
        if Path(file.name).suffix.lower() == ".zip":
            paths += _unpacked(file, folder)
        else:
            paths.append(file.into(folder, "recording.csv"))
    descriptions = [p for p in paths if p.suffix.lower() in _DESCRIPTIONS]
    if len(descriptions) > 1:
        names = ", ".join(sorted(p.name for p in descriptions))
        raise InputError(f"several robot descriptions were dropped: {names}", expected="one .urdf")
    bags = [p for p in paths if p.suffix.lower() in _BAGS]
    others = [p for p in paths if p.suffix.lower() not in _DESCRIPTIONS | _BESIDE]
    recordings = bags or others or [p for p in paths if p.suffix.lower() == ".txt"]
    return Dropped(tuple(recordings), descriptions[0] if descriptions else None)


def _unpacked(file: Upload, folder: Path) -> list[Path]:
    try:
        with zipfile.ZipFile(file.path) as packed:
            members = [m for m in packed.infolist() if not m.is_dir()]
            size = sum(m.file_size for m in members)
            ratio = size / max(file.size, 1)
            if len(members) > _MOST_FILES or size > _MOST_BYTES or (ratio > _MOST_RATIO and size > _SMALL):
                raise InputError("the zip unpacks to too much", file=file.name, expected="up to 400 MB")
            return [_member(packed, m, folder) for m in members if safe_name(m.filename)]
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, OSError) as error:
        raise InputError(f"the zip cannot be unpacked ({error})", file=file.name) from None


def _member(packed: zipfile.ZipFile, member: zipfile.ZipInfo, folder: Path) -> Path:
    place = folder / safe_folder(member.filename.rpartition("/")[0])
    place.mkdir(parents=True, exist_ok=True)
    path = place / safe_name(member.filename)
    with packed.open(member) as inner:
        left = member.file_size
        with path.open("wb") as out:
            while left >= 0 and (piece := inner.read(1 << 20)):
                left -= len(piece)
                out.write(piece)
    if left < 0:
        path.unlink()
        raise zipfile.BadZipFile("more in it than it says")
    return path
