"""What a search or a given model says: verdict, the switch that puts it into the simulation, findings, notes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.pendant.screens._compare import cards, plots
from app.pendant.screens._compare.loaded import Loaded

if TYPE_CHECKING:
    from app.pendant.client import Pendant


class Outcome:
    """Cards and switches.

    Args:
        pendant: where they stand.
        put_in: called on the worker by the switch.
        next_poses: called on the worker with True to show the proposed poses.
    """

    def __init__(self, pendant: Pendant, put_in: Callable[[], None], next_poses: Callable[[bool], None]):
        self._pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        self._verdict = gui.add_html("", visible=False)
        self._judged = gui.add_html("", visible=False)
        self._apply = gui.add_button(t("compare.apply"), visible=False, hint=t("compare.apply_hint"))
        pendant.clicked(self._apply, put_in)
        self._findings = gui.add_html("", visible=False)
        self._next = gui.add_checkbox(t("compare.next"), False, visible=False, hint=t("compare.next_hint"))
        self._poses = gui.add_html("", visible=False)

        def toggled(on: bool) -> None:
            self._poses.visible = on
            next_poses(on)

        pendant.changed(self._next, "compare.next", toggled)
        self._bars = gui.add_html("", visible=False)
        self._notes_folder = gui.add_folder(t("compare.notes"), visible=False, expand_by_default=False)
        with self._notes_folder:
            self._notes = gui.add_html("")

    def show(self, loaded: Loaded) -> None:
        """Every card by what is known of the recording."""
        pendant, found = self._pendant, loaded.diagnosis
        self._verdict.visible = self._bars.visible = found is not None
        self._findings.visible = found is not None and bool(found.findings)
        self._judged.visible = loaded.judged is not None
        self._apply.visible = loaded.change is not None
        self._next.visible = found is not None and bool(found.next_poses)
        self._next.value = self._poses.visible = False
        self._notes_folder.visible = found is not None and bool(found.notes)
        self.switched(loaded.applied)
        if loaded.judged is not None:
            self._judged.content = cards.judged(pendant, loaded.judged)
        if found is not None:
            self._verdict.content = cards.verdict(pendant, found)
            self._findings.content = cards.findings(pendant, found)
            self._poses.content = cards.next_poses(pendant, loaded)
            self._bars.content = plots.bars(found, pendant.language)
            self._notes.content = cards.notes(pendant, found)

    def switched(self, on: bool) -> None:
        """What the switch would do now."""
        self._apply.label = self._pendant.t("compare.take_out" if on else "compare.apply")

    def hide(self) -> None:
        for widget in (
            self._verdict, self._judged, self._apply, self._findings, self._next, self._poses,
            self._bars, self._notes_folder,
        ):  # fmt: skip
            widget.visible = False
