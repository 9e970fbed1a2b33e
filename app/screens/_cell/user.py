"""The user frame's folder: typed as numbers, or taught by three points the tool is brought to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.geometry import CONVENTIONS, Pose
from app.session import SessionState
from app.session.actions import SetUserFrame
from app.session.motion.user_frame import taught, user_frame
from app.session.state import as_tuple
from app.units import deg, from_deg, from_mm, mm

if TYPE_CHECKING:
    from app.screens.context import Context

_FARTHEST_MM = 10_000.0
_ANGLES = CONVENTIONS["ZYX"]
_POINTS = ("origin", "on_x", "on_y")


class UserFrame:
    """Fields and buttons; its axes stand in the cell while the user frame is jogged.

    Args:
        context: whose frame.
    """

    def __init__(self, context: Context):
        self._context = context
        ui, t = context.ui, context.t
        self._shown, self._typing = context.session.state.user_frame, False
        self._visible = False
        self._points: dict[str, np.ndarray] = {}
        self._folder = ui.add_folder(t("jog.user"), expanded=False)
        with self._folder:
            self._place = ui.add_vector(t("jog.user_place"), (0.0, 0.0, 0.0))
            self._turn = ui.add_vector(t("jog.user_turn"), (0.0, 0.0, 0.0))
            context.changed(self._place, "user_place", lambda _: self._typed())
            context.changed(self._turn, "user_turn", lambda _: self._typed())
            teach = {t(f"jog.user_{key}"): key for key in _POINTS}
            group = ui.add_buttons(t("jog.user_teach"), tuple(teach), hint=t("jog.user_hint"))
            context.chosen(group, lambda label: self._teach(teach[label], label))
            table = ui.add_button(t("jog.user_table"), rank="plain")
            context.clicked(table, lambda: context.do(SetUserFrame()))
        self._write()

    def show(self, visible: bool) -> None:
        """With its axes in the cell, or neither."""
        self._visible = visible
        self._context.stage.user.show(
            user_frame(self._context.session.state, self._context.world) if visible else None
        )

    def show_if(self, visible: bool) -> None:
        """The same, where it is not so already."""
        if visible != self._visible:
            self.show(visible)

    def _typed(self) -> None:
        rotation = _ANGLES.to_rotation(from_deg(np.array(self._turn.value, float)))
        place = np.clip(np.array(self._place.value, float), -_FARTHEST_MM, _FARTHEST_MM)
        self._typing = True  # what stands in the fields stays as it was typed
        try:
            self._set(Pose.of(rotation, from_mm(place)))
        finally:
            self._typing = False

    def _teach(self, key: str, label: str) -> None:
        context = self._context
        self._points[key] = context.hand().position
        missing = [context.t(f"jog.user_{k}") for k in _POINTS if k not in self._points]
        if missing:
            context.say("info", context.t("message.user_point", point=label, missing=", ".join(missing)))
            return
        points, self._points = self._points, {}
        origin, on_x, on_y = (points[k] for k in _POINTS)
        self._set(taught(origin, on_x, on_y, context.t("message.user_line")))
        context.say("good", context.t("message.user_taught"))

    def _set(self, T_base_user: Pose) -> None:
        x, y, z = as_tuple(T_base_user.position)
        a, b, c, d = as_tuple(T_base_user.quaternion)
        self._context.do(SetUserFrame((x, y, z), (a, b, c, d)))

    def refresh(self, state: SessionState) -> None:
        """Shows the frame where it changed."""
        if state.user_frame is not self._shown:
            self._shown = state.user_frame
            if not self._typing:
                self._write()
            if self._visible:
                self._context.stage.user.show(user_frame(self._context.session.state, self._context.world))

    def _write(self) -> None:
        frame = user_frame(self._context.session.state, self._context.world)
        x, y, z = (round(float(v), 2) for v in mm(frame.position))
        a, b, c = (round(float(v), 2) for v in deg(_ANGLES.from_rotation(frame.rotation)))
        self._place.value, self._turn.value = (x, y, z), (a, b, c)
