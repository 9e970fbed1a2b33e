"""The user frame: on the table's corner until somebody types or teaches another."""

from __future__ import annotations

import numpy as np

from app.errors import ActionRefusedError
from app.geometry import Pose
from app.session.state import SessionState
from app.simulation.cell_shapes import table_corner
from app.simulation.world import World
from app.units import from_mm

_APART = from_mm(20.0)  # taught points nearer than this give no direction


def user_frame(state: SessionState, world: World) -> Pose:
    """T_base_user."""
    own = state.user_frame
    return Pose.of(None, table_corner(world)) if own is None else own


def taught(origin: np.ndarray, on_x: np.ndarray, on_y: np.ndarray, words: str) -> Pose:
    """T_base_user from three points (3,) [m]: the origin, one on +X, one on the side of +Y.

    Raises:
        ActionRefusedError: with `words`, where the points are too near each other or on one line.
    """
    x, towards = on_x - origin, on_y - origin
    z = np.cross(x, towards)
    if np.linalg.norm(x) < _APART or np.linalg.norm(z) < _APART * np.linalg.norm(x):
        raise ActionRefusedError(words)
    x, z = x / np.linalg.norm(x), z / np.linalg.norm(z)
    return Pose.of(np.stack([x, np.cross(z, x), z], axis=1), origin)
