"""What is done with a result: report, model file, the practice cell; and what a simulated cell had hidden."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.diagnosis.model import SavedModel, model_of
from app.kinematics import robot_names
from app.pendant.screens._compare import cards
from app.pendant.screens._compare.giving import send_model, send_report
from app.pendant.screens._compare.loaded import Loaded
from app.session.actions import UseModel

if TYPE_CHECKING:
    from app.pendant.client import Pendant


class Taking:
    """The folder of what an operator takes away.

    Args:
        pendant: where it stands.
        loaded: gives the recording, or None.
        used: called on the worker with a model that went into the practice cell.
    """

    def __init__(
        self, pendant: Pendant, loaded: Callable[[], Loaded | None], used: Callable[[SavedModel, str], None]
    ):
        self._pendant, self._loaded, self._used = pendant, loaded, used
        gui, t = pendant.client.gui, pendant.t
        self.folder = gui.add_folder(t("compare.give"), visible=False)
        with self.folder:
            self._report = gui.add_button(t("compare.report"))
            pendant.clicked(self._report, lambda: send_report(pendant, loaded()))
            self._model = gui.add_button(t("compare.model"), color="gray")
            pendant.clicked(self._model, lambda: send_model(pendant, loaded()))
            self._cell = gui.add_button(t("compare.to_cell"), color="gray", hint=t("compare.to_cell_hint"))
            pendant.clicked(self._cell, self._into_cell)
            self._reveal = gui.add_button(t("compare.reveal"), color="gray")
            pendant.clicked(self._reveal, self._show_truth)
            self._truth = gui.add_html("")

    def show(self, loaded: Loaded) -> None:
        found = loaded.diagnosis
        model = found is not None and bool(found.model)
        self._report.visible, self._model.visible = found is not None, model
        self._cell.visible = model and not loaded.moving and loaded.robot.name in robot_names()
        self._reveal.visible = bool(loaded.truth)
        self._truth.content = ""
        self.folder.visible = found is not None or bool(loaded.truth)

    def hide(self) -> None:
        self.folder.visible = False

    def _into_cell(self) -> None:
        loaded = self._loaded()
        if loaded is None or loaded.diagnosis is None:
            return
        model = model_of(loaded.diagnosis)
        self._pendant.do(UseModel(model))
        self._used(model, f"{loaded.path.stem}.model.json")
        self._pendant.say("good", self._pendant.t("compare.in_cell"))

    def _show_truth(self) -> None:
        loaded = self._loaded()
        if loaded is not None:
            self._truth.content = cards.truth(self._pendant, loaded.truth)
