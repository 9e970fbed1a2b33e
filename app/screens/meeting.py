"""Which bodies meet, for the colour that lies over them."""

from __future__ import annotations

from app.scene.met import How
from app.session.motion.drive import Drive
from app.simulation.held import held_shapes


def meeting(drive: Drive, told: bool) -> tuple[How | None, tuple[str, str]]:
    """How two bodies meet where the arm stands, and their names; None where none do.

    Args:
        told: whether the operator is told that the tip touches.
    """
    stop = drive.met
    if stop is not None and stop.kind == "hit":
        return "hit", (stop.a, stop.b)
    if told and drive.world.touching(drive.q):
        held = held_shapes(drive.model)
        return "touch", (held[-1].link.replace("_", " ") if held else "", "spike")
    return None, ("", "")
