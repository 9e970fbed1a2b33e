"""Jogging: enabling switch, emergency stop, frame, increment, override, and six pairs of buttons to hold."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import viser

from app.pendant import html
from app.pendant.jogging import FRAMES, INCREMENTS, Jog
from app.pendant.panels._jog.axes import pairs
from app.pendant.panels._jog.keys import Keys
from app.pendant.panels._jog.user import UserFrame
from app.session import SessionState

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_HOLD_HZ = 15.0
#: Two tones, so that a pair reads as a pair.
_TONES = {-1: (134, 142, 150), 1: (73, 80, 87)}


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        gui, t, jogging = pendant.client.gui, pendant.t, pendant.jogging
        self._stop = gui.add_button(t("jog.stop"), color="red")

        @self._stop.on_click
        async def _(event: viser.GuiEvent) -> None:
            jogging.stop()  # at once: an emergency does not queue
            pendant.post(self._stopped)

        self._release = gui.add_button(t("jog.release"), color="yellow", visible=False)
        pendant.clicked(self._release, self._released)
        self._enable = gui.add_checkbox(t("jog.enable"), jogging.enabled, hint=t("jog.enable_hint"))
        pendant.changed(self._enable, "enable", self._enabled)
        frames = {t(f"jog.frame_{key}"): key for key in FRAMES}
        first = next(title for title, key in frames.items() if key == jogging.frame)
        frame = gui.add_dropdown(t("jog.frame"), tuple(frames), initial_value=first)
        pendant.changed(frame, "frame", lambda title: self._choose(frames[title]))
        steps = {t(f"jog.step_{key}"): key for key in INCREMENTS}
        first = next(title for title, key in steps.items() if key == jogging.increment)
        step = gui.add_dropdown(t("jog.step"), tuple(steps), initial_value=first)
        pendant.changed(step, "increment", lambda title: setattr(jogging, "increment", steps[title]))
        speed = gui.add_slider(t("jog.override"), 1, 100, 1, round(100 * jogging.override))
        pendant.changed(speed, "override", lambda value: setattr(jogging, "override", value / 100.0))
        self._user = UserFrame(pendant)
        self._user.show(jogging.frame == "user")
        self._folder = gui.add_folder(t("jog.hold"))
        self._buttons: list[Any] = []
        self._lay()
        gui.add_html(html.paragraph(t("jog.keys"), faint=True, testid="keys"))
        self._keys = Keys(pendant, self._stopped)

    def _lay(self) -> None:
        """A pair of buttons an axis; viser's buttons are as wide as the panel, so they stand below each other."""
        for button in self._buttons:
            button.remove()
        self._buttons = []
        pendant, gui = self._pendant, self._pendant.client.gui
        with self._folder:
            for axis, name in pairs(pendant):
                for sign, mark in ((-1, "−"), (1, "+")):
                    button = gui.add_button(f"{name} {mark}", color=_TONES[sign])
                    jog = Jog(pendant.jogging.frame, axis, sign)

                    @button.on_hold(callback_hz=_HOLD_HZ)
                    async def _(event: viser.GuiEvent, jog: Jog = jog) -> None:
                        pendant.jogging.hear(jog)

                    @button.on_click  # comes when the button is let go
                    async def _(event: viser.GuiEvent) -> None:
                        pendant.jogging.let_go()

                    self._buttons.append(button)

    def _choose(self, frame: str) -> None:
        self._pendant.jogging.frame = frame
        self._user.show(frame == "user")
        self._lay()
        self._pendant.page.numbers()

    def _enabled(self, on: bool) -> None:
        pendant = self._pendant
        if on and pendant.jogging.stopped:
            self._enable.value = False
            pendant.say("error", pendant.t("message.e_stop"))
            return
        pendant.jogging.enabled = on
        pendant.say("info", pendant.t("message.enabled" if on else "message.locked"))
        pendant.page.numbers()

    def _stopped(self) -> None:
        pendant = self._pendant
        self._enable.value = False
        self._stop.visible, self._release.visible = False, True
        pendant.settle()
        pendant.say("error", pendant.t("message.e_stop"))
        pendant.page.numbers()

    def _released(self) -> None:
        pendant = self._pendant
        pendant.jogging.stopped = False
        self._stop.visible, self._release.visible = True, False
        pendant.say("info", pendant.t("message.e_released"))
        pendant.page.numbers()

    def refresh(self, state: SessionState) -> None:
        self._user.refresh(state)

    def close(self) -> None:
        self._keys.remove()


class _Jog:
    key, order = "jog", 5

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


PANEL = _Jog()
