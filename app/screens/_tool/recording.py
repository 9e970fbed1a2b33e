"""Recording a point: refused while the arm moves and where a stroke did not happen, warned of in the air."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Step, of_role
from app.errors import ActionRefusedError
from app.geometry import angle_between
from app.screens._tool.hand import AXES
from app.session.actions import Record, ReRecord
from app.session.state import as_tuple
from app.units import deg, from_deg, from_mm, mm

if TYPE_CHECKING:
    from app.screens.context import Context

_SHORTEST = from_mm(
    20.0
)  # a stroke shorter than this shows no direction: 0.3 mm of noise turn it by a degree
_TURNED = from_deg(3.0)  # a stroke in which the tool turned by more shows another direction


class Recording:
    """Records the pose where the arm stands.

    Args:
        context: whose arm.
    """

    def __init__(self, context: Context):
        self._context = context

    def record(self, step: Step, *, back: bool = False) -> None:
        """Records a step, again where it was recorded before.

        Args:
            step: in the operator's words.
            back: the stroke was made the other way, away from the spike.

        Raises:
            ActionRefusedError: the arm moves or is not the one that is shown, or the stroke did not happen.
        """
        context = self._context
        if context.seen is not None:
            raise ActionRefusedError(context.t("refused.other_arm"))
        if context.drive.how == "moving":
            raise ActionRefusedError(context.t("refused.moving"))
        if step.role in AXES:
            self.check_stroke(step)
        action = ReRecord if step.key in context.session.state.captures else Record
        context.do(action(step.key, as_tuple(context.q), back=back and step.role in AXES))
        far = context.world.off(context.q, step.roles)
        if context.aids.light and far > context.world.contact_distance:
            key = "message.recorded_far" if context.aids.distance else "message.recorded_off"
            key += "_plate" if step.role == "plane" else ""
            context.say("warning", context.t(key, title=step.title, mm=f"{mm(far):.1f}"))
        else:
            context.say("good", context.t("message.recorded", title=step.title))

    def check_stroke(self, step: Step) -> None:
        """Raises ActionRefusedError where the arm did not go along one line from the touch that strokes start from."""
        context = self._context
        origins = of_role(context.session.state.ordered, "origin")
        if not origins:
            raise ActionRefusedError(context.t("refused.no_origin", title=step.title))
        start, now = origins[0].T_base_flange, context.model.forward(context.q)
        turned = float(angle_between(start.rotation, now.rotation))
        if turned > _TURNED:
            raise ActionRefusedError(context.t("refused.turned", title=step.title, deg=f"{deg(turned):.1f}"))
        moved = float(np.linalg.norm(now.position - start.position))
        if moved < _SHORTEST:
            raise ActionRefusedError(context.t("refused.no_stroke", title=step.title, mm=f"{mm(moved):.0f}"))
