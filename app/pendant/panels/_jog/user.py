"""The user frame's folder: typed as numbers, or taught by three points the tool is brought to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.geometry import CONVENTIONS, Pose
from app.pendant.user_frame import taught, user_frame
from app.session import SessionState
from app.session.actions import SetUserFrame
from app.session.state import as_tuple
from app.units import deg, from_deg, from_mm, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_FARTHEST_MM = 10_000.0
_ANGLES = CONVENTIONS["ZYX"]
_POINTS = ("origin", "on_x", "on_y")


class UserFrame:
    """Fields and buttons; visible while the user frame is jogged.

    Args:
        pendant: whose frame.
    """

    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        self._shown, self._typing = pendant.session.state.user_frame, False
        self._points: dict[str, np.ndarray] = {}
        self._folder = gui.add_folder(t("jog.user"), visible=False)
        with self._folder:
            self._place = gui.add_vector3(t("jog.user_place"), (0.0, 0.0, 0.0), step=0.1)
            self._turn = gui.add_vector3(t("jog.user_turn"), (0.0, 0.0, 0.0), step=0.1)
            pendant.entered(self._place, "user_place", lambda _: self._typed())
            pendant.entered(self._turn, "user_turn", lambda _: self._typed())
            teach = {t(f"jog.user_{key}"): key for key in _POINTS}
            group = gui.add_button_group(t("jog.user_teach"), tuple(teach), hint=t("jog.user_hint"))
            pendant.chosen(group, lambda label: self._teach(teach[label], label))
            table = gui.add_button(t("jog.user_table"), color="gray")
            pendant.clicked(table, lambda: pendant.do(SetUserFrame()))
        self._write()

    def show(self, visible: bool) -> None:
        """With its axes in the cell, or neither."""
        self._folder.visible = visible
        self._pendant.stage.user.show(user_frame(self._pendant) if visible else None)

    def _typed(self) -> None:
        rotation = _ANGLES.to_rotation(from_deg(np.array(self._turn.value, float)))
        place = np.clip(np.array(self._place.value, float), -_FARTHEST_MM, _FARTHEST_MM)
        self._typing = True  # what stands in the fields stays as it was typed
        try:
            self._set(Pose.of(rotation, from_mm(place)))
        finally:
            self._typing = False

    def _teach(self, key: str, label: str) -> None:
        pendant = self._pendant
        self._points[key] = pendant.hand().position
        missing = [pendant.t(f"jog.user_{k}") for k in _POINTS if k not in self._points]
        if missing:
            pendant.say("info", pendant.t("message.user_point", point=label, missing=", ".join(missing)))
            return
        points, self._points = self._points, {}
        origin, on_x, on_y = (points[k] for k in _POINTS)
        self._set(taught(origin, on_x, on_y, pendant.t("message.user_line")))
        pendant.say("good", pendant.t("message.user_taught"))

    def _set(self, T_base_user: Pose) -> None:
        x, y, z = as_tuple(T_base_user.position)
        a, b, c, d = as_tuple(T_base_user.quaternion)
        self._pendant.do(SetUserFrame((x, y, z), (a, b, c, d)))

    def refresh(self, state: SessionState) -> None:
        """Shows the frame where it changed."""
        if state.user_frame is not self._shown:
            self._shown = state.user_frame
            if not self._typing:
                self._write()
            if self._folder.visible:
                self._pendant.stage.user.show(user_frame(self._pendant))

    def _write(self) -> None:
        frame = user_frame(self._pendant)
        x, y, z = (round(float(v), 2) for v in mm(frame.position))
        a, b, c = (round(float(v), 2) for v in deg(_ANGLES.from_rotation(frame.rotation)))
        self._place.value, self._turn.value = (x, y, z), (a, b, c)
