"""The keyboard, as far as the page hands keys on: they come as presses and repeats, never as releases.

Measured with viser 1.1.1 in Chromium: every keydown is one trigger, the repeats of a held key included (31 of 31), a
keyup is none, and neither is a key pressed in a field or with Shift. So a held key says "p", nothing for as long as the
keyboard waits before it repeats (0.25 to 0.7 s), then "p" about 30 times a second; and letting go is only silence.

Held, it moves the arm as a held button does, but silence stops it sooner: each press is a motion that ends by itself.
One press is one increment: a word so soon after the one before that no hand could do it is a repeat, and so are all
that follow it; one that could be the first repeat or a second press waits for what comes next. The letters the page's
camera listens to (W A S D Q E, arrows) are left alone.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import viser

from app.pendant.jogging import INCREMENTS, Jog
from app.pendant.panels._jog.axes import pairs

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_AXES: tuple[Literal["1", "2", "3", "4", "5", "6", "7"], ...] = ("1", "2", "3", "4", "5", "6", "7")

_SIGNS: tuple[tuple[Literal["P", "M"], int, str], ...] = (
    ("P", 1, "jog.key_plus"),
    ("M", -1, "jog.key_minus"),
)


KEY_SILENCE = 0.2  # seconds after a key's last word at which the arm stands
_REPEATS = 0.12  # seconds between two words that only a held key can speak
_FIRST_REPEAT = 0.75  # seconds: the longest a keyboard waits before a held key repeats
_WAITS = "key"  # the timer of a word that may be a second press


class Keys:
    """Digits choose the axis, P and M move it, Escape is the emergency stop.

    Args:
        pendant: whose arm moves.
        stopped: what an emergency stop does to the page.
    """

    def __init__(self, pendant: Pendant, stopped: Callable[[], None]):
        self._pendant, self.axis = pendant, 0
        self._last: tuple[Jog | None, float] = None, -float("inf")  # what was heard last, and when
        self._repeats = False
        gui, t, jogging = pendant.client.gui, pendant.t, pendant.jogging
        self._commands = [gui.add_command(t("jog.stop"), hotkey="escape")]

        @self._commands[0].on_trigger
        async def _(event: viser.CommandEvent) -> None:
            jogging.stop()  # at once: an emergency does not queue
            pendant.post(stopped)

        for key, sign, name in _SIGNS:
            command = gui.add_command(t(name), hotkey=key)
            self._commands.append(command)

            @command.on_trigger
            async def _(event: viser.CommandEvent, sign: int = sign) -> None:
                known = pairs(pendant)
                if self.axis < len(known):
                    self._hear(Jog(jogging.frame, known[self.axis][0], sign))

        for number, key in enumerate(_AXES[: max(6, pendant.model.joint_count)]):
            command = gui.add_command(t("jog.key_axis", number=number + 1), hotkey=key)
            self._commands.append(command)

            @command.on_trigger
            async def _(event: viser.CommandEvent, number: int = number) -> None:
                self.axis = number  # at once: the key that moves it may come before the worker gets to say so
                pendant.post(lambda: self._say(number))

    def _hear(self, jog: Jog) -> None:
        """A key came, pressed or repeated; on the event loop."""
        jogging, worker = self._pendant.jogging, self._pendant.worker
        (before, at), now = self._last, time.monotonic()
        self._last = jog, now
        if INCREMENTS[jogging.increment] is None:
            jogging.hear(jog, KEY_SILENCE)
        elif jog != before or now - at > _FIRST_REPEAT:
            self._repeats = False
            self._press(jog)
        elif self._repeats or now - at <= _REPEATS:
            self._repeats = True
            worker.halt(_WAITS)
        else:
            worker.later(_WAITS, _REPEATS, lambda: self._press(jog))

    def _press(self, jog: Jog) -> None:
        jogging = self._pendant.jogging
        jogging.let_go()
        jogging.hear(jog, KEY_SILENCE)

    def _say(self, number: int) -> None:
        pendant = self._pendant
        known = pairs(pendant)
        if number < len(known):
            pendant.say("info", pendant.t("message.key_axis", name=known[number][1]))

    def remove(self) -> None:
        """The page goes away: viser's own reset keeps commands."""
        for command in self._commands:
            command.remove()
