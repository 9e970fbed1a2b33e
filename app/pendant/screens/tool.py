"""The tool wizard: a row a point from the mode's own list, then Calculate, Result, Accept or Cancel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from app import catalog
from app.calibration.captures import Capture, Step
from app.calibration.tool import METHODS
from app.pendant import html
from app.pendant.screens._paper import calculate, play_paper_table, play_upload
from app.pendant.screens._result import light_html, result_html
from app.session import SessionState
from app.session.actions import (
    Accept,
    Cancel,
    ChooseMethod,
    ChooseMode,
    Delete,
    Record,
    Redo,
    ReRecord,
    Undo,
)
from app.session.state import MODES, accepted, as_tuple, mode_named
from app.units import from_mm, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_STROKE = from_mm(150.0)
_AXES = {"x": 0, "y": 1, "z": 2}


class _Row:
    """One point of the list."""

    def __init__(self, view: _View, step: Step, number: int):
        self._view, self._step, self._number = view, step, number
        self._recorded: bool | None = None
        self._group: Any = None
        self._order = float(number)

    def refresh(self, state: SessionState) -> None:
        recorded = self._step.key in state.captures
        if recorded == self._recorded:
            return
        self._recorded = recorded
        t = self._view.pendant.t
        if self._group is not None:
            self._group.remove()
        again = t("tool.re_record" if recorded else "tool.record")
        jobs = {again: self._record}
        if recorded:
            jobs |= {t("tool.go"): self._go, t("tool.delete"): self._delete}
        mark = "●" if recorded else "○"
        with self._view.list_folder:
            self._group = self._view.pendant.client.gui.add_button_group(
                f"{mark} {self._step.title}", tuple(jobs), order=self._order
            )
        self._view.pendant.chosen(self._group, lambda label: jobs[label]())

    def _record(self) -> None:
        self._view.record(self._step)

    def _go(self) -> None:
        self._view.go_to(self._step)

    def _delete(self) -> None:
        pendant = self._view.pendant
        pendant.do(Delete(self._step.key))
        pendant.say("info", pendant.t("message.deleted", title=self._step.title))

    def remove(self) -> None:
        if self._group is not None:
            self._group.remove()


class _View:
    def __init__(self, pendant: Pendant):
        self.pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        state = pendant.session.state
        self._rows: list[_Row] = []
        self._steps: tuple[Step, ...] = ()
        self._modes = {mode.title: key for key, mode in catalog.members(MODES, "MODE").items()}
        self._mode = gui.add_dropdown(
            t("tool.mode"), tuple(self._modes), initial_value=mode_named(state.mode).title
        )
        pendant.changed(self._mode, "mode", self._choose_mode)
        mode = mode_named(state.mode)
        self._touches = gui.add_number(
            t("tool.touches"), state.touches, min=mode.least_touches, max=mode.most_touches, step=1
        )
        pendant.changed(self._touches, "touches", self._choose_touches)
        self._methods = {t(f"tool.method_{key}") if key in _NAMED else key: key for key in METHODS}
        self._method = gui.add_dropdown(
            t("tool.method"), tuple(self._methods), initial_value=self._method_label(state.method)
        )
        pendant.changed(self._method, "method", self._choose_method)
        self._next = gui.add_html("")
        self._assist = gui.add_button(t("tool.assist_none"), hint=t("tool.assist_hint"), color="gray")
        pendant.clicked(self._assist, self._help)
        self._result_folder = gui.add_folder(t("tool.result"), visible=False)
        with self._result_folder:
            self._light = gui.add_html("")
            self._name = gui.add_text(t("tool.name"), t("tool.first_name", number=len(state.tools) + 1))
            self._decide = gui.add_button_group(t("tool.decide"), (t("tool.accept"), t("tool.cancel")))
            self._again = gui.add_button(t("tool.again"), visible=False)
            self._result = gui.add_html("")
        pendant.clicked(self._again, self._cancel)
        jobs = {t("tool.accept"): self._accept, t("tool.cancel"): self._cancel}
        pendant.chosen(self._decide, lambda label: jobs[label]())
        self.list_folder = gui.add_folder(t("tool.points"))
        self._calculate = gui.add_button(t("tool.calculate"))
        pendant.clicked(self._calculate, self._solve)
        history = gui.add_button_group(t("tool.history"), (t("tool.undo"), t("tool.redo")))
        steps = {t("tool.undo"): self._undo, t("tool.redo"): self._redo}
        pendant.chosen(history, lambda label: steps[label]())
        with gui.add_folder(t("tool.examples")):
            paper = gui.add_button(t("tool.paper"), hint=t("tool.paper_hint"))
            pendant.clicked(paper, lambda: play_paper_table(pendant))
            upload = gui.add_upload_button(t("tool.upload"), mime_type="text/csv")

            @upload.on_upload
            async def _(event) -> None:
                file = event.target.value
                pendant.post(lambda: play_upload(pendant, file.name, file.content))

    # What somebody does ----------------------------------------------------------------------------------

    def record(self, step: Step) -> None:
        pendant = self.pendant
        state = pendant.session.state
        action = ReRecord if step.key in state.captures else Record
        pendant.do(action(step.key, as_tuple(pendant.q)))
        far = pendant.world.distance(pendant.q)
        if "touch" in step.roles and far > pendant.world.contact_distance:
            pendant.say("warning", pendant.t("message.recorded_far", title=step.title, mm=f"{mm(far):.1f}"))
        else:
            pendant.say("good", pendant.t("message.recorded", title=step.title))

    def go_to(self, step: Step) -> None:
        pendant = self.pendant
        q = joints_of(pendant, pendant.session.state.captures[step.key], pendant.q)
        if q is not None:
            pendant.go(q, lambda: pendant.say("info", pendant.t("message.went", title=step.title)))

    def _help(self) -> None:
        """Does what a careful hand would do for the next point."""
        pendant = self.pendant
        state = pendant.session.state
        step = state.missing[0] if state.missing else None
        axis = step.role if step is not None and step.role in _AXES else None
        origin = next((c for c in state.ordered if "origin" in c.roles), None)
        if step is not None and axis is not None and origin is not None:
            start = joints_of(pendant, origin, pendant.q)
            if start is None:
                return
            found = pendant.world.stroke(start, _AXES[axis], _STROKE, pendant.rng)
            words = pendant.t("message.stroked", mm=f"{mm(_STROKE):.0f}", axis=axis.upper(), title=step.title)
        else:
            found = pendant.world.touch(pendant.q, pendant.rng)
            words = pendant.t("message.touched", title=step.title if step else "")
        if not found.reached:
            pendant.say("warning", pendant.t("message.not_reached", reason=pendant.why(found)))
            return
        pendant.go(found.q, lambda: pendant.say("info", words))

    def _solve(self) -> None:
        pendant = self.pendant
        calculate(pendant)

    def _accept(self) -> None:
        pendant = self.pendant
        state = pendant.do(Accept(self._name.value))
        if state.tool is not None:
            pendant.stage.view("whole")
            pendant.say("good", pendant.t("message.accepted", name=state.tool.name))

    def _cancel(self) -> None:
        self.pendant.do(Cancel())
        self.pendant.stage.view("whole")
        self.pendant.say("info", self.pendant.t("message.cancelled"))

    def _undo(self) -> None:
        self.pendant.do(Undo())
        self.pendant.say("info", self.pendant.t("message.undone"))

    def _redo(self) -> None:
        self.pendant.do(Redo())
        self.pendant.say("info", self.pendant.t("message.redone"))

    def _choose_mode(self, title: str) -> None:
        pendant = self.pendant
        state = pendant.do(ChooseMode(self._modes[title]))
        pendant.say("info", pendant.t("message.mode", title=title, count=len(state.steps)))

    def _choose_touches(self, value: float) -> None:
        pendant = self.pendant
        state = pendant.do(ChooseMode(pendant.session.state.mode, int(value)))
        title = mode_named(state.mode).title
        pendant.say("info", pendant.t("message.mode", title=title, count=len(state.steps)))

    def _choose_method(self, label: str) -> None:
        self.pendant.do(ChooseMethod(self._methods[label]))

    # What is shown ---------------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        t = self.pendant.t
        mode = mode_named(state.mode)
        self._mode.value = mode.title
        self._touches.min, self._touches.max = mode.least_touches, mode.most_touches
        self._touches.value = state.touches
        self._method.value = self._method_label(state.method)
        if state.steps != self._steps:
            for row in self._rows:
                row.remove()
            self._steps = state.steps
            self._rows = [_Row(self, step, number) for number, step in enumerate(state.steps)]
        for row in self._rows:
            row.refresh(state)
        done = state.result is not None
        self._result_folder.visible = done
        self._mode.visible = self._touches.visible = self._method.visible = not done
        self._next.visible = self._assist.visible = self._calculate.visible = not done
        taken = accepted(state)
        self._name.visible = self._decide.visible = not taken
        self._again.visible = taken
        self._calculate.disabled = bool(state.missing)
        if state.result is not None:
            self._light.content = light_html(state.result)
            self._result.content = result_html(self.pendant, state.result)
        else:
            self._instruct(state)
        if not state.missing:
            self._assist.label = t("tool.assist_none")

    def _instruct(self, state: SessionState) -> None:
        t = self.pendant.t
        if not state.missing:
            self._next.content = html.paragraph(t("tool.ready"), testid="next")
            return
        step = state.missing[0]
        title = html.escape(t("tool.next", title=step.title))
        self._next.content = html.block(
            f'<div style="font-weight:600">{title}</div><div style="opacity:.8">{html.escape(step.instruction)}</div>',
            testid="next",
            style="border-left:4px solid #d66014;margin:6px 10px;min-height:54px",
        )
        if step.role in _AXES:
            self._assist.label = t("tool.assist_stroke", mm=f"{mm(_STROKE):.0f}", axis=step.role.upper())
        else:
            self._assist.label = t("tool.assist_touch")

    def _method_label(self, key: str) -> str:
        return next(label for label, method in self._methods.items() if method == key)

    def close(self) -> None:
        pass


_NAMED = ("joint", "pairwise", "robust")


def joints_of(pendant: Pendant, capture: Capture, start: np.ndarray) -> np.ndarray | None:
    """Joints of a recorded point; by inverse kinematics where only its pose is known, and None (said) without."""
    if capture.q is not None:
        return np.array(capture.q)
    from app.kinematics import solve_ik

    best = None
    for q in (start, pendant.model.home):
        found = solve_ik(pendant.model, capture.T_base_flange, q, max_steps=200)
        if found.reached:
            return found.q
        best = found
    if best is not None:
        pendant.say("warning", pendant.t("message.not_reached", reason=pendant.why(best)))
    return None


class _Tool:
    key, order = "tool", 0

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


SCREEN = _Tool()
