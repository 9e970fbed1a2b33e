"""What the program does for a careful hand: touch, stroke, the proposed touch, the check turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Capture, Step, of_role
from app.calibration.next_touch import propose
from app.calibration.verify import verify
from app.kinematics import CollisionWorld, solve_ik
from app.pendant.scene.cell import cell_shapes
from app.pendant.scene.held_tool import held_shapes
from app.simulation.world import default_tool
from app.units import from_mm, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

STROKE = from_mm(150.0)
AXES = {"x": 0, "y": 1, "z": 2}
#: Roles whose point is the spike: these the hand can touch.
TOUCHED = frozenset({"touch", "origin", "known"})
_EVERY = 4  # of the poses of a check turn, each so many-th is shown


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


def go_to_proposal(pendant: Pendant) -> None:
    """Goes to the orientation from which the next touch tells most; the tip is brought to the spike by the hand."""
    state = pendant.session.state
    touches = of_role(state.ordered, "touch")
    rotations = np.array([c.T_base_flange.rotation for c in touches]).reshape(-1, 3, 3)
    proposal = propose(
        rotations,
        tool=default_tool(pendant.model).position,
        spike=pendant.world.p_base_spike_drawn,
        touches=state.touches,
        reference=None if len(rotations) else pendant.model.forward(pendant.q).rotation,
        robot=pendant.model,
        q_near=pendant.q,
        collides=collisions(pendant).check,
    )
    if proposal.q is None:
        return
    if not np.isfinite(proposal.after):
        words = pendant.t("message.proposed_open")
    else:
        known = f"{mm(proposal.now):.2f} mm" if np.isfinite(proposal.now) else "-"
        words = pendant.t("message.proposed", now=known, after=f"{mm(proposal.after):.2f} mm")
    pendant.go(proposal.q, lambda: pendant.say("info", words))


def check_turn(pendant: Pendant) -> None:
    """Turns about the tool point that was found and says how far the tip wanders."""
    state = pendant.session.state
    if state.result is None:
        return
    world, model = pendant.world, pendant.model

    def tip(flange, q) -> np.ndarray:
        return world.tip(q).position

    found = verify(state.result.result, model.forward(pendant.q), tip, robot=model, q_start=pendant.q)
    if found.joints is None or not len(found.joints):
        pendant.say("warning", pendant.t("message.not_reached", reason=found.stopped))
        return
    inside = not np.isfinite(found.expected) or found.wander <= found.expected
    key = "message.verified" if inside else "message.verified_not"
    words = pendant.t(key, mm=f"{mm(found.wander):.2f}", most=f"{mm(found.expected):.2f}")
    stops = [*found.joints[::_EVERY], found.joints[-1]]

    def arrived(number: int) -> None:
        if number < 0:
            pendant.say("good" if inside else "warning", words)

    pendant.tour(stops, arrived, rest=0.0)


def collisions(pendant: Pendant) -> CollisionWorld:
    """The arm, its tool and the cell, for asking what would be hit."""
    robot = pendant.model
    return CollisionWorld(robot, tool_shapes=held_shapes(robot), obstacles=cell_shapes(pendant.world))


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
