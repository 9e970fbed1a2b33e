"""The tool wizard: it opens at what to do now; a row a point of the mode; verdict first."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from app.calibration.captures import Step
from app.calibration.wording import name_of
from app.errors import TeachframeError
from app.panel import Row, Upload
from app.panel import markup as html
from app.screens._tool.deciding import Deciding
from app.screens._tool.direct import DirectEntry
from app.screens._tool.giving import take_frame
from app.screens._tool.hand import AXES, STROKE, TOUCHED, Hand, joints_of, next_step
from app.screens._tool.leading import GHOST, HAND, RECORD, leads
from app.screens._tool.next_touch import NextTouch
from app.screens._tool.paper import calculate, play_paper_table, play_upload
from app.screens._tool.recording import Recording
from app.screens._tool.result import named
from app.screens._tool.rows import rows_of
from app.screens._tool.setup import Setup
from app.screens._tool.words import Words
from app.screens.taking_in import Around
from app.session import SessionState
from app.session.actions import Delete, Redo, Undo
from app.session.state import DIRECT
from app.simulation.pointing import POINTED
from app.texts import error_text
from app.training.exercise import begun_exercise
from app.units import mm

if TYPE_CHECKING:
    from app.screens.context import Context


class _View:
    def __init__(self, context: Context):
        self.context = context
        self._words = Words(context)
        self.hand, self.recording = Hand(context), Recording(context)
        self._state: SessionState | None = None
        ui, t = context.ui, context.t
        self.setup = Setup(context, self._words)
        self._next = ui.add_html("")
        # In the order in which they are pressed: to the ghost, to the spike, record.
        self._next_touch = NextTouch(context, self._words)
        self._assist = ui.add_button(t("tool.assist_touch"), hint=t("tool.assist_hint"), rank="plain")
        context.clicked(self._assist, self._help)
        self._record = ui.add_button(t("tool.record"))
        context.clicked(self._record, self._record_next)
        self._next_touch.explain()
        self._direct = DirectEntry(context, self._words)
        self._refused = ui.add_html("", visible=False)
        self._calculate = ui.add_button(t("tool.calculate"))
        context.clicked(self._calculate, self._compute)
        self.deciding = Deciding(context)
        self._folder = ui.add_folder(t("tool.points"))
        with self._folder:
            self.rows = ui.add_rows()
            context.chosen(self.rows, self._in_row)
            history = ui.add_buttons(t("tool.history"), (t("tool.undo"), t("tool.redo")))
            steps = {t("tool.undo"): self._undo, t("tool.redo"): self._redo}
            context.chosen(history, lambda label: steps[label]())
        self.deciding.take_away()
        with ui.add_folder(t("tool.examples"), expanded=False):
            paper = ui.add_button(t("tool.paper"), hint=t("tool.paper_hint"), rank="plain")
            context.clicked(paper, lambda: play_paper_table(context))
            self._take(ui.add_upload(t("tool.upload"), accept=".csv"), play_upload)
            self._take(ui.add_upload(t("tool.take"), hint=t("tool.take_hint")), take_frame)

    def _take(self, upload: Any, job: Callable[[Context, Upload, Around], None]) -> None:
        """What somebody sends goes to `job`; what it refuses stays on the screen."""
        context = self.context
        context.uploaded(upload, lambda files: job(context, files[0], self._or_say))

    # What somebody does ----------------------------------------------------------------------------------

    def _record_next(self) -> None:
        step = next_step(self.context)
        if step is not None:
            self._or_say(
                lambda: self.recording.record(self._words.step(step), back=self.hand.went_back(step))
            )

    def _in_row(self, pressed: str) -> None:
        key, _, action = pressed.partition("/")
        step = self.context.session.state.step(key)
        if step is None:
            return
        worded = self._words.step(step)
        jobs = {
            "record": lambda: self.recording.record(worded, back=self.hand.went_back(step)),
            "back": lambda: self.recording.record(worded, back=True),
            "go": lambda: self._go(worded),
            "delete": lambda: self._delete(worded),
        }
        self._or_say(jobs[action])

    def _go(self, step: Step) -> None:
        context = self.context
        q = joints_of(context, context.session.state.captures[step.key])
        if q is not None:
            said = context.t("message.went", title=step.title)
            context.go(q, lambda: context.say("info", said), context.t("errand.go", title=step.title))

    def _delete(self, step: Step) -> None:
        self.context.do(Delete(step.key))
        self.context.say("info", self.context.t("message.deleted", title=step.title))

    def _help(self) -> None:
        step = next_step(self.context)
        self.hand.help_along(self._words.step(step).title if step else "")

    def _compute(self) -> None:
        if self.context.session.state.mode == DIRECT:
            self._or_say(lambda: self.context.do(self._direct.action()))
        self._or_say(lambda: calculate(self.context))

    def _or_say(self, job: Callable[[], object]) -> None:
        """Does a job; a refusal stays on the screen under its name, the message line has room for one line only."""
        try:
            job()
        except TeachframeError as error:
            words = error_text(error, self.context.language)
            code = getattr(error, "why", getattr(error, "code", ""))
            name = name_of(code, self.context.language) if code else ""
            self._refused.content = html.light("red", named(name, words) if name else words, testid="refused")
            self._refused.visible = True
            raise

    def _undo(self) -> None:
        self.context.do(Undo())
        self.context.say("info", self.context.t("message.undone"))

    def _redo(self) -> None:
        self.context.do(Redo())
        self.context.say("info", self.context.t("message.redone"))

    # What is shown ---------------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        """The step at hand, the list, the result."""
        if state is not self._state:
            self._state = state
            self._refused.visible = False
        done = state.result is not None
        step = state.missing[0] if state.missing else None
        self.setup.refresh(state)
        self.rows.rows = self._rows(state)
        self._folder.visible = bool(state.steps)
        self._next.visible = not done
        touched = step is not None and bool((TOUCHED | POINTED) & set(step.roles))
        self._record.visible = not done and step is not None
        self._assist.visible = not done and (
            (touched and self.context.aids.touch) or (step is not None and step.role in AXES)
        )
        self._calculate.visible = not done and (state.mode == DIRECT or bool(state.captures))
        # Where an exercise asks for touches alone, it is finished next; what they would give may still be looked at.
        asked = state.running is None or begun_exercise(state.running.begun).goal == "tool"
        self._calculate.rank = "main" if step is None and asked else "plain"
        for part in (self._direct, self._next_touch, self.deciding):
            part.refresh(state)
        if not done:
            self._instruct(step, state, asked)

    def _rows(self, state: SessionState) -> tuple[Row, ...]:
        return rows_of(self.context, self._words, state)

    def show_pressed(self, pressed: str) -> None:
        """A demonstration presses a button: `STEP/record` of a row, `calculate`; empty lets all go."""
        self.rows.value = pressed or None
        self._calculate.value = pressed == "calculate"

    def numbers(self) -> None:
        """The arm moved."""
        self._next_touch.numbers()
        self.deciding.numbers()
        self._stand_out()

    def _stand_out(self) -> None:
        """The key that is pressed next stands out from those beside it."""
        step = next_step(self.context)
        if step is None or not self._record.visible:
            return
        key = leads(self.context, step, self._next_touch.goal)
        for button, name in (
            (self._next_touch.go_button, GHOST),
            (self._assist, HAND),
            (self._record, RECORD),
        ):
            button.rank = "main" if key == name else "plain"

    def _instruct(self, step: Step | None, state: SessionState, asked: bool) -> None:
        t = self.context.t
        if state.mode == DIRECT:
            self._next.content = html.instruction(t("tool.direct_title"), t("tool.direct_do"))
            return
        if step is None:
            self._next.content = html.instruction(t("tool.ready" if asked else "tool.touched_all"), "")
            return
        step = self._words.step(step)
        self._next.content = html.instruction(t("tool.next", title=step.title), step.instruction)
        self._record.label = t("tool.record_next", title=step.title)
        if step.role in AXES:
            self._assist.label = t("tool.assist_stroke", mm=f"{mm(STROKE):.0f}", axis=step.role.upper())
        elif step.role in POINTED:
            self._assist.label = t(f"tool.assist_{step.role}")
        else:
            self._assist.label = t("tool.assist_touch")

    def close(self) -> None:
        """The page goes away."""
        self._next_touch.close()


class _Tool:
    key, order = "tool", 0

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = _Tool()
