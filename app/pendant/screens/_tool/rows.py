"""The list of the wizard: a row a point, with its state, record, go to, delete."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from app.calibration.captures import Step
from app.session import SessionState

if TYPE_CHECKING:
    from app.pendant.client import Pendant

#: What a row's buttons do: key of the button's text -> what happens with the step.
Jobs = dict[str, Callable[[Step], None]]


class Row:
    """One point of the list.

    Args:
        pendant: where it is shown.
        folder: the list.
        step: the point, in the operator's words.
        number: its place.
        jobs: "record", "go" and "delete".
    """

    def __init__(self, pendant: Pendant, folder: Any, step: Step, number: int, jobs: Jobs):
        self._pendant, self._folder, self._step, self._number = pendant, folder, step, number
        self._jobs = jobs
        self._recorded: bool | None = None
        self._group: Any = None

    def refresh(self, state: SessionState) -> None:
        """Shows whether the point is recorded."""
        recorded = self._step.key in state.captures
        if recorded == self._recorded:
            return
        self._recorded = recorded
        self.remove()
        t = self._pendant.t
        jobs = {t("tool.re_record" if recorded else "tool.record"): self._jobs["record"]}
        if recorded:
            jobs |= {t("tool.go"): self._jobs["go"], t("tool.delete"): self._jobs["delete"]}
        mark = "●" if recorded else "○"
        with self._folder:
            self._group = self._pendant.client.gui.add_button_group(
                f"{mark} {self._step.title}", tuple(jobs), order=float(self._number)
            )
        self._pendant.chosen(self._group, lambda label: jobs[label](self._step))

    def remove(self) -> None:
        """Takes the row away."""
        if self._group is not None:
            self._group.remove()
            self._group = None
