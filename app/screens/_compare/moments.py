"""Which row is shown: a slider over the rows, or over the time of a log, which also plays."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from app.screens._compare import cards
from app.screens._compare.loaded import Loaded

if TYPE_CHECKING:
    from app.screens.context import Context

_PLAY_S = (4.0, 20.0)  # a log is played in real time within these bounds
_STEP_S = 0.01
_SLOT = "compare.play"


class Moments:
    """Sliders, what the shown row says, and the play button.

    Args:
        context: where they stand.
        moved: called on the worker when another row is shown; True while the log plays.
    """

    def __init__(self, context: Context, moved: Callable[[bool], None]):
        self._context, self._moved = context, moved
        self.index = 0
        self._loaded: Loaded | None = None
        ui, t = context.ui, context.t
        self._row = ui.add_slider(t("compare.row"), 1.0, 2.0, 1.0, 1.0, visible=False)
        context.changed(self._row, "compare.row", lambda value: self._to(int(value) - 1))
        self._time = ui.add_slider(t("compare.time"), 0.0, 1.0, _STEP_S, 0.0, visible=False)
        context.changed(self._time, "compare.time", self._to_time)
        self._text = ui.add_html("", visible=False)
        self._play = ui.add_button(t("compare.play"), visible=False, rank="plain")
        context.clicked(self._play, self._play_or_pause)

    @property
    def below(self) -> float:
        """A place right below the sliders, in the order of the panel."""
        return self._play.order + 0.5

    def show(self, loaded: Loaded, index: int) -> None:
        """The sliders of this recording, at one of its rows."""
        self._loaded, self.index = loaded, min(max(index, 0), loaded.count - 1)
        self._row.max = float(max(loaded.count, 2))
        if loaded.moving:
            self._time.max = max(round(loaded.seconds, 2), _STEP_S)
        self._row.visible, self._time.visible = not loaded.moving, loaded.moving
        self._text.visible, self._play.visible = True, loaded.moving
        self._set_sliders()

    def hide(self) -> None:
        """Nothing is loaded."""
        self.stop()
        self._loaded = None
        for widget in (self._row, self._time, self._text, self._play):
            widget.visible = False

    def say(self, loaded: Loaded, share: float) -> None:
        """What is known of the shown row; `share` of the way from before (0) to after (1)."""
        self._loaded = loaded
        self._text.content = cards.row(self._context, loaded, self.index, share)

    def stop(self) -> None:
        """A log that plays stands still."""
        self._context.worker.halt(_SLOT)
        self._play.label = self._context.t("compare.play")

    def _to(self, index: int) -> None:
        self.stop()
        self.index = index
        self._moved(False)

    def _to_time(self, seconds: float) -> None:
        if self._loaded is not None:
            self._to(self._loaded.index_at(seconds))

    def _set_sliders(self) -> None:
        self._row.value = float(self.index + 1)
        if self._loaded is not None and self._loaded.moving:
            self._time.value = round(self._loaded.moment(self.index), 2)

    def _play_or_pause(self) -> None:
        if self._context.worker.running(_SLOT):
            self.stop()
            return
        self._play.label = self._context.t("compare.pause")
        self._context.worker.animate(_SLOT, self._playing())

    def _playing(self) -> Iterator[None]:
        loaded = self._loaded
        if loaded is None or not loaded.moving:
            return
        first = 0.0 if self.index >= loaded.count - 1 else loaded.moment(self.index)
        span = loaded.seconds - first
        lasts = min(max(span, _PLAY_S[0]), _PLAY_S[1])
        begun = time.monotonic()
        while (passed := (time.monotonic() - begun) / lasts) < 1.0:
            self.index = loaded.index_at(first + passed * span)
            self._set_sliders()
            self._moved(True)
            yield
        self.index = loaded.count - 1
        self._set_sliders()
        self._play.label = self._context.t("compare.play")
        self._moved(False)
