"""Uploads and downloads: one file a request, written to the disk as it comes, refused where it is too large."""

from __future__ import annotations

import asyncio
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from app.panel import Upload
from app.panel.uploads import safe_name
from app.people.bulk import Bulk
from app.people.limits import DROPS, UPLOADED
from app.people.tries import Tries
from app.shell.security import HEADERS
from app.workers.live import Live

LARGEST = 400_000_000  # bytes somebody may send at once
_MOST_FILES = 2_000  # in one drop
_NAME = 64  # characters of a drop's name


class Drops:
    """What is being sent by one process's pages: the files of a drop come one by one, then the drop is handed over.

    A person's pages are all of one process, which has his session: so many drops at once hold for him anywhere. The
    bytes of an hour are counted in the database, because his session may come to another process.

    Args:
        tries: the database's counts.
    """

    def __init__(self, tries: Tries):
        self._folder = Path(tempfile.mkdtemp(prefix="teachframe-uploads-"))
        self._folder.chmod(0o700)
        self._drops: dict[tuple[str, str], tuple[Path, list[Upload]]] = {}
        self._sent = Bulk(tries, UPLOADED)

    def close(self) -> None:
        """Takes everything away."""
        shutil.rmtree(self._folder, ignore_errors=True)

    async def take(self, request: Request, live: Live, owner: str) -> Response:
        """PUT /upload/WIDGET/DROP?name=…&folder=…&last=1, the file as its body, of whom the owner string says."""
        number, drop = int(request.path_params["widget"]), request.path_params["drop"]
        if not drop.isalnum() or len(drop) > _NAME or not live.context.ui.takes_files(number):
            return PlainTextResponse("nothing is taken here", 404, HEADERS)
        length = request.headers.get("content-length", "")
        size = int(length) if length.isdigit() else LARGEST
        if not await asyncio.to_thread(self._sent.count, owner, size):
            return PlainTextResponse("too much in an hour", 429, HEADERS)
        key = (owner, drop)
        if key not in self._drops:  # a folder of its own: two persons may call their drops the same
            await self._make_room(owner)
            self._drops[key] = Path(tempfile.mkdtemp(dir=self._folder)), []
        folder, files = self._drops[key]
        path = folder / str(len(files))
        left = LARGEST - sum(file.size for file in files)
        if len(files) >= _MOST_FILES or not await _write(request, path, left):
            self._drops.pop(key, None)
            await asyncio.to_thread(_gone(folder))
            return PlainTextResponse("too large", 413, HEADERS)
        name = safe_name(request.query_params.get("name", ""))
        files.append(Upload(name or "file", path, request.query_params.get("folder", "")))
        if request.query_params.get("last") == "1":
            del self._drops[key]
            live.context.ui.hear_files(number, files, _gone(folder))
        return PlainTextResponse("", 204, HEADERS)

    async def _make_room(self, owner: str) -> None:
        """Forgets the oldest drops of a person: their page went away before they were whole."""
        mine = [key for key in self._drops if key[0] == owner]
        for key in mine[: max(0, len(mine) - DROPS + 1)]:
            folder, _ = self._drops.pop(key)
            await asyncio.to_thread(_gone(folder))


def download(token: str, live: Live) -> Response:
    """GET /download/TOKEN: a file, once, never shown as a page of ours."""
    found = live.fetch(token)
    if found is None:
        return PlainTextResponse("not here any more", 404, HEADERS)
    headers = {
        **HEADERS,
        "Content-Disposition": f"attachment; filename*=UTF-8''{quote(found.name)}",
        "Content-Security-Policy": "default-src 'none'; sandbox",
        "Cache-Control": "no-store",
    }
    return Response(found.content, media_type="application/octet-stream", headers=headers)


def _gone(folder: Path) -> Callable[[], None]:
    return lambda: shutil.rmtree(folder, ignore_errors=True)


async def _write(request: Request, path: Path, most: int) -> bool:
    with path.open("wb") as out:
        async for piece in request.stream():
            most -= len(piece)
            if most < 0:
                return False
            out.write(piece)
    return True
