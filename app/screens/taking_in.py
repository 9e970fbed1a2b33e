"""Small files that somebody sends: looked at for their size, read in a process of their own, used on the worker."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.apart import SMALL, apart
from app.panel import Upload

if TYPE_CHECKING:
    from app.screens.context import Context

Around = Callable[[Callable[[], object]], object]


def take_small(
    context: Context,
    upload: Upload,
    most: int,
    read: Callable[[Path], Any],
    use: Callable[[Any], object],
    around: Around = lambda job: job(),
) -> None:
    """Reads a file of at most so many bytes, where nobody else sees it; it is not kept.

    Args:
        upload: the file.
        most: bytes.
        read: a function of a module, called in the other process with the file's path.
        use: called on the worker with what `read` returned.
        around: does that, and hears what was refused.
    """
    if upload.size > most:
        context.say("warning", context.t("message.too_large", name=upload.name))
        return
    folder = Path(tempfile.mkdtemp(prefix="teachframe-"))
    path = upload.into(folder, "file")

    def run() -> Any:
        try:
            return apart(read, path, bounds=SMALL)
        except Exception as error:
            return error
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def used(found: Any) -> None:
        if isinstance(found, Exception):
            raise found
        use(found)

    context.background(run, lambda found: around(lambda: used(found)))
