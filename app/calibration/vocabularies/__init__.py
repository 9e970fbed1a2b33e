"""The same modes in a maker's words: one file a vocabulary, found through its object `VOCABULARY`."""

from typing import cast

from app import catalog
from app.calibration.vocabularies._vocabulary import Vocabulary, Words

__all__ = ["Vocabulary", "Words", "vocabularies", "vocabulary"]


def vocabularies() -> dict[str, Vocabulary]:
    """All vocabularies by key."""
    return catalog.members(__name__, "VOCABULARY")


def vocabulary(key: str) -> Vocabulary:
    """One vocabulary.

    Raises:
        UnknownNameError: there is none of this key.
    """
    return cast(Vocabulary, catalog.member(__name__, "VOCABULARY", key, what="vocabulary"))
