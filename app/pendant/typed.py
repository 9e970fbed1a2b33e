"""Numbers somebody types: the page hands on what stands in a field after each key, "1", "12", "120".

Measured with viser 1.1.1: fields and sliders alike send every value, at most one each 50 ms; leaving the field, and
whether a slider was dragged or its box typed into, are not said. viser's form says when Enter was pressed, but people
leave a field without Enter as often. So a value counts once it has rested or something else is done, and a slider that
is dragged is told from one that is typed at by how its values follow each other.
"""

from __future__ import annotations

RESTED = 0.4  # seconds after which what stands in a field is meant
_CLOSE = 0.25  # seconds between two values of one drag
_A_DRAG = 3  # values in a row


class Dragged:
    """Tells a drag: values close upon each other, none of which is the one before with a digit more or less."""

    def __init__(self):
        self._text, self._at, self._row = "", -float("inf"), 0

    def hears(self, value: float, now: float) -> bool:
        """True where `value`, heard at `now` [s], goes on with a drag."""
        text = f"{value:.10g}"
        typed = text.startswith(self._text) or self._text.startswith(text)
        goes_on = now - self._at <= _CLOSE and not typed
        self._row = self._row + 1 if goes_on else 1
        self._text, self._at = text, now
        return self._row >= _A_DRAG
