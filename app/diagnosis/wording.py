"""What a diagnosis is said in, `words/en.toml` and `words/zh.toml`, and what engines remark in those words.

An engine's remark is its English sentence, for JSON and the terminal, and remembers what it was made of, for a page in
another language: `in_words(remark, "zh")`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.phrases import FALLBACK, Phrase, Said, Texts

__all__ = [
    "FALLBACK", "WORDS", "curve", "effect", "in_words", "joint_or_arm", "joints", "kind_name", "note", "reason",
    "remark_of_reasons", "smoothing_source",
]  # fmt: skip

#: One file a language.
WORDS = Texts(Path(__file__).parent / "words")


class _Named(Phrase):
    """A name that programs know: itself in English, put into words elsewhere."""

    def text(self, language: str = FALLBACK) -> str:
        return str(self.fields["name"]) if language == FALLBACK else super().text(language)


def _named(key: str, name: str) -> Phrase:
    return (
        _Named(WORDS, key, {"name": name})
        if WORDS.has(key)
        else Phrase(WORDS, "note.as_it_is", {"text": name})
    )


def note(key: str, /, **fields: Any) -> Said:
    """A remark of an engine's: the text `note.KEY`."""
    return Said(Phrase(WORDS, f"note.{key}", fields))


def reason(key: str, /, **fields: Any) -> Phrase:
    """Why a name is withheld: the text `withheld.KEY`."""
    return Phrase(WORDS, f"withheld.{key}", fields)


def effect(key: str) -> Phrase:
    """An effect in a remark: its key in English, its title elsewhere."""
    return _named(f"effect.{key}", key)


def curve(driver: str) -> Phrase:
    """What a free curve follows: `own angle`."""
    return _named(f"driver.{driver}", driver.replace("_", " "))


def joint_or_arm(joint: int | None) -> Phrase:
    """`joint 3`, counted from 1, or the whole arm."""
    return (
        Phrase(WORDS, "note.the_arm") if joint is None else Phrase(WORDS, "note.the_joint", {"joint": joint})
    )


def joints(numbers: list[int]) -> Phrase:
    """`joint 3` or `joints 3, 5`, counted from 1."""
    key = "note.the_joint" if len(numbers) == 1 else "note.the_joints"
    return Phrase(WORDS, key, {"joint": tuple(numbers)})


def kind_name(kind: str) -> Phrase:
    """A recording's kind."""
    return _named(f"page.kind.{kind}", kind)


def smoothing_source(source: str) -> Phrase:
    """What speeds are taken from: `recorded speed`, `position`."""
    return _named(f"source.{source.replace(' ', '_')}", source)


def remark_of_reasons(withheld: list[tuple[Phrase, Phrase, Phrase]]) -> tuple[Said, ...]:
    """One remark on all names that are withheld, each reason once.

    Args:
        withheld: effect, place and reason of each.
    """
    if len(withheld) < 2:
        return tuple(note("withheld", effect=e, place=p, why=why) for e, p, why in withheld)
    reasons: dict[str, list[tuple[Phrase, Phrase, Phrase]]] = {}
    for one in withheld:
        reasons.setdefault(str(one[2]), []).append(one)
    groups = tuple(
        Phrase(
            WORDS,
            "note.withheld_for",
            {
                "laws": tuple(Phrase(WORDS, "note.law_at", {"effect": e, "place": p}) for e, p, _ in group),
                "why": group[0][2],
            },
        )
        for group in reasons.values()
    )
    said = groups[0]
    for group in groups[1:]:
        said = Phrase(WORDS, "note.and_then", {"first": said, "then": group})
    return (note("withheld_together", count=len(withheld), laws=said),)


def in_words(sentence: str, language: str = FALLBACK) -> str:
    """A remark or a law in a language; as it is where it knows no other."""
    return sentence.phrase.text(language) if isinstance(sentence, Said) else sentence
