"""What the pendant says: one file a language, keys only in the code.

`en.toml` is complete; another language that lacks a key falls back to it. A text may hold `{name}` fields, which may
be phrases of other parts of the program.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.errors import TeachframeError
from app.phrases import FALLBACK, Phrase, Texts

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
    """What an error says, in this language where it can."""
    key = f"refused.{getattr(error, 'code', '')}"
    if has_text(key, language):
        return text(key, language, **getattr(error, "details", {}))
    said = getattr(error, "said", None)
    return said.text(language) if isinstance(said, Phrase) else str(error)
