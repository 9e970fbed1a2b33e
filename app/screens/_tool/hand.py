"""What the program does for a careful hand, while somebody holds the enabling switch: touches, strokes, and the points
of the modes that show something else to the spike."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Capture, Step, of_role
from app.kinematics import IkResult, solve_ik
from app.session.motion.guarding import hit
from app.simulation.guard import Stop
from app.simulation.pointing import POINTED, aims
from app.simulation.route import route
from app.units import from_mm, mm

if TYPE_CHECKING:
    from app.screens.context import Context

STROKE = from_mm(150.0)
AXES = {"x": 0, "y": 1, "z": 2}
#: Roles whose point is the spike: these the hand can touch.
TOUCHED = frozenset({"touch", "origin", "known"})
THERE = 1e-3  # rad or m: the arm stands where the hand brought it


class Hand:
    """A hand at the arm.

    Args:
        context: whose arm.
    """

    def __init__(self, context: Context):
        self._context = context
        self._back: tuple[str, np.ndarray] | None = (
            None  # a stroke that was made the other way, and where it ended
        )

    def went_back(self, step: Step) -> bool:
        """True where the arm stands at the end of a stroke that the hand made away from the spike."""
        if self._back is None or self._back[0] != step.key:
            return False
        return float(np.abs(self._back[1] - self._context.q).max()) < THERE

    def help_along(self, title: str) -> None:
        """Goes where the next point is: the orientation stays, the tip gets there within touch noise."""
        context, step = self._context, next_step(self._context)
        origins = of_role(context.session.state.ordered, "origin")
        if step is not None and step.role in AXES and origins:
            self._stroke(step, origins[0], title)
            return
        if step is not None and step.role in POINTED:
            self._point(step, title)
            return
        found = context.world.touch(context.q, context.rng)
        if not found.reached:
            context.say("warning", context.t("message.not_reached", reason=context.why(found)))
            return
        self._go(found.q, context.t("message.touched", title=title), context.t("errand.touch", title=title))

    def _go(self, q: np.ndarray, then: str, errand: str) -> None:
        context = self._context
        context.go(q, lambda: context.say("info", then), errand)

    def _point(self, step: Step, title: str) -> None:
        """The first of the poses that show this point which the arm reaches by a free way."""
        context = self._context
        world, captures = context.world, of_role(context.session.state.ordered, step.role)
        made = [q for capture in captures if (q := joints_of(context, capture)) is not None]
        hindered: IkResult | None = None
        for aim in aims(world, step.role, context.q, made, lambda q: hit(world, q)):
            for start in (context.q, context.model.home):
                found = world.bring(start, aim, context.rng)
                hindered = hindered or (None if found.reached else found)
                if not found.reached or isinstance(
                    route(world, context.drive.guard, context.q, found.q), Stop
                ):
                    continue
                errand = context.t("errand.go", title=title)
                self._go(found.q, context.t(f"message.shown_{step.role}", title=title), errand)
                return
        reason = context.why(hindered) if hindered is not None else context.t("message.no_free_way")
        context.say("warning", context.t("message.not_reached", reason=reason))

    def _stroke(self, step: Step, origin: Capture, title: str) -> None:
        """Along the tool's axis where that is free, else back along it: either shows the same axis."""
        context = self._context
        start = joints_of(context, origin)
        if start is None:
            return
        hindered: IkResult | Stop | None = None
        for sense in (1, -1):
            found = context.world.stroke(start, AXES[step.role], sense * STROKE, context.rng)
            if not found.reached:
                hindered = hindered or found
                continue
            way = route(context.world, context.drive.guard, context.q, found.q)
            if isinstance(way, Stop):
                hindered = hindered or way
                continue
            self._back = (step.key, found.q) if sense < 0 else None
            key = "message.stroked" if sense > 0 else "message.stroked_back"
            words = context.t(key, mm=f"{mm(STROKE):.0f}", axis=step.role.upper(), title=title)
            self._go(found.q, words, context.t("errand.stroke", title=title))
            return
        if isinstance(hindered, IkResult):
            context.say("warning", context.t("message.not_reached", reason=context.why(hindered)))
        else:
            context.say("warning", context.t("message.no_stroke", axis=step.role.upper()))


def next_step(context: Context) -> Step | None:
    """The first row without a point."""
    missing = context.session.state.missing
    return missing[0] if missing else None


def joints_of(context: Context, capture: Capture) -> np.ndarray | None:
    """Joints of a recorded point; by inverse kinematics where only its pose is known, and None (said) without."""
    if capture.q is not None:
        return np.array(capture.q)
    found = None
    for q in (context.q, context.model.home):
        found = solve_ik(context.model, capture.T_base_flange, q, max_steps=200)
        if found.reached:
            return found.q
    if found is not None:
        context.say("warning", context.t("message.not_reached", reason=context.why(found)))
    return None
