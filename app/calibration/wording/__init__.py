"""What calibration says, in words of several languages: `en.toml`, `zh.toml`, keys only in the code.

check.KEY, check.KEY_do      what a check saw, and what to do next
refused.KEY, refused.KEY_do  why the points cannot determine the tool
name.CODE                    the short name of a warning's code
light, next, verify, page, sheet, …
"""

from __future__ import annotations

from pathlib import Path

from app.calibration.wording.family import Family
from app.phrases import FALLBACK, Phrase

__all__ = ["FALLBACK", "TEXTS", "Family", "Phrase", "degenerate", "name_of", "phrase", "remark"]

_FAMILY = Family(Path(__file__).parent)
TEXTS = _FAMILY.texts
phrase, remark, degenerate = _FAMILY.phrase, _FAMILY.remark, _FAMILY.degenerate


def name_of(code: str, language: str = FALLBACK) -> str:
    """The short name of a warning's code; the code itself where it has none."""
    key = f"name.{code}"
    return TEXTS.text(key, language) if TEXTS.has(key) else code.replace("_", " ")
