"""What a search or a given model says: verdict, the switch that puts it into the simulation, findings, notes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.screens._compare import cards, plots
from app.screens._compare.loaded import Loaded

if TYPE_CHECKING:
    from app.screens.context import Context


class Outcome:
    """Cards and switches.

    Args:
        context: where they stand.
        put_in: called on the worker by the switch.
        next_poses: called on the worker with True to show the proposed poses.
    """

    def __init__(self, context: Context, put_in: Callable[[], None], next_poses: Callable[[bool], None]):
        self._context = context
        ui, t = context.ui, context.t
        self._verdict = ui.add_html("", visible=False)
        # What is done next stands under the verdict; why, below it, is longer than most windows.
        self._apply = ui.add_button(t("compare.apply"), visible=False, hint=t("compare.apply_hint"))
        context.clicked(self._apply, put_in)
        self._budget = ui.add_html("", visible=False)
        self._judged = ui.add_html("", visible=False)
        self._findings = ui.add_html("", visible=False)
        self._next = ui.add_check(t("compare.next"), False, visible=False, hint=t("compare.next_hint"))
        self._poses = ui.add_html("", visible=False)

        def toggled(on: bool) -> None:
            self._poses.visible = on
            next_poses(on)

        context.changed(self._next, "compare.next", toggled)
        self._bars = ui.add_html("", visible=False)
        self._notes_folder = ui.add_folder(t("compare.notes"), visible=False, expanded=False)
        with self._notes_folder:
            self._notes = ui.add_html("")

    def show(self, loaded: Loaded) -> None:
        """Every card by what is known of the recording."""
        context, found = self._context, loaded.diagnosis
        self._verdict.visible = self._bars.visible = found is not None
        self._findings.visible = found is not None and bool(found.findings)
        self._judged.visible = loaded.judged is not None
        self._apply.visible = loaded.change is not None
        self._next.visible = found is not None and bool(found.next_poses)
        self._next.value = self._poses.visible = False
        self._notes_folder.visible = found is not None and bool(found.notes)
        self.switched(loaded.applied)
        if loaded.judged is not None:
            self._judged.content = cards.judged(context, loaded.judged)
        self._budget.visible = found is not None and bool(found.families)
        if found is not None:
            self._budget.content = plots.share_of_families(found, context.language)
            self._verdict.content = cards.verdict(context, found)
            self._findings.content = cards.findings(context, found)
            self._poses.content = cards.next_poses(context, loaded)
            self._bars.content = plots.bars(found, context.language)
            self._notes.content = cards.notes(context, found)

    def switched(self, on: bool) -> None:
        """What the switch would do now; taking out again is nothing that has to come next."""
        self._apply.rank = "plain" if on else "main"
        self._apply.label = self._context.t("compare.take_out" if on else "compare.apply")

    def hide(self) -> None:
        for widget in (
            self._verdict, self._budget, self._judged, self._apply, self._findings, self._next, self._poses,
            self._bars, self._notes_folder,
        ):  # fmt: skip
            widget.visible = False
