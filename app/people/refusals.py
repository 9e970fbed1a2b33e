"""Why a person is not let in, or may not do this: a sentence in English and Chinese."""

from __future__ import annotations

from typing import Any

from app.errors import PersonRefusedError
from app.phrases import Phrase
from app.texts import TEXTS


def refused(code: str, **details: Any) -> PersonRefusedError:
    """The error with the text `people.refused.CODE`."""
    said = Phrase(TEXTS, f"people.refused.{code}", details)
    return PersonRefusedError(code, str(said), said=said)
