"""Two robots and a laser tracker: the procedure as a wizard, and the proof in millimetres."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.kinematics import robot_names
from app.panel import markup as html
from app.screens._base import cards
from app.screens._base.by_hand import ByHand
from app.screens._base.exam import Exam
from app.screens._base.giving import send_page, send_relation
from app.screens._base.run import Run
from app.session import SessionState
from app.session.actions import CloseCell, OpenCell
from app.session.state import robot_named
from app.simulation.tracker_meeting import Meeting
from app.units import from_deg, mm

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
        self._by_itself = False  # what runs is the procedure, not a way by hand
        self._begun = (
            False  # a motion was begun that neither came to its end nor was told to have been stopped
        )
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
            self._hand = ByHand(context, self)
        # Right under the verdict, as in the other wizards: a phone's window is lower than what follows.
        self._verdict = ui.add_html("", visible=False)
        self._send = ui.add_button(t("base.send"), visible=False)
        context.clicked(self._send, self._meet)
        self._miss = ui.add_html("", visible=False)
        given = {t("base.export"): send_relation, t("base.report"): send_page}
        self._give = ui.add_buttons(t("base.give"), tuple(given), visible=False)
        context.chosen(self._give, lambda label: self._run and given[label](context, self._run))
        self._result = ui.add_html("", visible=False)
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
        context.show_instead(self._run.seen, self._run.instead)
        self._intro.visible = self._setup.visible = False
        self._work.visible = True
        self._close_button.visible = exam.free
        self.finish(self._run)

    def _leave_cell(self) -> None:
        self._drop()
        self._context.do(CloseCell())
        self._context.show_instead(None)
        self._intro.visible = self._setup.visible = True
        shown = (
            self._work,
            self._close_button,
            self._verdict,
            self._result,
            self._send,
            self._miss,
            self._give,
        )
        for widget in shown:
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
        what = "base.hold_all" if whole else "base.hold_one"
        self.begin(self._measuring(run, whole), self._context.t("errand.base"), what, by_itself=True)

    def begin(
        self, motion: Iterator[None], errand: str, what: str = "base.hold_turn", *, by_itself: bool = False
    ) -> None:
        """A motion of this cell; like every other it waits for the switch, and `what` says what follows then."""
        context = self._context
        context.drive.must_not_be_stopped()
        context.drive.errand, self._by_itself, self._begun = errand, by_itself, True
        context.say("info", context.t(what))
        context.worker.animate(_MOTION, self._told(motion))
        self._offer()
        context.on_page()

    def _told(self, motion: Iterator[None]) -> Iterator[None]:
        try:
            yield from motion
        except Exception:
            self._begun = False  # what failed says why
            raise
        self._begun = False
        # As a job of its own: until this is through, the motion counts as running, and the keys wait for its end.
        self._context.worker.post(self._offer)

    def _halt(self) -> None:
        """The procedure ends where it is; what was measured stays."""
        self._context.drive.cancel()
        self._tell_stopped()
        self.show()

    def _tell_stopped(self) -> None:
        """Whoever gave a motion up, here or in the message line, reads there no longer what it waited for."""
        if self._begun and not self._context.worker.running(_MOTION):
            self._begun = False
            if not self._context.drive.enabling.stopped:  # an emergency stop says so itself
                self._context.say("info", self._context.t("base.stopped"))

    def _measuring(self, run: Run, whole: bool) -> Iterator[None]:
        every, context = from_deg(float(self._every.value)), self._context
        while (step := run.wizard.step) is not None:
            if run.moves() and not context.drive.live:  # what stands already is measured without the switch
                context.say("info", context.t("base.hold_all" if whole else "base.hold_one"))
                while not context.drive.live:
                    yield
            context.say("info", context.t("base.measuring", step=cards.named(context, step)))
            yield from run.by_itself(every, self.show)
            if not whole:
                if (after := run.wizard.step) is not None:
                    names = {"step": cards.named(context, step), "next": cards.named(context, after)}
                    context.say("good", context.t("base.step_done", **names))
                break
        self.finish(run)

    def finish(self, run: Run) -> None:
        """A step was left: after the last one the relation is worked out."""
        if run.wizard.done and run.relation is None:
            relation = run.solve()
            found = relation is not None and relation.T_base1_base2 is not None
            doubtful = relation is None or any(w.severe for w in relation.warnings)
            words = "base.light_none" if not found else "base.doubtful" if doubtful else "base.solved"
            self._context.say("warning" if doubtful else "good", self._context.t(words))
        self.show()

    def _meet(self) -> None:
        run = self._run
        if run is not None and run.relation is not None and not self._context.worker.running(_MOTION):
            self.begin(run.meet(self._met), self._context.t("errand.meet"), "base.hold_meet", by_itself=True)

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
            self._context.stage.view("whole")  # both arms and where they meet
            self.show()
        self._context.say("good", t("base.met", miss=miss, predicted=predicted))

    # What is shown -----------------------------------------------------------------------------------------

    def show(self) -> None:
        """Where the procedure stands, and what was found."""
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
        self._offer()
        self._hand.show(run)
        self._verdict.content = cards.verdict(self._context, run)
        self._result.content = cards.result(self._context, run)
        self._verdict.visible = self._result.visible = self._give.visible = run.relation is not None
        # What was found comes first; the procedure that led there stands below it.
        self._work.order = self._place if run.relation is None else self._close_button.order - 0.5
        # Once they have met, what was found is taken away.
        self._send.rank, self._give.rank = ("main", "plain") if run.meeting is None else ("plain", "main")
        self._send.visible = run.relation is not None and run.relation.T_base1_base2 is not None

    def numbers(self) -> None:
        """The arm moved, or was stopped: with it the procedure."""
        self._tell_stopped()
        self._offer()

    def _offer(self) -> None:
        """What can be begun while nothing runs, else what stops it."""
        run, runs = self._run, self._run is not None and self._context.worker.running(_MOTION)
        helped = run is not None and run.wizard.step is not None and self._context.aids.touch
        self._stop.visible = runs
        self._hand.folder.visible = (
            run is not None and run.relation is None and not (runs and self._by_itself)
        )
        self._one.visible = self._all.visible = self._every.visible = helped and not runs

    def refresh(self, state: SessionState) -> None:
        """The cell of the session, an exercise's or a free one, is taken up where it was left."""
        if self._run is None and (exam := Exam.of(self._context.session)) is not None:
            self._opened(exam)

    def close(self) -> None:
        """The page goes: motions end and the cell is taken down."""
        self._drop()


class BaseScreen:
    """The tab of the two-robot cell."""

    key = "base"
    order = 40

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = BaseScreen()
