"""What calibration says, in words of several languages: `en.toml`, `zh.toml`, keys only in the code.

check.KEY, check.KEY_do      what a check saw, and what to do next
refused.KEY, refused.KEY_do  why the points cannot determine the tool
name.CODE                    the short name of a warning's code
light, next, verify, page, sheet, …
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.calibration.result import Warning_
from app.errors import DegenerateGeometryError
from app.phrases import FALLBACK, Phrase, Texts

__all__ = ["FALLBACK", "TEXTS", "Phrase", "degenerate", "name_of", "phrase", "remark"]

TEXTS = Texts(Path(__file__).parent)


def phrase(key: str, /, **fields: Any) -> Phrase:
    """A sentence of calibration's that is not in words yet."""
    return Phrase(TEXTS, key, fields)


def remark(code: str, key: str = "", *, severe: bool = False, **fields: Any) -> Warning_:
    """A check's finding: the texts `check.KEY` and `check.KEY_do` with the same fields; `key` is the code's own
    where it is not given."""
    seen = phrase(f"check.{key or code}", **fields)
    todo = phrase(f"check.{key or code}_do", **fields)
    return Warning_(code, str(seen), str(todo), severe, phrases=(seen, todo))


def degenerate(
    code: str,
    key: str = "",
    *,
    kind: type[DegenerateGeometryError] = DegenerateGeometryError,
    rank: int,
    needed: int,
    unseen: str | None = None,
    **fields: Any,
) -> DegenerateGeometryError:
    """Points that cannot determine what is asked: the texts `refused.KEY` and `refused.KEY_do`."""
    seen = phrase(f"refused.{key or code}", **fields)
    todo = phrase(f"refused.{key or code}_do", **fields)
    return kind(
        str(seen),
        rank=rank,
        needed=needed,
        unseen=unseen,
        advice=str(todo),
        code=code,
        said=phrase("warning.said", seen=seen, todo=todo),
    )


def name_of(code: str, language: str = FALLBACK) -> str:
    """The short name of a warning's code; the code itself where it has none."""
    key = f"name.{code}"
    return TEXTS.text(key, language) if TEXTS.has(key) else code.replace("_", " ")
