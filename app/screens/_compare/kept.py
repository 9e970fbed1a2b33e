"""What a session's Compare screen holds beyond a reload of the page: its files and the loaded recording."""

from __future__ import annotations

import shutil
import tempfile
import weakref
from collections import OrderedDict
from pathlib import Path

from app.diagnosis.model import SavedModel
from app.screens._compare.loaded import Loaded

_MOST = 24  # sessions whose recordings are kept


class Kept:
    """Files of one session, deleted with it, the recording that is shown, and the model somebody brought."""

    def __init__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="teachframe-"))
        self.loaded: Loaded | None = None
        self.urdf: Path | None = None
        self.model: SavedModel | None = None
        self.model_name = ""
        self._count = 0
        weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)

    def new_folder(self) -> Path:
        """An empty folder for what is dropped next."""
        self._count += 1
        folder = self.folder / str(self._count)
        folder.mkdir()
        return folder


_KEPT: OrderedDict[str, Kept] = OrderedDict()


def kept_for(session: str) -> Kept:
    """What is held for the session of this name."""
    kept = _KEPT.pop(session, None) or Kept()
    _KEPT[session] = kept
    while len(_KEPT) > _MOST:
        _KEPT.popitem(last=False)
    return kept
