"""What is done with a result: report, model file, the practice cell; and what a simulated cell had hidden."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.diagnosis.model import SavedModel, model_of
from app.kinematics import robot_names
from app.screens._compare import cards
from app.screens._compare.giving import send_model, send_report, send_simulation
from app.screens._compare.loaded import Loaded
from app.session.actions import UseModel

if TYPE_CHECKING:
    from app.screens.context import Context

#: Keys of the simulators' formats, as `teachframe export-model --to` has them.
TARGETS = {
    "URDF (ROS, PyBullet)": "urdf",
    "MJCF (MuJoCo)": "mjcf",
    "SDF (Gazebo)": "sdf",
    "USD (Isaac Sim)": "usd",
}


class Taking:
    """The folder of what an operator takes away.

    Args:
        context: where it stands.
        loaded: gives the recording, or None.
        used: called on the worker with a model that went into the practice cell.
    """

    def __init__(
        self, context: Context, loaded: Callable[[], Loaded | None], used: Callable[[SavedModel, str], None]
    ):
        self._context, self._loaded, self._used = context, loaded, used
        ui, t = context.ui, context.t
        self.folder = ui.add_folder(t("compare.give"), visible=False)
        with self.folder:
            self._report = ui.add_button(t("compare.report"))
            context.clicked(self._report, lambda: send_report(context, loaded()))
            self._model = ui.add_button(t("compare.model"), rank="plain")
            context.clicked(self._model, lambda: send_model(context, loaded()))
            self._form = ui.add_choice(t("compare.simulator"), tuple(TARGETS))
            self._simulation = ui.add_button(
                t("compare.simulation"), rank="plain", hint=t("compare.simulation_hint")
            )
            context.clicked(
                self._simulation, lambda: send_simulation(context, loaded(), TARGETS[self._form.value])
            )
            self._cell = ui.add_button(t("compare.to_cell"), rank="plain", hint=t("compare.to_cell_hint"))
            context.clicked(self._cell, self._into_cell)
            self._reveal = ui.add_button(t("compare.reveal"), rank="plain")
            context.clicked(self._reveal, self._show_truth)
            self._truth = ui.add_html("")

    def show(self, loaded: Loaded) -> None:
        found = loaded.diagnosis
        model = found is not None and bool(found.model)
        self._report.visible, self._model.visible = found is not None, model
        # Where what was found can be put into the simulation, that key stands out, and it stands above.
        self._report.rank = "main" if loaded.change is None else "plain"
        self._form.visible = self._simulation.visible = model
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
        self._context.do(UseModel(model))
        self._used(model, f"{loaded.path.stem}.model.json")
        self._context.say("good", self._context.t("compare.in_cell"))

    def _show_truth(self) -> None:
        loaded = self._loaded()
        if loaded is not None:
            self._truth.content = cards.truth(self._context, loaded.truth)
