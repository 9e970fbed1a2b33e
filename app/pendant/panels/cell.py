"""Which arm, which language, light or dark, and what is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.kinematics import robot_names
from app.pendant import html
from app.pendant.texts import languages
from app.session import SessionState
from app.session.actions import ChooseRobot
from app.session.state import robot_named

if TYPE_CHECKING:
    from app.kinematics import RobotModel
    from app.pendant.client import Pendant


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        self._robots = {self._title(robot_named(name)): name for name in robot_names()}
        self._robot = gui.add_dropdown(
            t("cell.robot"), tuple(self._robots), initial_value=self._title(pendant.model)
        )
        pendant.changed(self._robot, "robot", self._choose)
        gui.add_html(html.paragraph(self._facts(), faint=True, testid="robot-facts"))
        self._languages = {name: key for key, name in languages().items()}
        language = gui.add_dropdown(
            t("cell.language"), tuple(self._languages), initial_value=languages()[pendant.language]
        )
        pendant.changed(language, "language", self._speak)
        pendant.changed(gui.add_checkbox(t("cell.dark"), pendant.dark), "dark", self._dark)
        stage = pendant.stage
        if pendant.aids.handle:
            pendant.changed(gui.add_checkbox(t("cell.handle"), stage.show_handle), "handle", self._handle)
        pendant.changed(gui.add_checkbox(t("cell.marks"), stage.show_marks), "marks", self._marks)
        pendant.changed(
            gui.add_checkbox(t("cell.residuals"), stage.show_residuals), "residuals", self._residuals
        )
        name = pendant.session.name
        gui.add_html(
            html.paragraph(
                t("cell.session", name=name[:8]), faint=True, testid="session", style="margin-top:8px"
            )
        )

    def _title(self, robot: RobotModel) -> str:
        return robot.said("title", self._pendant.language)

    def _facts(self) -> str:
        robot = self._pendant.model
        about = robot.description
        return self._pendant.t(
            "cell.facts",
            maker=robot.said("maker", self._pendant.language),
            reach=f"{float(about.get('reach_m', robot.reach)):.2f}",
            load=f"{about.get('payload_kg', 0):g}",
            joints=robot.joint_count,
        )

    def _choose(self, title: str) -> None:
        pendant = self._pendant
        pendant.do(ChooseRobot(self._robots[title]))
        pendant.say("good", pendant.t("message.robot", title=self._title(pendant.model)))

    def _speak(self, name: str) -> None:
        pendant = self._pendant
        pendant.language = self._languages[name]
        pendant.rebuild()
        pendant.say("info", pendant.t("message.language"))

    def _dark(self, dark: bool) -> None:
        pendant = self._pendant
        pendant.dark = dark
        pendant.keep_look()
        pendant.layout.theme(dark)
        pendant.stage.floor(dark)

    def _handle(self, value: bool) -> None:
        self._pendant.stage.show_handle = value
        self._pendant.stage.refresh(self._pendant.session.state)

    def _marks(self, value: bool) -> None:
        self._pendant.stage.show_marks = value
        self._pendant.stage.refresh(self._pendant.session.state)

    def _residuals(self, value: bool) -> None:
        self._pendant.stage.show_residuals = value
        self._pendant.stage.refresh(self._pendant.session.state)

    def refresh(self, state: SessionState) -> None:
        title = self._title(self._pendant.model)
        if self._robot.value != title:
            self._robot.value = title

    def close(self) -> None:
        pass


class _Cell:
    key, order = "cell", 10

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


PANEL = _Cell()
