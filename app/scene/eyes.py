"""The eye in the scene: one for all pages of a session, and the one a page begins with."""

from __future__ import annotations

from typing import Any

import numpy as np

from app.scene.seen import Seen
from app.scene.server import SceneServer

_USUAL = 700.0  # height of a window whose page has not said it yet [px]


class Eyes:
    """Where the pages of one session look from.

    Args:
        server: of the session's scene.
    """

    def __init__(self, server: SceneServer):
        self._server = server
        self._view = np.array([2.0, 2.0, 1.0]), np.zeros(3), 0.75

    @property
    def aspect(self) -> float:
        """Width over height of the window; before a page has said, that of a usual one."""
        cameras = [client.camera for client in self._server.get_clients().values()]
        known = [float(camera.aspect) for camera in cameras if camera.update_timestamp]
        return max(known[0], 0.2) if known else 1.0

    @property
    def known(self) -> bool:
        """True once a page has said how large its window is."""
        return any(client.camera.update_timestamp for client in self._server.get_clients().values())

    @property
    def seen(self) -> Seen:
        """The window, and what was looked at last."""
        return Seen(*self._view, *(self._server.window or (_USUAL * self.aspect, _USUAL)))

    def look(self, eye: np.ndarray, centre: np.ndarray, field: float | None = None) -> None:
        """Every page looks from here, and so does one that comes."""
        self._view = np.asarray(eye, float), np.asarray(centre, float), field or self._view[2]
        start: Any = self._server.initial_camera
        for camera in (start, *(client.camera for client in self._server.get_clients().values())):
            if field is not None:
                camera.fov = field
            if camera is not start:
                camera.up_direction = (0.0, 0.0, 1.0)
            camera.position = np.asarray(eye, float)
            camera.look_at = np.asarray(centre, float)
