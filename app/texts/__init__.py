"""What the pendant says: one file a language, keys only in the code; `of_files.py` what readers of files say.

`en.toml` is complete; another language that lacks a key falls back to it. A text may hold `{name}` fields, which may
be phrases of other parts of the program.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.errors import InputError, TeachframeError
from app.phrases import FALLBACK, Phrase, Texts
from app.texts.of_files import parts

__all__ = ["FALLBACK", "TEXTS", "error_text", "has_text", "languages", "text"]

TEXTS = Texts(Path(__file__).parent)


def languages() -> dict[str, str]:
    """Language key -> its own name for itself."""
    return {language: texts["language.name"] for language, texts in TEXTS.languages.items()}


def has_text(key: str, language: str) -> bool:
    """True where this very language has the text."""
    return TEXTS.has(key, language)


def text(key: str, language: str = FALLBACK, **details: Any) -> str:
    """The text of this key; raises KeyError where no language file has it."""
    return TEXTS.text(key, language, **details)


def error_text(error: TeachframeError, language: str = FALLBACK) -> str:
    """What an error says, in this language where it can; a file by its name alone, not by where it lies."""
    key = f"refused.{getattr(error, 'code', '')}"
    if has_text(key, language):
        return text(key, language, **getattr(error, "details", {}))
    if isinstance(error, InputError):
        return _of_file(error, language)
    said = getattr(error, "said", None)
    return said.text(language) if isinstance(said, Phrase) else str(error)


def _of_file(error: InputError, language: str) -> str:
    """Where, what is wrong, what was expected."""
    where = {"file": error.file and Path(error.file).name, "row": error.row, "column": error.column}
    place = tuple(
        Phrase(TEXTS, f"files.{name}", {name: value}) for name, value in where.items() if value is not None
    )
    said = parts(error, language)
    key = ("at_" if place else "") + ("expected" if said["expected"] else "problem")
    return text(f"files.{key}", language, place=place, **said)
