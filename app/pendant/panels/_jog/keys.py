"""The keyboard, as far as the page hands keys on: they come as presses and repeats, never as releases.

A held key repeats, so it moves the arm as a held button does, and silence stops it all the same. The letters the
page's camera listens to (W A S D Q E, arrows) are left alone.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import viser

from app.pendant.jogging import SILENCE, Jog

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_AXES: tuple[Literal["1", "2", "3", "4", "5", "6", "7"], ...] = ("1", "2", "3", "4", "5", "6", "7")

_SIGNS: tuple[tuple[Literal["P", "M"], int, str], ...] = (
    ("P", 1, "jog.key_plus"),
    ("M", -1, "jog.key_minus"),
)


class Keys:
    """Digits choose the axis, P and M move it, Escape is the emergency stop.

    Args:
        pendant: whose arm moves.
        stopped: what an emergency stop does to the page.
    """

    def __init__(self, pendant: Pendant, stopped: Callable[[], None]):
        self._pendant, self.axis = pendant, 0
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
                if self.axis < self._count:
                    jogging.hear(Jog(jogging.frame, self.axis, sign), SILENCE)  # no release is ever said

        for number, key in enumerate(_AXES[: max(6, pendant.model.joint_count)]):
            command = gui.add_command(t("jog.key_axis", number=number + 1), hotkey=key)
            self._commands.append(command)

            @command.on_trigger
            async def _(event: viser.CommandEvent, number: int = number) -> None:
                pendant.post(lambda: self._choose(number))

    @property
    def _count(self) -> int:
        return self._pendant.model.joint_count if self._pendant.jogging.frame == "joint" else 6

    def _choose(self, number: int) -> None:
        self.axis = number
        pendant = self._pendant
        if number < self._count:
            names = [f"J{k + 1}" for k in range(self._count)]
            name = (
                names[number]
                if pendant.jogging.frame == "joint"
                else ("X", "Y", "Z", "RX", "RY", "RZ")[number]
            )
            pendant.say("info", pendant.t("message.key_axis", name=name))

    def remove(self) -> None:
        """The page goes away: viser's own reset keeps commands."""
        for command in self._commands:
            command.remove()
