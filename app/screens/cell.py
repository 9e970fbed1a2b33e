"""Setup: which arm, what is drawn, the angles' convention, the user frame."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from app.kinematics import RobotModel, robot_names
from app.panel import markup as html
from app.screens._cell.own_arm import OwnArm
from app.screens._cell.user import UserFrame
from app.screens._tool.words import Words
from app.session import SessionState
from app.session.actions import ChooseRobot
from app.session.state import robot_named

if TYPE_CHECKING:
    from app.screens.context import Context


class _View:
    def __init__(self, context: Context):
        self._context = context
        ui, t, stage = context.ui, context.t, context.stage
        self._robots = {self._title(robot_named(name)): name for name in robot_names()}
        own = OwnArm.titles_of(context)
        self._robots |= {title if title not in self._robots else name: name for title, name in own.items()}
        self._robots.setdefault(self._title(context.model), context.session.state.robot)
        self._robot = ui.add_choice(t("cell.robot"), tuple(self._robots), value=self._chosen())
        context.changed(self._robot, "robot", self._choose)
        ui.add_html(html.paragraph(self._facts(), faint=True, testid="robot-facts"))
        OwnArm(context)
        self._forms = Words(context).conventions()
        chosen = next(title for title, key in self._forms.items() if key == context.convention)
        angles = ui.add_choice(t("move.convention"), tuple(self._forms), value=chosen)
        context.changed(angles, "angles", self._convention)
        self.user = UserFrame(context)
        drawn = ["handle"] if context.aids.handle else []
        for name in (*drawn, "marks", "residuals"):
            check = ui.add_check(t(f"cell.{name}"), getattr(stage, f"show_{name}"))
            context.changed(check, name, lambda on, name=name: self._draw(name, on))
        ui.add_html(
            html.paragraph(t("cell.session", name=context.session.name[:8]), faint=True, testid="session")
        )

    def _title(self, robot: RobotModel) -> str:
        return robot.said("title", self._context.language)

    def _chosen(self) -> str:
        """The title of the arm in the cell."""
        robot = self._context.session.state.robot
        return next(
            (t for t, name in self._robots.items() if name == robot), self._title(self._context.model)
        )

    def _facts(self) -> str:
        robot = self._context.model
        about = robot.description
        if not about:
            return self._context.t(
                "cell.facts_own", reach=f"{robot.reach:.2f}", joints=robot.joint_count, flange=robot.flange
            )
        return self._context.t(
            "cell.facts",
            maker=robot.said("maker", self._context.language),
            reach=f"{float(about.get('reach_m', robot.reach)):.2f}",
            load=f"{about.get('payload_kg', 0):g}",
            joints=robot.joint_count,
        )

    def _choose(self, title: str) -> None:
        context = self._context
        context.do(ChooseRobot(self._robots[title]))
        context.say("good", context.t("message.robot", title=self._title(context.model)))

    def _convention(self, title: str) -> None:
        context = self._context
        context.look = replace(context.look, convention=self._forms[title])
        context.refresh()

    def _draw(self, name: str, on: bool) -> None:
        setattr(self._context.stage, f"show_{name}", on)
        self._context.stage.refresh(self._context.session.state)

    def refresh(self, state: SessionState) -> None:
        """The arm, and the user frame while it is jogged."""
        self._robot.value = self._chosen()
        self.user.refresh(state)

    def numbers(self) -> None:
        """Another frame may be jogged."""
        self.user.show_if(self._context.jogging.frame == "user")

    def close(self) -> None:
        """Nothing is held."""


class _Cell:
    key, order = "cell", 90

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = _Cell()
