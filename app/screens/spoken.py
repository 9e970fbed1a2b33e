"""What was put into words lately, so that it can be put into another language's.

Words are made where something happens, in the operator's language, and handed on as words. Who chooses another
language finds the log in it all the same: each sentence is remembered with what it was made of.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from app.texts import text

_MOST = 1000  # sentences; a log has 200 lines, the names in them are a few words each

Line = tuple[float, str, str]  # when it was said, its level, its words
Again = Callable[[str], str]  # language -> the same in its words


class Spoken:
    """Remembers sentences; from any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._made: OrderedDict[str, Again] = OrderedDict()

    def text(self, key: str, language: str, fields: Mapping[str, Any]) -> str:
        """A text of the page, remembered with its fields."""
        words = text(key, language, **fields)
        self.remember(
            words, lambda other: text(key, other, **{k: self._field(v, other) for k, v in fields.items()})
        )
        return words

    def remember(self, words: str, again: Again) -> str:
        """Words that come from elsewhere, and how they are said in a language; gives the words."""
        with self._lock:
            self._made[words] = again
            self._made.move_to_end(words)
            if len(self._made) > _MOST:
                self._made.popitem(last=False)
        return words

    def said(self, words: str, language: str) -> str:
        """The same in this language; as they are where nobody knows any more what they were made of."""
        with self._lock:
            again = self._made.get(words)
        return words if again is None else self.remember(again(language), again)

    def lines(self, log: Sequence[Line], language: str) -> list[Line]:
        """A log in this language."""
        return [(when, level, self.said(words, language)) for when, level, words in log]

    def _field(self, value: Any, language: str) -> Any:
        return self.said(value, language) if isinstance(value, str) else value
