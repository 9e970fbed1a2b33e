"""What is said of a recording while it is read, one file a language."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.phrases import Phrase, Texts

WORDS = Texts(Path(__file__).parent / "words")


def phrase(key: str, /, **fields: Any) -> Phrase:
    """A sentence of this family."""
    return Phrase(WORDS, key, fields)
