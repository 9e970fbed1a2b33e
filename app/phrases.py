"""Sentences in several languages: one folder of TOML files a family, one file a language, keys only in the code.

A `Phrase` is what code hands on instead of a finished sentence: a key and its fields, put into words where it is
read, in the reader's language. Fields may be phrases themselves, or tuples of them (joined as the language lists
things). `en.toml` is complete; what another language lacks comes in English.

    phrase = Phrase(TEXTS, "check.bumped.missed", {"number": 4, "size": 2.1})
    str(phrase), phrase.text("zh")
"""

from __future__ import annotations

import tomllib
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from app.figures import unsigned

FALLBACK = "en"
#: Key of the text that joins several phrases of one field.
_BETWEEN = "list.between"


class Texts:
    """All sentences of one family.

    Args:
        folder: holds `en.toml` and its translations.
    """

    def __init__(self, folder: Path):
        self._folder = folder

    @cached_property
    def languages(self) -> dict[str, dict[str, str]]:
        """Language -> dotted key -> text."""
        return {
            path.stem: dict(_flat("", tomllib.loads(path.read_text(encoding="utf-8"))))
            for path in sorted(self._folder.glob("*.toml"))
        }

    def has(self, key: str, language: str = FALLBACK) -> bool:
        """True where this very language has the text."""
        return key in self.languages.get(language, {})

    def text(self, key: str, language: str = FALLBACK, /, **fields: Any) -> str:
        """The text of this key with its fields put in; raises KeyError where no language has it."""
        found = self.languages.get(language, {}).get(key)
        if found is None:
            found = self.languages[FALLBACK][key]
        if not fields:
            return found
        worded = {name: self._worded(value, language) for name, value in fields.items()}
        return unsigned(found.format(**worded))

    def _worded(self, value: Any, language: str) -> Any:
        if isinstance(value, Phrase):
            return value.text(language)
        if isinstance(value, tuple):
            between = self.text(_BETWEEN, language) if self.has(_BETWEEN) else ", "
            return between.join(str(self._worded(part, language)) for part in value)
        return value


@dataclass(frozen=True)
class Phrase:
    """A sentence that is not in words yet.

    Args:
        texts: the family it belongs to.
        key: of its text.
        fields: what the text names; numbers are formatted by the text.
    """

    texts: Texts
    key: str
    fields: Mapping[str, Any] = field(default_factory=dict)

    def text(self, language: str = FALLBACK) -> str:
        """The sentence in a language."""
        return self.texts.text(self.key, language, **self.fields)

    def __str__(self) -> str:
        return self.text()


class Said(str):
    """A phrase in its English words, for lists that go into JSON as they are and onto pages in any language."""

    phrase: Phrase

    def __new__(cls, phrase: Phrase) -> Said:
        self = super().__new__(cls, phrase.text())
        self.phrase = phrase
        return self

    def __getnewargs__(self) -> tuple[Phrase]:  # type: ignore[override]
        return (self.phrase,)


def padded(text: str, width: int) -> str:
    """Spaces to the left up to a width in columns, or to the right where it is negative: Chinese takes two each."""
    gap = " " * (abs(width) - sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text))
    return text + gap if width < 0 else gap + text


def _flat(prefix: str, table: dict[str, Any]) -> Iterator[tuple[str, str]]:
    for key, value in table.items():
        name = f"{prefix}.{key}" if prefix else key
        if isinstance(value, dict):
            yield from _flat(name, value)
        else:
            yield name, str(value)
