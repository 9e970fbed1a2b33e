"""The result: shown, accepted or cancelled; then the turn about it; export and report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.pendant.screens._tool.giving import send_frame, send_report
from app.pendant.screens._tool.result import light_html, result_html
from app.pendant.screens._tool.verifying import Verifying
from app.pendant.screens._tool.words import Words
from app.session import SessionState
from app.session.actions import Accept, Cancel
from app.session.state import accepted

if TYPE_CHECKING:
    from app.pendant.client import Pendant


class Deciding:
    """A folder, visible while there is a result.

    Args:
        pendant: where it is shown.
    """

    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        self._folder = gui.add_folder(t("tool.result"), visible=False)
        with self._folder:
            self.light = gui.add_html("")
            number = len(pendant.session.state.tools) + 1
            self._name = gui.add_text(t("tool.name"), t("tool.first_name", number=number))
            self._decide = gui.add_button_group(t("tool.decide"), (t("tool.accept"), t("tool.cancel")))
            self._again = gui.add_button_group(
                t("tool.then"), (t("tool.verify"), t("tool.again")), visible=False
            )
            self.verifying = Verifying(pendant)
            self.page = gui.add_html("")
            self._formats = Words(pendant).formats()
            self._format = gui.add_dropdown(t("tool.format"), tuple(self._formats))
            give = gui.add_button_group(t("tool.give"), (t("tool.export"), t("tool.report")))
        decide = {t("tool.accept"): self.accept, t("tool.cancel"): self._cancel}
        pendant.chosen(self._decide, lambda label: decide[label]())
        then = {t("tool.verify"): self.verifying.run, t("tool.again"): self._cancel}
        pendant.chosen(self._again, lambda label: then[label]())
        gives = {
            t("tool.export"): lambda: send_frame(pendant, self._formats[self._format.value], self._tool_name),
            t("tool.report"): lambda: send_report(pendant, self._tool_name),
        }
        pendant.chosen(give, lambda label: gives[label]())

    def accept(self) -> None:
        """The result becomes the active tool, under the name in the field."""
        pendant = self._pendant
        state = pendant.do(Accept(self._name.value))
        if state.tool is not None:
            pendant.stage.view("whole")
            pendant.say("good", pendant.t("message.accepted", name=state.tool.name))

    def refresh(self, state: SessionState) -> None:
        """Shows the result, with what can be done with it next."""
        taken = accepted(state)
        self._folder.visible = state.result is not None
        self._name.visible = self._decide.visible = not taken
        self._again.visible = taken
        self.verifying.refresh(state)
        if state.result is not None:
            self.light.content = light_html(state.result, self._pendant.language)
            self.page.content = result_html(self._pendant, state.result)

    def numbers(self) -> None:
        """The arm moved."""
        self.verifying.numbers()

    @property
    def _tool_name(self) -> str:
        state = self._pendant.session.state
        return state.tool.name if state.tool is not None and accepted(state) else self._name.value

    def _cancel(self) -> None:
        pendant = self._pendant
        pendant.do(Cancel())
        pendant.stage.view("whole")
        self._name.value = pendant.t("tool.first_name", number=len(pendant.session.state.tools) + 1)
        pendant.say("info", pendant.t("message.cancelled"))
