"""One file a tab of the left panel: where the arm is, and what is looked at.

The same shape as a screen (app/pendant/screens), with the object named `PANEL`. A view may have `numbers()`, which is
called about five times a second while the arm moves.
"""

from __future__ import annotations

from app import catalog
from app.pendant.screens import Screen

PANELS = "app.pendant.panels"


def panels() -> list[Screen]:
    """All tabs of the left panel, in order."""
    return sorted(catalog.members(PANELS, "PANEL").values(), key=lambda panel: panel.order)
