"""Two robots and a laser tracker: the procedure as a wizard, and the proof in millimetres."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.kinematics import robot_names
from app.panel import markup as html
from app.scene.camera import look
from app.screens._base import cards
from app.screens._base.exam import Exam
from app.screens._base.giving import send_page, send_relation
from app.screens._base.run import Run
from app.session import SessionState
from app.session.actions import CloseCell, OpenCell
from app.session.state import robot_named
from app.simulation.tracker_cell import TrackerCell
from app.simulation.tracker_meeting import Meeting
from app.units import deg, from_deg, mm

if TYPE_CHECKING:
    from collections.abc import Iterator

    from app.screens.context import Context

_MOTION = "base"
_BEYOND = 1.5  # times the 95% region: further off nothing is by chance (4.2 standard errors)
_SPREAD = 1_000_000  # seeds of cells: nobody meets the same one twice


class _View:
    def __init__(self, context: Context):
        self._context = context
        self._run: Run | None = None
        ui, t = context.ui, context.t
        names = tuple(name for name in robot_names() if robot_named(name).joint_count > 2)
        self._intro = ui.add_html(html.paragraph(t("base.intro"), testid="base-intro"))
        self._setup = ui.add_folder(t("base.cell"))
        with self._setup:
            own = context.model.name if context.model.name in names else names[0]
            self._names = {robot_named(name).said("title", context.language): name for name in names}
            titles = {name: title for title, name in self._names.items()}
            self._robots = [
                ui.add_choice(t("base.robot_number", number=k + 1), tuple(self._names), value=titles[start])
                for k, start in enumerate((own, "ur10e" if "ur10e" in names else names[-1]))
            ]
            self._nests = ui.add_check(t("base.nests"), True, hint=t("base.nests_hint"))
            self._pushed = ui.add_check(t("base.pushed"), False, hint=t("base.pushed_hint"))
            context.clicked(ui.add_button(t("base.open")), self._open)
        self._work = ui.add_folder(t("base.procedure"), visible=False)
        self._place = self._work.order
        with self._work:
            self._plan = ui.add_html("")
            self._next = ui.add_html("")
            self._all = ui.add_button(t("base.all"), hint=t("base.all_hint"))
            context.clicked(self._all, lambda: self._start(whole=True))
            self._one = ui.add_button(t("base.one"), rank="plain")
            context.clicked(self._one, lambda: self._start(whole=False))
            self._stop = ui.add_button(t("base.stop"), rank="plain", visible=False)
            context.clicked(self._stop, self._halt)
            self._every = ui.add_number(t("base.every"), 10.0, low=2.0, high=45.0, step=1.0)
            with ui.add_folder(t("base.by_hand"), expanded=False):
                self._angle = ui.add_slider(t("base.angle"), -170.0, 170.0, 1.0, 0.0)
                context.changed(self._angle, "base.angle", self._turn)
                hand = ui.add_buttons(t("base.point"), (t("base.measure"), t("base.leave"), t("base.undo")))
                jobs = {
                    t("base.measure"): self._measure,
                    t("base.leave"): self._leave,
                    t("base.undo"): self._undo,
                }
                context.chosen(hand, lambda label: jobs[label]())
        self._result = ui.add_html("", visible=False)
        self._send = ui.add_button(t("base.send"), visible=False)
        context.clicked(self._send, self._meet)
        self._miss = ui.add_html("", visible=False)
        given = {t("base.export"): send_relation, t("base.report"): send_page}
        self._give = ui.add_buttons(t("base.give"), tuple(given), visible=False)
        context.chosen(self._give, lambda label: self._run and given[label](context, self._run))
        self._close_button = ui.add_button(t("base.close"), visible=False, rank="plain")
        context.clicked(self._close_button, self._leave_cell)

    @property
    def run(self) -> Run | None:
        """What is being measured; for tests."""
        return self._run

    # The cell ----------------------------------------------------------------------------------------------

    def _open(self) -> None:
        context = self._context
        first, second = (self._names[str(robot.value)] for robot in self._robots)
        context.do(
            OpenCell(
                first,
                second,
                int(context.rng.integers(_SPREAD)),
                nests=bool(self._nests.value),
                pushed=bool(self._pushed.value),
            )
        )  # the screen follows the session, see refresh
        context.say("info", context.t("base.opened"))

    def _opened(self, exam: Exam) -> None:
        context = self._context
        self._run = Run(
            context,
            exam.truth.cell,
            nests=True,
            pushed=False,
            seed=int(context.rng.integers(_SPREAD)),
            exam=exam,
        )
        context.show_instead(self._run.seen)
        eyes = context.stage.eyes
        look(eyes, _whole(self._run.drawn, eyes.aspect))
        self._intro.visible = self._setup.visible = False
        self._work.visible = True
        self._close_button.visible = exam.free
        self._finish(self._run)

    def _leave_cell(self) -> None:
        self._drop()
        self._context.do(CloseCell())
        self._context.show_instead(None)
        self._context.stage.view("whole")
        self._intro.visible = self._setup.visible = True
        for widget in (self._work, self._close_button, self._result, self._send, self._miss, self._give):
            widget.visible = False
        self._context.say("info", self._context.t("base.closed"))

    def _drop(self) -> None:
        self._context.worker.halt(_MOTION)
        if self._run is not None:
            self._run.drawing.remove()
            self._run = None

    # The procedure -----------------------------------------------------------------------------------------

    def _start(self, *, whole: bool) -> None:
        run = self._run
        if run is None or self._context.worker.running(_MOTION):
            return
        self._context.drive.must_not_be_stopped()
        self._context.drive.errand = self._context.t("errand.base")
        self._context.worker.animate(_MOTION, self._measuring(run, whole))
        self._stop.visible = True
        self._context.on_page()

    def _halt(self) -> None:
        """The procedure ends where it is; what was measured stays."""
        self._context.drive.cancel()
        self._stop.visible = False
        self._context.say("info", self._context.t("base.stopped"))
        self._show()

    def _measuring(self, run: Run, whole: bool) -> Iterator[None]:
        every = from_deg(float(self._every.value))
        while run.wizard.step is not None:
            yield from run.by_itself(every, self._show)
            if not whole:
                break
        self._finish(run)

    def _finish(self, run: Run) -> None:
        self._stop.visible = False
        if run.wizard.done and run.relation is None:
            relation = run.solve()
            found = relation is not None and relation.T_base1_base2 is not None
            doubtful = relation is None or any(w.severe for w in relation.warnings)
            words = "base.light_none" if not found else "base.doubtful" if doubtful else "base.solved"
            self._context.say("warning" if doubtful else "good", self._context.t(words))
        self._show()

    def _turn(self, degrees: float) -> None:
        run = self._run
        if run is None or run.wizard.step is None or run.wizard.step.axis == 0:
            return
        sight = run.turn_to(from_deg(float(degrees)))
        self._context.say("info" if sight.seen else "warning", self._context.t(f"base.sight_{sight.reason}"))

    def _measure(self) -> None:
        run = self._run
        if run is None or run.wizard.step is None:
            return
        sight = run.measure()
        level = "good" if sight.seen else "warning"
        self._context.say(level, self._context.t(f"base.sight_{sight.reason}"))
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
        if run is not None and run.relation is not None and not self._context.worker.running(_MOTION):
            self._context.drive.must_not_be_stopped()
            self._context.drive.errand = self._context.t("errand.meet")
            self._context.worker.animate(_MOTION, run.meet(self._met))
            self._context.on_page()

    def _met(self, meeting: Meeting) -> None:
        t = self._context.t
        miss, predicted = f"{mm(meeting.miss):.3f}", f"{mm(meeting.predicted):.3f}"
        within = meeting.miss / meeting.predicted
        self._miss.content = html.light(
            "green" if within <= 1.0 else "yellow" if within <= _BEYOND else "red",
            t("base.met", miss=miss, predicted=predicted),
            testid="base-miss",
        )
        self._miss.visible = True
        run = self._run
        if run is not None:
            middle = run.drawn_tips().mean(axis=0)
            run.drawing.label("miss", f"{miss} mm", middle + np.array([0.0, 0.0, 0.12]))
            look(self._context.stage.eyes, (middle + np.array([-0.7, -1.9, 0.9]), middle))
        self._context.say("good", t("base.met", miss=miss, predicted=predicted))

    # What is shown -----------------------------------------------------------------------------------------

    def _show(self) -> None:
        run, t = self._run, self._context.t
        if run is None:
            return
        self._plan.content = cards.plan(self._context, run)
        step = run.wizard.step
        words = (
            t("base.all_done")
            if step is None
            else t(f"base.do_{step.kind}", axis=step.axis, robot=step.robot)
        )
        self._next.content = html.paragraph(words, testid="base-next", faint=True)
        helped = step is not None and self._context.aids.touch
        self._one.visible = self._all.visible = self._every.visible = helped
        if step is not None and step.axis:
            arm = run.cell.arms[step.robot - 1]
            self._angle.min = float(np.ceil(deg(max(arm.robot.lower[step.axis - 1], -np.pi))))
            self._angle.max = float(np.floor(deg(min(arm.robot.upper[step.axis - 1], np.pi))))
        self._result.content = cards.result(self._context, run)
        self._result.visible = self._give.visible = run.relation is not None
        # What was found comes first; the procedure that led there stands below it.
        self._work.order = self._place if run.relation is None else self._close_button.order - 0.5
        self._send.visible = run.relation is not None and run.relation.T_base1_base2 is not None

    def numbers(self) -> None:
        """The arm moved, or was stopped: with it the procedure."""
        self._stop.visible = self._run is not None and self._context.worker.running(_MOTION)

    def refresh(self, state: SessionState) -> None:
        """The cell of the session, an exercise's or a free one, is taken up where it was left."""
        if self._run is None and (exam := Exam.of(self._context.session)) is not None:
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

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = BaseScreen()
