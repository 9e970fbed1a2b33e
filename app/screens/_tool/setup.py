"""Words, mode, number of touches, estimator: what is chosen once, folded into one line."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from app.calibration.tool import METHODS
from app.screens._tool.words import Words
from app.session import SessionState
from app.session.actions import ChooseMethod, ChooseMode
from app.session.state import mode_named

if TYPE_CHECKING:
    from app.screens.context import Context

_NAMED = ("joint", "pairwise", "robust")


class Setup:
    """A folded line with the mode as its title.

    Args:
        context: where it is shown.
        words: what modes are called.
    """

    def __init__(self, context: Context, words: Words):
        self._context, self._words = context, words
        ui, t, state = context.ui, context.t, context.session.state
        self._modes = words.modes()
        mode = mode_named(state.mode)
        title = next(title for title, key in self._modes.items() if key == mode.key)
        self._line = ui.add_folder(title, expanded=False)
        with self._line:
            makers = words.makers()
            chosen = next(title for title, key in makers.items() if key == context.vocabulary)
            maker = ui.add_choice(t("tool.words"), tuple(makers), value=chosen)
            context.changed(maker, "maker", lambda title: self._speak(makers[title]))
            self._mode = ui.add_choice(t("tool.mode"), tuple(self._modes), value=title)
            context.changed(self._mode, "mode", lambda title: self._chosen(ChooseMode(self._modes[title])))
            low, high = mode.least_touches, mode.most_touches
            self._touches = ui.add_number(
                t("tool.touches"), float(state.touches), low=float(low), high=float(high), step=1.0
            )
            context.changed(
                self._touches,
                "touches",
                lambda count: self._chosen(ChooseMode(context.session.state.mode, int(count))),
            )
            self._methods = {t(f"tool.method_{key}") if key in _NAMED else key: key for key in METHODS}
            label = self._method_label(state.method)
            self._method = ui.add_choice(t("tool.method"), tuple(self._methods), value=label)
            context.changed(
                self._method, "method", lambda label: context.do(ChooseMethod(self._methods[label]))
            )

    def refresh(self, state: SessionState) -> None:
        """Shows what is chosen; a result that waits for its decision leaves nothing to choose."""
        mode = mode_named(state.mode)
        title = next(title for title, key in self._modes.items() if key == mode.key)
        count = self._context.t("tool.line_touches", count=state.touches)
        self._line.label = title if not mode.most_touches else f"{title} · {count}"
        self._line.visible = state.result is None
        self._mode.value = title
        self._touches.min, self._touches.max = float(mode.least_touches), float(mode.most_touches)
        self._touches.value = float(state.touches)
        self._touches.visible = self._method.visible = mode.most_touches > 0
        self._method.value = self._method_label(state.method)

    def _speak(self, maker: str) -> None:
        """A maker's words and angles, on the whole page."""
        context = self._context
        context.look = replace(context.look, vocabulary=maker)
        words = self._words.vocabulary
        if words is not None:
            context.look = replace(context.look, convention=words.convention)
        context.rebuild()

    def _chosen(self, action: ChooseMode) -> None:
        context = self._context
        state = context.do(action)
        title = self._words.mode(mode_named(state.mode))
        key = "message.mode" if state.steps else "message.mode_direct"
        context.say("info", context.t(key, title=title, count=len(state.steps)))

    def _method_label(self, key: str) -> str:
        return next(label for label, method in self._methods.items() if method == key)
