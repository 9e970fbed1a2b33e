"""The demonstration of a wizard mode: it plays by itself, with a caption a step."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Capture, Demo, Mode, Step
from app.calibration.modes import modes
from app.kinematics import RobotModel, solve_ik
from app.pendant import html
from app.pendant.screens._tool.paper import calculate
from app.pendant.screens._tool.words import Words
from app.session.actions import Accept, Calculate, ChooseMode, ChooseRobot, Enter, LoadPoints
from app.session.state import FIRST_ROBOT
from app.units import from_mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_NOISE = from_mm(0.1)
_SEEDS = 6  # draws of a demonstration that are tried: the first the arm can go through wholly is shown
_TRIES = 12  # other postures from which a point is tried that lies far from the one before
_REST = 2.6  # seconds a caption is left to be read
_DIRECT = "direct"


class Showing:
    """A choice of modes, and the caption of the step at hand.

    Args:
        pendant: where it plays.
    """

    def __init__(self, pendant: Pendant):
        self._pendant, self._words = pendant, Words(pendant)
        gui, t = pendant.client.gui, pendant.t
        self._folder = gui.add_folder(t("training.demo"))
        with self._folder:
            self._titles = {self._words.mode(mode): mode for mode in modes().values()}
            self._choice = gui.add_dropdown(t("tool.mode"), tuple(self._titles))
            self._play = gui.add_button(t("training.play"), hint=t("training.play_hint"), color="gray")
            pendant.clicked(self._play, self._start)
            self._stop = gui.add_button(t("training.stop"), color="gray", visible=False)
            pendant.clicked(self._stop, self.stop)
            self._caption = gui.add_html("")
        self.playing = False

    @property
    def visible(self) -> bool:
        return self._folder.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._folder.visible = value

    def stop(self) -> None:
        """Ends a demonstration where it is."""
        if self.playing:
            self._pendant.worker.halt("move")
            self._ended()

    def _start(self) -> None:
        self.play(self._titles[str(self._choice.value)].key)

    def play(self, key: str) -> None:
        """Plays one mode: its points are loaded, the arm goes to each, the result is calculated."""
        pendant, mode = self._pendant, modes()[key]
        pendant.jogging.must_not_be_stopped()
        if pendant.session.state.robot != FIRST_ROBOT:
            pendant.do(ChooseRobot(FIRST_ROBOT))  # makes the page anew: another Showing plays
            for showing in filter(None, (getattr(view, "showing", None) for view in pendant.page.views)):
                showing.play(key)
            return
        self._choice.value = self._words.mode(mode)
        demo, stops = reachable(pendant.model, mode)
        if not demo.captures:
            self._enter(demo)
            return
        known = demo.options.get("known_tool")
        if known is not None:
            self._know(tuple(float(v) for v in known))
        state = pendant.do(load_demo(mode, demo, pendant.t("training.demo")))
        self.playing = True
        self._play.visible, self._stop.visible = False, True
        captions = [self._words.step(step) for step in state.steps]
        q, ways = pendant.q, []
        for stop in stops:  # a point out of this arm's reach is told, not shown
            q = q if stop is None else stop
            ways.append(q)
        self._say(captions, 0)

        def arrived(number: int) -> None:
            if not self.playing:
                return
            if number >= 0:
                self._say(captions, number)
                return
            calculate(pendant)
            self._ended()
            self._caption.content = html.instruction(self._words.mode(mode), pendant.t("training.demo_done"))

        pendant.tour(ways, arrived, rest=_REST, checked=False)

    def _say(self, captions: list[Step], number: int) -> None:
        step, t = captions[number], self._pendant.t
        count = t("training.demo_step", number=number + 1, count=len(captions), title=step.title)
        self._caption.content = html.instruction(count, step.instruction)
        self._pendant.say("info", f"{count}: {step.instruction}")

    def _ended(self) -> None:
        self.playing = False
        self._play.visible, self._stop.visible = True, False

    def _know(self, position: tuple[float, ...]) -> None:
        """The tool that is known: typed in and accepted, as an operator would."""
        self._typed(position, (0.0, 0.0, 0.0))
        self._pendant.do(Accept(self._pendant.t("training.known_tool")))

    def _enter(self, demo: Demo) -> None:
        """Direct entry has no points: its numbers are typed in."""
        options = demo.options
        self._typed(options["position"], options["angles"])
        words = self._pendant.t("training.demo_direct")
        self._caption.content = html.instruction(self._words.mode(modes()[_DIRECT]), words)
        self._pendant.say("info", words)

    def _typed(self, position, angles) -> None:
        self._pendant.do(ChooseMode(_DIRECT))
        x, y, z = (float(v) for v in position)
        self._pendant.do(Enter((x, y, z), tuple(float(v) for v in angles)))
        self._pendant.do(Calculate())


def reachable(robot: RobotModel, mode: Mode) -> tuple[Demo, list[np.ndarray | None]]:
    """The demonstration of which the arm reaches most, and joints for each of its points; None where it does not."""
    best: tuple[Demo, list[np.ndarray | None]] | None = None
    for seed in range(_SEEDS):
        demo = mode.demo(touches=mode.default_touches, noise=_NOISE, seed=seed)
        stops = _stops(robot, demo.captures)
        if best is None or sum(s is None for s in stops) < sum(s is None for s in best[1]):
            best = demo, stops
        if all(stop is not None for stop in stops):
            break
    assert best is not None
    return best


def _stops(robot: RobotModel, captures: tuple[Capture, ...]) -> list[np.ndarray | None]:
    stops: list[np.ndarray | None] = []
    q, rng = robot.home, np.random.default_rng(0)
    others = rng.uniform(robot.lower, robot.upper, (_TRIES, robot.joint_count)) / 2.0
    for capture in captures:
        starts = (q, robot.home, *others)
        tried = (solve_ik(robot, capture.T_base_flange, start, max_steps=200) for start in starts)
        found = next((result for result in tried if result.reached), None)
        stops.append(None if found is None else found.q)
        q = q if found is None else found.q
    return stops


def load_demo(mode: Mode, demo: Demo, source: str) -> LoadPoints:
    """A demonstration's points as the action that loads them, as if from a file."""
    captures = [replace(capture, row=number) for number, capture in enumerate(demo.captures, 1)]
    return LoadPoints(
        source=source,
        title=mode.title,
        mode=mode.key,
        method="joint",
        roles=tuple(capture.role for capture in captures),
        rows=tuple(capture.row for capture in captures),
        columns=("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"),
        values=tuple(
            tuple(float(v) for v in (*capture.T_base_flange.position, *capture.T_base_flange.quaternion))
            for capture in captures
        ),
        steps=(0.0,) * 7,
        angles="quaternion",
    )
