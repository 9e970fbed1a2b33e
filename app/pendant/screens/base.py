"""Two robots and a laser tracker: the procedure as a wizard, and the proof in millimetres."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.kinematics import load_robot, robot_names
from app.pendant import html
from app.pendant.scene.camera import look
from app.pendant.screens._base import cards
from app.pendant.screens._base.exam import Exam
from app.pendant.screens._base.run import Run
from app.session import SessionState
from app.session.actions import CloseCell, OpenCell
from app.simulation.tracker_cell import TrackerCell
from app.simulation.tracker_meeting import Meeting
from app.units import deg, from_deg, mm

if TYPE_CHECKING:
    from collections.abc import Iterator

    from app.pendant.client import Pendant

_MOTION = "base"
_SPREAD = 1_000_000  # seeds of cells: nobody meets the same one twice


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        self._run: Run | None = None
        gui, t = pendant.client.gui, pendant.t
        names = tuple(name for name in robot_names() if load_robot(name).joint_count > 2)
        self._intro = gui.add_html(html.paragraph(t("base.intro"), testid="base-intro"))
        self._setup = gui.add_folder(t("base.cell"))
        with self._setup:
            own = pendant.model.name if pendant.model.name in names else names[0]
            self._robots = [
                gui.add_dropdown(t("base.robot_number", number=k + 1), names, initial_value=start)
                for k, start in enumerate((own, "ur10e" if "ur10e" in names else names[-1]))
            ]
            self._nests = gui.add_checkbox(t("base.nests"), True, hint=t("base.nests_hint"))
            self._pushed = gui.add_checkbox(t("base.pushed"), False, hint=t("base.pushed_hint"))
            pendant.clicked(gui.add_button(t("base.open")), self._open)
        self._work = gui.add_folder(t("base.procedure"), visible=False)
        with self._work:
            self._plan = gui.add_html("")
            self._next = gui.add_html("")
            self._all = gui.add_button(t("base.all"), hint=t("base.all_hint"))
            pendant.clicked(self._all, lambda: self._start(whole=True))
            self._one = gui.add_button(t("base.one"), color="gray")
            pendant.clicked(self._one, lambda: self._start(whole=False))
            self._every = gui.add_number(t("base.every"), 10, min=2, max=45, step=1)
            with gui.add_folder(t("base.by_hand"), expand_by_default=False):
                self._angle = gui.add_slider(t("base.angle"), -170, 170, 1, 0)
                pendant.entered(self._angle, "base.angle", self._turn, slider=True)
                hand = gui.add_button_group(
                    t("base.point"), (t("base.measure"), t("base.leave"), t("base.undo"))
                )
                jobs = {
                    t("base.measure"): self._measure,
                    t("base.leave"): self._leave,
                    t("base.undo"): self._undo,
                }
                pendant.chosen(hand, lambda label: jobs[label]())
        self._result = gui.add_html("", visible=False)
        self._send = gui.add_button(t("base.send"), visible=False)
        pendant.clicked(self._send, self._meet)
        self._miss = gui.add_html("", visible=False)
        self._close_button = gui.add_button(t("base.close"), visible=False, color="gray")
        pendant.clicked(self._close_button, self._leave_cell)

    @property
    def run(self) -> Run | None:
        """What is being measured; for tests."""
        return self._run

    # The cell ----------------------------------------------------------------------------------------------

    def _open(self) -> None:
        pendant = self._pendant
        first, second = (str(robot.value) for robot in self._robots)
        pendant.do(
            OpenCell(
                first,
                second,
                int(pendant.rng.integers(_SPREAD)),
                nests=bool(self._nests.value),
                pushed=bool(self._pushed.value),
            )
        )  # the screen follows the session, see refresh
        pendant.say("info", pendant.t("base.opened"))

    def _opened(self, exam: Exam) -> None:
        pendant = self._pendant
        pendant.stage.make_room(True)
        self._run = Run(
            pendant.client.scene,
            exam.truth.cell,
            nests=True,
            pushed=False,
            seed=int(pendant.rng.integers(_SPREAD)),
            exam=exam,
            t=pendant.t,
        )
        camera = pendant.client.camera
        look(camera, _whole(self._run.drawn, camera.aspect))
        self._intro.visible = self._setup.visible = False
        self._work.visible = True
        self._close_button.visible = exam.free
        self._finish(self._run)

    def _leave_cell(self) -> None:
        self._drop()
        self._pendant.do(CloseCell())
        self._pendant.stage.make_room(False)
        self._pendant.stage.view("whole")
        self._intro.visible = self._setup.visible = True
        for widget in (self._work, self._close_button, self._result, self._send, self._miss):
            widget.visible = False
        self._pendant.say("info", self._pendant.t("base.closed"))

    def _drop(self) -> None:
        self._pendant.worker.halt(_MOTION)
        if self._run is not None:
            self._run.drawing.remove()
            self._run = None

    # The procedure -----------------------------------------------------------------------------------------

    def _start(self, *, whole: bool) -> None:
        run = self._run
        if run is None or self._pendant.worker.running(_MOTION):
            return
        self._pendant.worker.animate(_MOTION, self._measuring(run, whole))

    def _measuring(self, run: Run, whole: bool) -> Iterator[None]:
        every = from_deg(float(self._every.value))
        while run.wizard.step is not None:
            yield from run.by_itself(every, self._show)
            if not whole:
                break
        self._finish(run)

    def _finish(self, run: Run) -> None:
        if run.wizard.done and run.relation is None:
            relation = run.solve()
            severe = relation is None or any(w.severe for w in relation.warnings)
            self._pendant.say("warning" if severe else "good", self._pendant.t("base.solved"))
        self._show()

    def _turn(self, degrees: float) -> None:
        run = self._run
        if run is None or run.wizard.step is None or run.wizard.step.axis == 0:
            return
        sight = run.turn_to(from_deg(float(degrees)))
        self._pendant.say("info" if sight.seen else "warning", self._pendant.t(f"base.sight_{sight.reason}"))

    def _measure(self) -> None:
        run = self._run
        if run is None or run.wizard.step is None:
            return
        sight = run.measure()
        level = "good" if sight.seen else "warning"
        self._pendant.say(level, self._pendant.t(f"base.sight_{sight.reason}"))
        self._show()

    def _leave(self) -> None:
        run = self._run
        if run is not None and run.wizard.step is not None:
            run.leave()
            self._finish(run)

    def _undo(self) -> None:
        if self._run is not None and self._run.relation is None:
            self._run.undo()
            self._show()

    def _meet(self) -> None:
        run = self._run
        if run is not None and run.relation is not None and not self._pendant.worker.running(_MOTION):
            self._pendant.worker.animate(_MOTION, run.meet(self._met))

    def _met(self, meeting: Meeting) -> None:
        t = self._pendant.t
        miss, predicted = f"{mm(meeting.miss):.3f}", f"{mm(meeting.predicted):.3f}"
        self._miss.content = html.light(
            "green" if meeting.miss < 3.0 * meeting.predicted else "red",
            t("base.met", miss=miss, predicted=predicted),
            testid="base-miss",
        )
        self._miss.visible = True
        run = self._run
        if run is not None:
            middle = run.drawn_tips().mean(axis=0)
            run.drawing.label("miss", f"{miss} mm", middle + np.array([0.0, 0.0, 0.12]))
            look(self._pendant.client.camera, (middle + np.array([-0.7, -1.9, 0.9]), middle))
        self._pendant.say("good", t("base.met", miss=miss, predicted=predicted))

    # What is shown -----------------------------------------------------------------------------------------

    def _show(self) -> None:
        run, t = self._run, self._pendant.t
        if run is None:
            return
        self._plan.content = cards.plan(self._pendant, run)
        step = run.wizard.step
        words = (
            t("base.all_done")
            if step is None
            else t(f"base.do_{step.kind}", axis=step.axis, robot=step.robot)
        )
        self._next.content = html.paragraph(words, testid="base-next", faint=True)
        self._one.visible = self._all.visible = self._every.visible = step is not None
        if step is not None and step.axis:
            arm = run.cell.arms[step.robot - 1]
            self._angle.min = float(np.ceil(deg(max(arm.robot.lower[step.axis - 1], -np.pi))))
            self._angle.max = float(np.floor(deg(min(arm.robot.upper[step.axis - 1], np.pi))))
        self._result.content = cards.result(self._pendant, run)
        self._result.visible = run.relation is not None
        self._send.visible = run.relation is not None and run.relation.T_base1_base2 is not None

    def refresh(self, state: SessionState) -> None:
        """The cell of the session, an exercise's or a free one, is taken up where it was left."""
        if self._run is None and (exam := Exam.of(self._pendant.session)) is not None:
            self._opened(exam)

    def close(self) -> None:
        """The page goes: motions end and the cell is taken down."""
        self._drop()


def _whole(cell: TrackerCell, aspect: float) -> tuple[np.ndarray, np.ndarray]:
    """Eye and centre from which both arms, their circles and the tracker are seen in a window of this shape."""
    places = np.array(
        [*(arm.T_world_base.position for arm in cell.arms), cell.tracker.T_world_tracker.position]
    )
    low, high = places.min(axis=0), places.max(axis=0)
    centre = (low + high) / 2.0
    far = (1.35 * float(np.linalg.norm(high - low)) + 0.6) / min(1.6 * aspect, 1.0)
    return centre + far * np.array([-0.42, -0.74, 0.52]), centre


class BaseScreen:
    """The tab of the two-robot cell."""

    key = "base"
    order = 40

    def build(self, pendant: Pendant) -> _View:
        """Makes the widgets."""
        return _View(pendant)


SCREEN = BaseScreen()
