"""The tool wizard: a row a point from the mode's own list, then Calculate, Result, Accept or Cancel."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from app.calibration.captures import Step
from app.calibration.tool import METHODS
from app.calibration.wording import name_of
from app.errors import TeachframeError
from app.pendant import html
from app.pendant.screens._tool.deciding import Deciding
from app.pendant.screens._tool.direct import DirectEntry
from app.pendant.screens._tool.giving import take_frame
from app.pendant.screens._tool.hand import (
    AXES,
    STROKE,
    TOUCHED,
    help_along,
    joints_of,
    next_step,
)
from app.pendant.screens._tool.next_touch import NextTouch
from app.pendant.screens._tool.paper import calculate, play_paper_table, play_upload
from app.pendant.screens._tool.result import named
from app.pendant.screens._tool.rows import Row
from app.pendant.screens._tool.words import Words
from app.pendant.texts import error_text
from app.session import SessionState
from app.session.actions import ChooseMethod, ChooseMode, Delete, Record, Redo, ReRecord, Undo
from app.session.state import DIRECT, as_tuple, mode_named
from app.units import mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant


class _View:
    def __init__(self, pendant: Pendant):
        self.pendant = pendant
        self._words = Words(pendant)
        self._rows: list[Row] = []
        self._steps: tuple[Step, ...] = ()
        self._state: SessionState | None = None
        self._build_setup()
        self.deciding = Deciding(pendant)
        self._build_list()

    def _build_setup(self) -> None:
        pendant, gui, t = self.pendant, self.pendant.client.gui, self.pendant.t
        state = pendant.session.state
        makers = self._words.makers()
        chosen = next(title for title, key in makers.items() if key == pendant.vocabulary)
        self._maker = gui.add_dropdown(t("tool.words"), tuple(makers), initial_value=chosen)
        pendant.changed(self._maker, "maker", lambda title: self._speak(makers[title]))
        self._modes = self._words.modes()
        mode = mode_named(state.mode)
        title = next(title for title, key in self._modes.items() if key == mode.key)
        self._mode = gui.add_dropdown(t("tool.mode"), tuple(self._modes), initial_value=title)
        pendant.changed(self._mode, "mode", self._choose_mode)
        low, high = mode.least_touches, mode.most_touches
        self._touches = gui.add_number(t("tool.touches"), state.touches, min=low, max=high, step=1)
        pendant.entered(self._touches, "touches", self._choose_touches)
        named = {
            "joint": "tool.method_joint",
            "pairwise": "tool.method_pairwise",
            "robust": "tool.method_robust",
        }
        self._methods = {t(named[key]) if key in named else key: key for key in METHODS}
        label = self._method_label(state.method)
        self._method = gui.add_dropdown(t("tool.method"), tuple(self._methods), initial_value=label)
        pendant.changed(self._method, "method", lambda label: pendant.do(ChooseMethod(self._methods[label])))
        self._next = gui.add_html("")
        self._assist = gui.add_button(t("tool.assist_touch"), hint=t("tool.assist_hint"), color="gray")
        pendant.clicked(self._assist, self._help)
        self._direct = DirectEntry(pendant, self._words)
        self._next_touch = NextTouch(pendant, self._words)
        self._refused = gui.add_html("", visible=False)

    def _build_list(self) -> None:
        pendant, gui, t = self.pendant, self.pendant.client.gui, self.pendant.t
        self._folder = gui.add_folder(t("tool.points"))
        self._calculate = gui.add_button(t("tool.calculate"))
        pendant.clicked(self._calculate, self._compute)
        history = gui.add_button_group(t("tool.history"), (t("tool.undo"), t("tool.redo")))
        steps = {t("tool.undo"): self._undo, t("tool.redo"): self._redo}
        pendant.chosen(history, lambda label: steps[label]())
        with gui.add_folder(t("tool.examples")):
            paper = gui.add_button(t("tool.paper"), hint=t("tool.paper_hint"))
            pendant.clicked(paper, lambda: play_paper_table(pendant))
            self._take(gui.add_upload_button(t("tool.upload"), mime_type="text/csv"), play_upload)
            self._take(gui.add_upload_button(t("tool.take"), hint=t("tool.take_hint")), take_frame)

    def _take(self, upload: Any, job: Callable[[Pendant, str, bytes], None]) -> None:
        """What somebody sends goes to `job`; what it refuses stays on the screen."""
        pendant = self.pendant

        @upload.on_upload
        async def _(event) -> None:
            file = event.target.value
            pendant.post(lambda: self._or_say(lambda: job(pendant, file.name, file.content)))

    # What somebody does ----------------------------------------------------------------------------------

    def _record(self, step: Step) -> None:
        pendant = self.pendant
        action = ReRecord if step.key in pendant.session.state.captures else Record
        pendant.do(action(step.key, as_tuple(pendant.q)))
        far = pendant.world.distance(pendant.q)
        if "touch" in step.roles and far > pendant.world.contact_distance:
            key = "message.recorded_far" if pendant.aids.distance else "message.recorded_off"
            pendant.say("warning", pendant.t(key, title=step.title, mm=f"{mm(far):.1f}"))
        else:
            pendant.say("good", pendant.t("message.recorded", title=step.title))

    def _go(self, step: Step) -> None:
        pendant = self.pendant
        q = joints_of(pendant, pendant.session.state.captures[step.key])
        if q is not None:
            pendant.go(q, lambda: pendant.say("info", pendant.t("message.went", title=step.title)))

    def _delete(self, step: Step) -> None:
        self.pendant.do(Delete(step.key))
        self.pendant.say("info", self.pendant.t("message.deleted", title=step.title))

    def _help(self) -> None:
        step = next_step(self.pendant)
        help_along(self.pendant, self._words.step(step).title if step else "")

    def _compute(self) -> None:
        if self.pendant.session.state.mode == DIRECT:
            self._or_say(lambda: self.pendant.do(self._direct.action()))
        self._or_say(lambda: calculate(self.pendant))

    def _or_say(self, job: Callable[[], object]) -> None:
        """Does a job; a refusal stays on the screen under its name, the message line has room for one line only."""
        try:
            job()
        except TeachframeError as error:
            words = error_text(error, self.pendant.language)
            code = getattr(error, "why", getattr(error, "code", ""))
            name = name_of(code, self.pendant.language) if code else ""
            self._refused.content = html.light("red", named(name, words) if name else words, testid="refused")
            self._refused.visible = True
            raise

    def _undo(self) -> None:
        self.pendant.do(Undo())
        self.pendant.say("info", self.pendant.t("message.undone"))

    def _redo(self) -> None:
        self.pendant.do(Redo())
        self.pendant.say("info", self.pendant.t("message.redone"))

    def _speak(self, maker: str) -> None:
        """A maker's words and angles, on the whole page."""
        pendant = self.pendant
        pendant.vocabulary = maker
        words = self._words.vocabulary
        if words is not None:
            pendant.convention = words.convention
        pendant.rebuild()

    def _choose_mode(self, title: str) -> None:
        self._chosen(ChooseMode(self._modes[title]))

    def _choose_touches(self, value: float) -> None:
        self._chosen(ChooseMode(self.pendant.session.state.mode, int(value)))

    def _chosen(self, action: ChooseMode) -> None:
        pendant = self.pendant
        state = pendant.do(action)
        title = self._words.mode(mode_named(state.mode))
        key = "message.mode" if state.steps else "message.mode_direct"
        pendant.say("info", pendant.t(key, title=title, count=len(state.steps)))

    # What is shown ---------------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        if state is not self._state:
            self._state = state
            self._refused.visible = False
        mode = mode_named(state.mode)
        self._mode.value = next(title for title, key in self._modes.items() if key == mode.key)
        self._touches.min, self._touches.max = mode.least_touches, mode.most_touches
        if not self.pendant.typing("touches"):
            self._touches.value = state.touches
        self._method.value = self._method_label(state.method)
        if state.steps != self._steps:
            for row in self._rows:
                row.remove()
            self._steps = state.steps
            jobs = {"record": self._record, "go": self._go, "delete": self._delete}
            self._rows = [
                Row(self.pendant, self._folder, self._words.step(step), number, jobs)
                for number, step in enumerate(state.steps)
            ]
        for row in self._rows:
            row.refresh(state)
        done = state.result is not None
        for widget in (self._maker, self._mode, self._next, self._calculate):
            widget.visible = not done
        self._touches.visible = self._method.visible = not done and mode.most_touches > 0
        step = state.missing[0] if state.missing else None
        touched = step is not None and bool(TOUCHED & set(step.roles))
        self._assist.visible = not done and (
            (touched and self.pendant.aids.touch) or (step is not None and step.role in AXES)
        )
        self._calculate.disabled = not state.captures and state.mode != DIRECT
        self._folder.visible = bool(state.steps)
        for part in (self._direct, self._next_touch, self.deciding):
            part.refresh(state)
        if not done:
            self._instruct(step, state)

    def numbers(self) -> None:
        """The arm moved."""
        self._next_touch.numbers()
        self.deciding.numbers()

    def _instruct(self, step: Step | None, state: SessionState) -> None:
        t = self.pendant.t
        if state.mode == DIRECT:
            self._next.content = html.instruction(t("tool.direct_title"), t("tool.direct_do"))
            return
        if step is None:
            self._next.content = html.instruction(t("tool.ready"), "")
            return
        step = self._words.step(step)
        self._next.content = html.instruction(t("tool.next", title=step.title), step.instruction)
        if step.role in AXES:
            self._assist.label = t("tool.assist_stroke", mm=f"{mm(STROKE):.0f}", axis=step.role.upper())
        else:
            self._assist.label = t("tool.assist_touch")

    def _method_label(self, key: str) -> str:
        return next(label for label, method in self._methods.items() if method == key)

    def close(self) -> None:
        self._next_touch.close()


class _Tool:
    key, order = "tool", 0

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


SCREEN = _Tool()
