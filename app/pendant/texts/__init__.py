"""What the pendant says: one file a language, keys only in the code.

`en.toml` is complete; another language that lacks a key falls back to it. A text may hold `{name}` fields.
"""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import Any

FALLBACK = "en"
_FOLDER = Path(__file__).parent


def languages() -> dict[str, str]:
    """Language key -> its own name for itself."""
    return {path.stem: _texts(path.stem)["language.name"] for path in sorted(_FOLDER.glob("*.toml"))}


@cache
def _texts(language: str) -> dict[str, str]:
    """All texts of a language by dotted key."""
    path = _FOLDER / f"{language}.toml"
    if not path.is_file():
        return {}
    return dict(_flat("", tomllib.loads(path.read_text(encoding="utf-8"))))


def _flat(prefix: str, table: dict[str, Any]):
    for key, value in table.items():
        name = f"{prefix}.{key}" if prefix else key
        if isinstance(value, dict):
            yield from _flat(name, value)
        else:
            yield name, str(value)


def has_text(key: str, language: str) -> bool:
    """True where this very language has the text."""
    return key in _texts(language)


def text(key: str, language: str = FALLBACK, **details: Any) -> str:
    """The text of this key; raises KeyError where no language file has it."""
    found = _texts(language).get(key)
    if found is None:
        found = _texts(FALLBACK)[key]
    return found.format(**details) if details else found
