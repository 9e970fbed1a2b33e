"""Numbers instead of points: the fields of a tool frame that is typed in, in the maker's convention."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from app.geometry import CONVENTIONS, Pose
from app.screens._tool.words import Words
from app.session import SessionState
from app.session.actions import Enter
from app.session.state import DIRECT, as_tuple
from app.units import deg, from_deg, from_mm, mm

if TYPE_CHECKING:
    from app.screens.context import Context


class DirectEntry:
    """Three lengths and the angles, shown while the mode is direct entry.

    Args:
        context: where it is shown.
        words: whose names the angles have.
    """

    def __init__(self, context: Context, words: Words):
        self._context, self._words = context, words
        self._folder = context.ui.add_folder(context.t("tool.direct"), visible=False)
        self._form = CONVENTIONS[context.convention]
        self._in_degrees = True
        self._fields: list[Any] = []
        self._shown: Enter | None = None

    def refresh(self, state: SessionState) -> None:
        """Shows the fields in the convention that is chosen, with what was typed before."""
        wanted = state.mode == DIRECT and state.result is None
        self._folder.visible = wanted
        if not wanted:
            return
        form = CONVENTIONS[self._context.convention]
        if not self._fields or form is not self._form:
            pose = self._pose() if self._fields else _known(state)
            self._make(form, pose)
        elif state.entered is not self._shown and state.entered is not None:
            self._make(form, _known(state))
        self._shown = state.entered

    def action(self) -> Enter:
        """What stands in the fields, as an action."""
        numbers = np.array([float(field.value) for field in self._fields])
        angles = from_deg(numbers[3:]) if self._in_degrees else numbers[3:]
        x, y, z = (float(v) for v in from_mm(numbers[:3]))
        return Enter((x, y, z), as_tuple(angles), self._form.key)

    def _make(self, form: Any, pose: Pose) -> None:
        for field in self._fields:
            field.remove()
        self._form = form
        self._in_degrees = form.angular and not self._words.radians(form.key)
        numbers = form.from_rotation(pose.rotation)
        shown = np.round(deg(numbers), 4) if self._in_degrees else np.round(numbers, 9)
        ui, unit = self._context.ui, " [°]" if self._in_degrees else " [rad]" if form.angular else ""
        with self._folder:
            self._fields = [
                ui.add_number(f"{axis} [mm]", float(round(v, 4)), step=0.001)
                for axis, v in zip("XYZ", mm(pose.position), strict=True)
            ]
            self._fields += [
                ui.add_number(f"{name}{unit}", float(v + 0.0), step=0.001 if self._in_degrees else 1e-6)
                for name, v in zip(self._words.angles(form.key), shown, strict=True)
            ]

    def _pose(self) -> Pose:
        """What stands in the fields, as a pose, so that another convention shows the same tool."""
        action = self.action()
        numbers = np.array(action.angles)
        if not self._form.angular and not np.linalg.norm(numbers) > 0.0:
            return Pose.of(None, np.array(action.position))
        return Pose.of(self._form.to_rotation(numbers), np.array(action.position))


def _known(state: SessionState) -> Pose:
    """Where typing starts: what was typed before, else the active tool, else the flange."""
    if state.entered is not None:
        rotation = CONVENTIONS[state.entered.convention].to_rotation(np.array(state.entered.angles))
        return Pose.of(rotation, np.array(state.entered.position))
    return state.tool.T_flange_tool if state.tool is not None else Pose.of(None, np.zeros(3))
