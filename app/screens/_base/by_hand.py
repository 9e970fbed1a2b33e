"""The two-robot procedure by hand: an axis is turned by its slider, a point measured, a step left."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Protocol

import numpy as np

from app.calibration.base.wizard import ZERO
from app.screens._base.run import Run
from app.units import deg, from_deg

if TYPE_CHECKING:
    from app.screens.context import Context


class Procedure(Protocol):
    """The screen the keys stand on."""

    @property
    def run(self) -> Run | None:
        """What is being measured."""
        ...

    def begin(self, motion: Iterator[None], errand: str, what: str) -> None:
        """A motion that waits for the switch; `what` says what follows then."""
        ...

    def show(self) -> None:
        """What was measured has changed."""
        ...

    def finish(self, run: Run) -> None:
        """A step was left."""
        ...


class ByHand:
    """The folded part of the procedure.

    Args:
        context: where it stands.
        procedure: whose steps are done by hand.
    """

    def __init__(self, context: Context, procedure: Procedure):
        self._context, self._procedure = context, procedure
        ui, t = context.ui, context.t
        self.folder = ui.add_folder(t("base.by_hand"), expanded=False)
        with self.folder:
            self._angle = ui.add_slider(t("base.angle"), -170.0, 170.0, 1.0, 0.0)
            context.changed(self._angle, "base.angle", self._turn)
            keys = ui.add_buttons(t("base.point"), (t("base.measure"), t("base.leave"), t("base.undo")))
            jobs = {
                t("base.measure"): self._measure,
                t("base.leave"): self._leave,
                t("base.undo"): self._undo,
            }
            context.chosen(keys, lambda label: jobs[label]())

    def show(self, run: Run) -> None:
        """The slider for the axis of the step at hand, where it stands: the procedure may have been stopped on its way.

        Without an axis there is none.
        """
        step = run.wizard.step
        self._angle.visible = step is not None and bool(step.axis)
        if step is None or not step.axis:
            return
        arm = run.cell.arms[step.robot - 1]
        self._angle.min = float(np.ceil(deg(max(arm.robot.lower[step.axis - 1], -np.pi))))
        self._angle.max = float(np.floor(deg(min(arm.robot.upper[step.axis - 1], np.pi))))
        self._angle.value = round(deg(float(run.postures[step.robot - 1][step.axis - 1])))

    def _turn(self, degrees: float) -> None:
        run = self._procedure.run
        if run is None or (step := run.wizard.step) is None or not step.axis:
            return
        errand = self._context.t("errand.turn", axis=step.axis, robot=step.robot)
        way = self._there(run, run.turning(from_deg(float(degrees))), self._look)
        self._procedure.begin(way, errand, "base.hold_turn")

    def _there(self, run: Run, way: Iterator[None], then: Callable[[Run], None]) -> Iterator[None]:
        yield from way
        then(run)

    def _look(self, run: Run) -> None:
        """Whether the tracker sees the reflector where the arm has come to."""
        step = run.wizard.step
        if step is not None:
            sight = run.aim(step.robot - 1)
            level = "info" if sight.seen else "warning"
            self._context.say(level, self._context.t(f"base.sight_{sight.reason}"))

    def _measure(self) -> None:
        run = self._procedure.run
        if run is None or run.wizard.step is None:
            return
        self._context.drive.cancel()  # it is measured where the arm stands now
        home = run.homing() if run.wizard.step.kind == ZERO else None
        if home is None:
            self._take(run)
        else:
            errand = self._context.t("errand.zero")
            self._procedure.begin(self._there(run, home, self._take), errand, "base.hold_zero")

    def _take(self, run: Run) -> None:
        sight = run.measure()
        level = "good" if sight.seen else "warning"
        self._context.say(level, self._context.t(f"base.sight_{sight.reason}"))
        self._procedure.show()

    def _leave(self) -> None:
        run = self._procedure.run
        if run is not None and run.wizard.step is not None:
            self._context.drive.cancel()
            run.leave()
            self._procedure.finish(run)

    def _undo(self) -> None:
        run = self._procedure.run
        if run is not None and run.relation is None:
            run.undo()
            self._procedure.show()
