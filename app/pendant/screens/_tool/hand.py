"""What the program does for a careful hand: touch and stroke."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Capture, Step, of_role
from app.kinematics import solve_ik
from app.units import from_mm, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

STROKE = from_mm(150.0)
AXES = {"x": 0, "y": 1, "z": 2}
#: Roles whose point is the spike: these the hand can touch.
TOUCHED = frozenset({"touch", "origin", "known"})


def next_step(pendant: Pendant) -> Step | None:
    """The first row without a point."""
    missing = pendant.session.state.missing
    return missing[0] if missing else None


def help_along(pendant: Pendant, title: str) -> None:
    """Goes where the next point is: the orientation stays, the tip gets there within touch noise."""
    step = next_step(pendant)
    origins = of_role(pendant.session.state.ordered, "origin")
    if step is not None and step.role in AXES and origins:
        start = joints_of(pendant, origins[0])
        if start is None:
            return
        found = pendant.world.stroke(start, AXES[step.role], STROKE, pendant.rng)
        words = pendant.t("message.stroked", mm=f"{mm(STROKE):.0f}", axis=step.role.upper(), title=title)
    else:
        found = pendant.world.touch(pendant.q, pendant.rng)
        words = pendant.t("message.touched", title=title)
    if not found.reached:
        pendant.say("warning", pendant.t("message.not_reached", reason=pendant.why(found)))
        return
    pendant.go(found.q, lambda: pendant.say("info", words))


def joints_of(pendant: Pendant, capture: Capture) -> np.ndarray | None:
    """Joints of a recorded point; by inverse kinematics where only its pose is known, and None (said) without."""
    if capture.q is not None:
        return np.array(capture.q)
    found = None
    for q in (pendant.q, pendant.model.home):
        found = solve_ik(pendant.model, capture.T_base_flange, q, max_steps=200)
        if found.reached:
            return found.q
    if found is not None:
        pendant.say("warning", pendant.t("message.not_reached", reason=pendant.why(found)))
    return None
