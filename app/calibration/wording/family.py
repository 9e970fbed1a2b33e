"""One folder of texts that checks and refusals of calibration speak from."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.calibration.result import Warning_
from app.errors import ActionRefusedError, DegenerateGeometryError
from app.phrases import Phrase, Texts


class Family:
    """What makes phrases, findings and refusals of one folder's texts.

    Args:
        folder: holds `en.toml` and its translations.
    """

    def __init__(self, folder: Path):
        self.texts = Texts(folder)

    def phrase(self, key: str, /, **fields: Any) -> Phrase:
        """A sentence that is not in words yet."""
        return Phrase(self.texts, key, fields)

    def remark(
        self, code: str, key: str = "", *, severe: bool = False, note: bool = False, **fields: Any
    ) -> Warning_:
        """A check's finding: the texts `check.KEY` and `check.KEY_do` with the same fields; `key` is the code's own
        where it is not given."""
        seen = self.phrase(f"check.{key or code}", **fields)
        todo = self.phrase(f"check.{key or code}_do", **fields)
        return Warning_(code, str(seen), str(todo), severe, note=note, phrases=(seen, todo))

    def degenerate(
        self,
        code: str,
        key: str = "",
        *,
        kind: type[DegenerateGeometryError] = DegenerateGeometryError,
        rank: int | None = None,
        needed: int | None = None,
        unseen: str | None = None,
        **fields: Any,
    ) -> DegenerateGeometryError:
        """Points that cannot determine what is asked: the texts `refused.KEY` and, where it is there, `refused.KEY_do`.

        `needed` is a field of both.
        """
        fields = {**fields, "needed": needed}
        seen = said = self.phrase(f"refused.{key or code}", **fields)
        todo = None
        if self.texts.has(f"refused.{key or code}_do"):
            todo = self.phrase(f"refused.{key or code}_do", **fields)
            said = self.phrase("warning.said", seen=seen, todo=todo)
        return kind(
            str(seen),
            rank=rank,
            needed=needed,
            unseen=unseen,
            advice=None if todo is None else str(todo),
            code=code,
            said=said,
        )

    def refused(self, key: str, /, **fields: Any) -> ActionRefusedError:
        """An action that cannot be done now: the text `refused.KEY`."""
        said = self.phrase(f"refused.{key}", **fields)
        return ActionRefusedError(str(said), said=said)
