"""The arm as it would stand next, at a touch or at a pose of a run: translucent, over the real one."""

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
    """A ghost that is made when it is first needed, and seen while the screen that proposes it is open.

    Args:
        robot: what to draw.
    """

    def __init__(self, scene: viser.SceneApi, robot: RobotModel):
        self._scene, self._robot, self._screen = scene, robot, ""
        self._proposed: dict[str, tuple[np.ndarray, str]] = {}  # by screen
        self._view: ArmView | None = None
        self._label: viser.LabelHandle | None = None
        self._q: np.ndarray | None = None
        self._at: np.ndarray | None = None
        self._away = False
        self._near = False

    def show(self, screen: str, q: np.ndarray | None, words: str = "") -> None:
        """A screen proposes q (n,), with a few words at the ghost's flange; None takes it away."""
        if q is None:
            self._proposed.pop(screen, None)
        else:
            self._proposed[screen] = np.array(q, float), words
        if screen == self._screen:
            self._draw()

    def look(self, screen: str) -> None:
        """Another screen is open."""
        if screen != self._screen:
            self._screen = screen
            self._draw()

    def _draw(self) -> None:
        """What the open screen proposes."""
        self._q, words = self._proposed.get(self._screen, (None, ""))
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
        self._step_aside()
        self._set_visible()

    def arm_at(self, q: np.ndarray) -> None:
        """The real arm stands at q (n,): the ghost steps aside where both would stand in one place."""
        self._at = q
        if self._step_aside():
            self._set_visible()

    def _step_aside(self) -> bool:
        """Whether the ghost is out of the way; True where that changed."""
        before = self._near
        self._near = (
            self._q is not None and self._at is not None and float(np.abs(self._q - self._at).max()) < _SAME
        )
        return self._near != before

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
