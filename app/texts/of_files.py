"""What readers of files say, in the operator's language: each sentence is known by its shape.

Readers say what was found and what was expected in English, one line for a terminal. `shapes/LANGUAGE.toml` holds each
such sentence with `{}` where the file's own words stand.
"""

from __future__ import annotations

import re
import tomllib
from functools import cache
from pathlib import Path

from app.errors import InputError

_FOLDER = Path(__file__).parent / "shapes"
_SPACE = re.compile(r"\{\}")


@cache
def shapes(language: str) -> dict[str, str]:
    """English shape -> what it says in a language, the longest first; empty where a language has none."""
    path = _FOLDER / f"{language}.toml"
    if not path.is_file():
        return {}
    found = tomllib.loads(path.read_text(encoding="utf-8"))
    return {shape: found[shape]["said"] for shape in sorted(found, key=len, reverse=True)}


@cache
def _patterns(language: str) -> tuple[tuple[re.Pattern[str], str], ...]:
    return tuple(
        (re.compile("(.+?)".join(map(re.escape, _SPACE.split(shape))), re.DOTALL), said)
        for shape, said in shapes(language).items()
    )


def sentence(said: str, language: str) -> str:
    """One such sentence in a language; as it is where its shape is not known."""
    for pattern, translation in _patterns(language):
        if match := pattern.fullmatch(said):
            return translation.format(*match.groups())
    return said


def parts(error: InputError, language: str) -> dict[str, str]:
    """What is wrong and what was expected, in a language."""
    return {
        "problem": sentence(error.problem, language),
        "expected": sentence(error.expected or "", language),
    }
