"""The result: shown, accepted or cancelled; then the turn about it; under the points, export and report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.screens._tool.giving import send_frame, send_report
from app.screens._tool.result import light_html, result_html
from app.screens._tool.verifying import Verifying
from app.screens._tool.words import Words
from app.session import SessionState
from app.session.actions import Accept, Cancel
from app.session.state import accepted

if TYPE_CHECKING:
    from app.screens.context import Context


class Deciding:
    """A folder, visible while there is a result.

    Args:
        context: where it is shown.
    """

    def __init__(self, context: Context):
        self._context = context
        ui, t = context.ui, context.t
        self._folder = ui.add_folder(t("tool.result"), visible=False)
        with self._folder:
            self.light = ui.add_html("")
            # Right under the verdict: under an exercise's task, too, it is in view.
            self._decide = ui.add_buttons(
                t("tool.decide"), (t("tool.accept"), t("tool.cancel")), visible=False, rank="main"
            )
            number = len(context.session.state.tools) + 1
            self._name = ui.add_text(t("tool.name"), t("tool.first_name", number=number))
            self._again = ui.add_buttons(
                t("tool.then"), (t("tool.verify"), t("tool.again")), visible=False, rank="main"
            )
            self.verifying = Verifying(context, self._say_next)
            self.page = ui.add_html("")
        self._doubted: object = None  # a result that the light warned of, and that was to be accepted once
        decide = {t("tool.accept"): self.accept, t("tool.sure"): self.accept, t("tool.cancel"): self._cancel}
        context.chosen(self._decide, lambda label: decide[label]())
        self._then = {t("tool.verify"): self.verifying.run, t("tool.again"): self._cancel}
        context.chosen(self._again, lambda label: self._then[label]())

    def take_away(self) -> None:
        """Export and report, where the caller has come to: who looks at a verdict wants its points beside it first."""
        context, ui, t = self._context, self._context.ui, self._context.t
        formats = Words(context).formats()
        self._away = ui.add_folder(t("tool.away"), visible=False)
        with self._away:
            form = ui.add_choice(t("tool.format"), tuple(formats))
            give = ui.add_buttons(t("tool.give"), (t("tool.export"), t("tool.report")))
        gives = {
            t("tool.export"): lambda: send_frame(context, formats[form.value], self._tool_name),
            t("tool.report"): lambda: send_report(context, self._tool_name),
        }
        context.chosen(give, lambda label: gives[label]())

    def accept(self) -> None:
        """The result becomes the active tool, under the name in the field."""
        context, t = self._context, self._context.t
        result = context.session.state.result
        if result is not None and result.light.colour == "red" and self._doubted is not result:
            self._doubted = result
            self._decide.options = (t("tool.sure"), t("tool.cancel"))
            context.say("warning", t("message.calculated_red"))
            return
        state = context.do(Accept(self._name.value))
        if state.tool is not None:
            context.stage.view("whole")
            context.say("good", context.t("message.accepted", name=state.tool.name))

    def refresh(self, state: SessionState) -> None:
        """Shows the result, with what can be done with it next."""
        taken = accepted(state)
        self._folder.visible = self._away.visible = state.result is not None
        self._name.visible = self._decide.visible = state.result is not None and not taken
        self._again.visible = taken
        self.verifying.refresh(state)
        if state.result is not self._doubted:
            self._doubted = None
            self._decide.options = (self._context.t("tool.accept"), self._context.t("tool.cancel"))
        if state.result is not None:
            self.page.content = result_html(self._context, state.result)
        self._say_next()

    def _say_next(self) -> None:
        """The light's line says what is next now: once accepted that is the turn, and after the turn what it showed."""
        context, good = self._context, self.verifying.good
        state, t = context.session.state, context.t
        if state.result is None:
            return
        words = ""
        if accepted(state):
            if good is None:
                words = t("tool.then_finish" if state.running is not None else "tool.then_verify")
            elif good:
                words = t("tool.then_finish_only" if state.running is not None else "tool.then_use")
            else:
                words = t("tool.then_again")
        self.light.content = light_html(state.result, context.language, words)
        # The key that was pressed and has shown that all is well is not the next one any more.
        self._again.rank = "plain" if good else "main"
        verify, again = self._then
        self._again.options = (again, verify) if good is False else (verify, again)

    def numbers(self) -> None:
        """The arm moved."""
        self.verifying.numbers()

    @property
    def _tool_name(self) -> str:
        state = self._context.session.state
        return state.tool.name if state.tool is not None and accepted(state) else self._name.value

    def _cancel(self) -> None:
        context = self._context
        context.do(Cancel())
        context.stage.view("whole")
        self._name.value = context.t("tool.first_name", number=len(context.session.state.tools) + 1)
        context.say("info", context.t("message.cancelled"))
