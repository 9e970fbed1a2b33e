"""How the page looks and speaks to one browser: kept there, so that a reload or another session changes nothing."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from urllib.parse import unquote

from app.calibration.vocabularies import vocabularies
from app.geometry import CONVENTIONS
from app.texts import FALLBACK, languages


@dataclass(frozen=True)
class Look:
    """What an operator chose.

    Args:
        language: of all texts.
        vocabulary: key of the maker whose words are used; empty for none.
        convention: key of the angles shown.
        dark: dark colours.
    """

    language: str = FALLBACK
    vocabulary: str = ""
    convention: str = "ZYX"
    dark: bool = False

    def written(self) -> str:
        """As the browser keeps it."""
        return json.dumps(asdict(self))

    @classmethod
    def from_cookie(cls, text: str | None) -> Look:
        """The same as a cookie holds it."""
        return cls.read(unquote(text or ""))

    @classmethod
    def read(cls, text: str | None) -> Look:
        """What the browser kept; its own words are not trusted, so what is not known counts as not chosen."""
        try:
            kept = json.loads(text or "{}")
        except ValueError:
            kept = {}
        known = {
            "language": languages(),
            "vocabulary": ("", *vocabularies()),
            "convention": CONVENTIONS,
            "dark": (False, True),
        }
        kept = kept if isinstance(kept, dict) else {}
        good = {
            field.name: kept[field.name]
            for field in fields(cls)
            if isinstance(kept.get(field.name), str | bool) and kept[field.name] in known[field.name]
        }
        return cls(**good)
