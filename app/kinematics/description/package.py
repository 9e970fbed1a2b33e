"""A robot's folder, or a zip of one: where in it the description is.

A zip is unpacked once into the user's cache, under the name of its content; what it holds is bounded, and no file of it
lands outside.
"""

from __future__ import annotations

import hashlib
import shutil
import tempfile
import zipfile
import zlib
from pathlib import Path

import platformdirs

from app.errors import FileFormatError

_ENDINGS = (".urdf", ".urdf.xacro", ".xacro")
_MOST_FILES = 5_000
_LARGEST = 1_000_000_000  # bytes unpacked; the largest public packages of one arm have 200 MB
_MOST_RATIO, _SMALL = (
    200,
    50_000_000,
)  # unpacked over packed, and bytes a zip may unpack to whatever its ratio is
_LISTED = 8


def description_in(path: Path) -> Path:
    """The description that a folder or a zip holds; any other path as it is.

    Raises:
        FileFormatError: none in it or several, or a zip that cannot be.
    """
    if path.is_dir():
        return _the_one(path, path)
    if path.suffix.lower() == ".zip" and path.is_file():
        return _the_one(unpacked(path), path)
    return path


def _the_one(folder: Path, asked: Path) -> Path:
    for ending in _ENDINGS:
        found = []
        for count, file in enumerate(sorted(folder.rglob(f"*{ending}"))):
            if count > _MOST_FILES:
                break
            if file.is_file() and not file.name.startswith("."):
                found.append(file)
        whole = [f for f in found if ending != ".xacro" or "macro" not in f.name]
        if len(whole) == 1:
            return whole[0]
        if whole:
            names = [f.relative_to(folder).as_posix() for f in whole]
            raise FileFormatError(
                f"{len(names)} robots in it: {', '.join(names[:_LISTED])}",
                file=asked,
                expected=f"FOLDER/{names[0]} or one of the others",
            )
    raise FileFormatError("no robot description in it", file=asked, expected="a robot description in it")


def unpacked(path: Path, folder: Path | None = None) -> Path:
    """The folder a zip was unpacked into, once for its content.

    Args:
        path: the zip.
        folder: where unpacked zips are kept; None the user's cache.

    Raises:
        FileFormatError: damaged, too large, or with a file that leads out of it.
    """
    kept = folder or Path(platformdirs.user_cache_dir("teachframe")) / "robots"
    try:
        with path.open("rb") as file:
            name = hashlib.file_digest(file, "sha256").hexdigest()[:24]
        place = kept / name
        if place.is_dir():
            return place
        kept.mkdir(parents=True, exist_ok=True)
        making = Path(tempfile.mkdtemp(dir=kept))
        try:
            _unpack(path, making)
            making.rename(place)
        except OSError:
            if not place.is_dir():  # another process was not the first either
                raise
        finally:
            shutil.rmtree(making, ignore_errors=True)
        return place
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None


def _unpack(path: Path, folder: Path) -> None:
    most = left = min(_LARGEST, max(_SMALL, _MOST_RATIO * path.stat().st_size))
    try:
        with zipfile.ZipFile(path) as held:
            members = [m for m in held.infolist() if not m.is_dir()]
            if len(members) > _MOST_FILES:
                raise FileFormatError(
                    f"over {_MOST_FILES} files", file=path, expected="a robot description in it"
                )
            for member in members:
                place = (folder / member.filename).resolve()
                if not place.is_relative_to(folder.resolve()) or "\\" in member.filename:
                    raise FileFormatError(
                        f"a file that leads out of it: {member.filename[:80]!r}",
                        file=path,
                        expected="a whole zip file",
                    )
                place.parent.mkdir(parents=True, exist_ok=True)
                with held.open(member) as source, place.open("wb") as target:
                    while piece := source.read(1 << 20):  # sizes that a zip states may be lies
                        left -= len(piece)
                        if left < 0:
                            raise FileFormatError(
                                f"grows to over {most // 10**6} MB",
                                file=path,
                                expected="a robot description in it",
                            )
                        target.write(piece)
    except (zipfile.BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError, ValueError) as error:
        raise FileFormatError(
            f"cannot be read ({type(error).__name__})", file=path, expected="a whole zip file"
        ) from None
