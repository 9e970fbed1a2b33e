"""Joints as sliders with number fields, where the tool is, and where to look from."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from app.geometry import CONVENTIONS
from app.pendant import html
from app.pendant.scene.camera import CLOSE_UPS, VIEWS
from app.pendant.screens._tool.words import Words
from app.session import SessionState
from app.units import deg, from_deg, from_mm, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_HAIR = 1e-4  # of a tenth: 180 degrees written in radians are still 180
_OWN = 0.4  # seconds a slider is left alone after somebody moved it
_HANDLES = {"handle_both": (True, True), "handle_shift": (True, False), "handle_turn": (False, True)}


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        gui, t, robot = pendant.client.gui, pendant.t, pendant.model
        self._sliders, self._touched = [], [0.0] * robot.joint_count
        for k, joint in enumerate(robot.joints):
            to_screen = mm if joint.prismatic else deg
            low, high = float(to_screen(joint.lower)), float(to_screen(joint.upper))
            low, high = np.ceil(low * 10 - _HAIR) / 10, np.floor(high * 10 + _HAIR) / 10
            value = float(np.clip(round(float(to_screen(pendant.q[k])), 1), low, high))
            slider = gui.add_slider(t("move.joint", number=k + 1), float(low), float(high), 0.1, value)
            pendant.entered(slider, f"joint{k}", lambda v, k=k: self._joint(k, v), slider=True)
            self._sliders.append(slider)
        pendant.clicked(gui.add_button(t("move.home")), self._home)
        self._readout = gui.add_html("")
        self._forms = Words(pendant).conventions()
        self._angles = gui.add_dropdown(
            t("move.convention"),
            tuple(self._forms),
            initial_value=next(t for t, key in self._forms.items() if key == pendant.convention),
        )
        pendant.changed(self._angles, "angles", self._convention)
        if pendant.aids.handle:
            handles = {t(f"move.{key}"): parts for key, parts in _HANDLES.items()}
            group = gui.add_button_group(t("move.handle"), tuple(handles))
            pendant.chosen(group, lambda label: self._handle(*handles[label]))
        views = {t(f"move.view_{key}"): key for key in VIEWS if pendant.aids.closeup or key not in CLOSE_UPS}
        group = gui.add_button_group(t("move.view"), tuple(views))
        pendant.chosen(group, lambda label: pendant.stage.view(views[label]))

    def _joint(self, k: int, value: float) -> None:
        pendant = self._pendant
        self._touched[k] = time.monotonic()
        q = pendant.q.copy()
        q[k] = from_mm(value) if pendant.model.joints[k].prismatic else from_deg(value)
        pendant.place(q)

    def _home(self) -> None:
        pendant = self._pendant
        pendant.go(pendant.model.home, lambda: pendant.say("info", pendant.t("message.home")))

    def _convention(self, title: str) -> None:
        self._pendant.convention = self._forms[title]
        self._pendant.keep_look()
        self._pendant.page.refresh(self._pendant.session.state)

    def _handle(self, shift: bool, turn: bool) -> None:
        self._pendant.stage.handle.allow(shift=shift, turn=turn)

    def numbers(self) -> None:
        pendant = self._pendant
        now = time.monotonic()
        for k, (slider, joint) in enumerate(zip(self._sliders, pendant.model.joints, strict=True)):
            if now - self._touched[k] > _OWN and not pendant.typing(f"joint{k}"):
                value = mm(pendant.q[k]) if joint.prismatic else deg(pendant.q[k])
                shown = float(np.clip(round(float(value), 1), slider.min, slider.max))
                if slider.value != shown:  # setting it wakes the event loop, changed or not
                    slider.value = shown
        state = pendant.session.state
        flange = pendant.world.shown_flange(pendant.q)
        pose = flange @ state.tool.T_flange_tool if state.tool else flange
        form = CONVENTIONS[pendant.convention]
        numbers = form.from_rotation(pose.rotation)
        words = Words(pendant)
        if not form.angular:
            shown = [f"{v:.5f}" for v in numbers]
        elif words.radians(form.key):
            shown = [f"{v:.4f} rad" for v in numbers]
        else:
            shown = [f"{v:.2f}°" for v in deg(numbers)]
        names = words.angles(form.key)
        lengths = [f"{v:.2f} mm" for v in mm(pose.position)]
        rows = []
        for row in range(max(3, len(names))):
            left = ("XYZ"[row], lengths[row]) if row < 3 else ("", "")
            rows.append(
                (*left, names[row] if row < len(names) else "", shown[row] if row < len(shown) else "")
            )
        title = pendant.t("move.position" if state.tool else "move.flange")
        self._readout.content = html.block(
            f'<div style="font-weight:600;opacity:.75;margin-top:4px">{html.escape(title)}</div>'
        ) + html.table(rows, testid="readout", widths=("10%", "40%", "12%", "38%"))

    def refresh(self, state: SessionState) -> None:
        pass

    def close(self) -> None:
        pass


class _Move:
    key, order = "move", 0

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


PANEL = _Move()
