"""The ways to teach a tool: one file a mode, found through its object `MODE`.

Interface: `Step`, `Capture`, `Mode`, `Demo` in app/calibration/captures.py, repeated here for those who use it.
"""

from typing import cast

from app import catalog
from app.calibration.captures import ROLES, Capture, Demo, Mode, Step
from app.calibration.result import ToolCalibration, Warning_

__all__ = ["ROLES", "Capture", "Demo", "Mode", "Step", "ToolCalibration", "Warning_", "mode", "modes"]


def modes() -> dict[str, Mode]:
    """All modes by key."""
    return catalog.members(__name__, "MODE")


def mode(key: str) -> Mode:
    """One mode.

    Raises:
        UnknownNameError: there is none of this key.
    """
    return cast(Mode, catalog.member(__name__, "MODE", key, what="mode"))
