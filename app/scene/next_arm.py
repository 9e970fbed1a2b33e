"""The arm as it would stand at the next touch: translucent, over the real one."""

from __future__ import annotations

import itertools

import numpy as np
import viser

from app.kinematics import RobotModel
from app.scene.arm import ArmView, draw_meshes
from app.scene.held_tool import held_meshes

_NUMBERS = itertools.count(1)
_SAME = 0.01  # rad or m: closer than this the ghost would only blur the arm


class NextArm:
    """A ghost that is made when it is first needed.

    Args:
        robot: what to draw.
    """

    def __init__(self, scene: viser.SceneApi, robot: RobotModel):
        self._scene, self._robot = scene, robot
        self._view: ArmView | None = None
        self._label: viser.LabelHandle | None = None
        self._q: np.ndarray | None = None
        self._away = False
        self._near = False

    def show(self, q: np.ndarray | None, words: str = "") -> None:
        """The ghost at q (n,), with a few words at its flange; None takes it away."""
        self._q = None if q is None else np.array(q, float)
        if self._label is not None:
            self._label.remove()
            self._label = None
        if self._q is not None:
            if self._view is None:
                root = f"/next{next(_NUMBERS)}"
                self._view = ArmView(self._scene, self._robot, root=root, ghost=True, tool=False)
                tool = f"{self._view.flange_path}/tool"
                draw_meshes(self._scene, tool, held_meshes(self._robot), ghost=True)
            self._view.set(self._q)
            if words:
                self._label = self._scene.add_label(
                    "/next_label",
                    words,
                    position=tuple(self._robot.forward(self._q).position),
                    font_screen_scale=0.8,
                    anchor="bottom-left",
                )
        self._set_visible()

    def arm_at(self, q: np.ndarray) -> None:
        """The real arm stands at q (n,): the ghost steps aside where both would stand in one place."""
        near = self._q is not None and float(np.abs(self._q - q).max()) < _SAME
        if near != self._near:
            self._near = near
            self._set_visible()

    def away(self, away: bool) -> None:
        """Hides the ghost while something else is shown in the arm's place."""
        self._away = away
        self._set_visible()

    @property
    def visible(self) -> bool:
        """True where the ghost is seen."""
        return self._q is not None and not self._away and not self._near

    def _set_visible(self) -> None:
        if self._view is not None:
            self._view.visible = self.visible
        if self._label is not None:
            self._label.visible = self.visible
