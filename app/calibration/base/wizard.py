"""The procedure as steps, a pure state machine: nothing here moves, measures or draws.

For each robot: fixed points, zero position, axis 1 turned, zero position again, axis 2 turned. Then the result. Whoever
drives it (pendant, simulation, test) moves the arm to what `wanted` says, measures, and records.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app.calibration.base.arcs import Arc, Arcs
from app.calibration.base.checks.too_few import NEEDED
from app.calibration.base.relation import Relation, relate
from app.calibration.base.result import BaseCalibration
from app.calibration.base.solve import solve_base
from app.calibration.base.wording import phrase, refused, remark
from app.calibration.result import Warning_
from app.kinematics import RobotModel
from app.phrases import Phrase
from app.units import deg, mm

NESTS, ZERO, TURN = "nests", "zero", "turn"
_FEWEST_NESTS = 3


@dataclass(frozen=True)
class Step:
    """One row of the wizard.

    Args:
        key: `1.axis2`.
        robot: 1 or 2.
        kind: `nests`, `zero` or `turn`.
        axis: 1 or 2 where one is turned, else 0.
        least: records it needs.
    """

    key: str
    robot: int
    kind: str
    axis: int
    least: int

    @property
    def title(self) -> Phrase:
        """What the operator reads of it."""
        return phrase(f"step.{self.kind}", robot=self.robot, axis=self.axis)

    @property
    def instruction(self) -> Phrase:
        """What is to be done."""
        return phrase(f"step.{self.kind}_do", robot=self.robot, axis=self.axis)


def steps(robots: int = 2, nests: bool = True) -> tuple[Step, ...]:
    """The procedure for one or two robots, with or without fixed points."""

    def of(robot: int) -> Iterator[Step]:
        if nests:
            yield Step(f"{robot}.nests", robot, NESTS, 0, _FEWEST_NESTS)
        for axis in (1, 2):
            yield Step(f"{robot}.zero{axis}", robot, ZERO, 0, 1)
            yield Step(f"{robot}.axis{axis}", robot, TURN, axis, NEEDED)

    return tuple(step for robot in range(1, robots + 1) for step in of(robot))


@dataclass(frozen=True, eq=False)
class Record:
    """One measured point.

    Args:
        step: key of the step it belongs to.
        point: (3,) [m] in the tracker's frame.
        angle: of the turned axis, as the controller shows it [rad]; 0 elsewhere.
        name: of a fixed point.
        sigma: the tracker's stated noise there [m].
    """

    step: str
    point: np.ndarray
    angle: float = 0.0
    name: str = ""
    sigma: float = 0.0


@dataclass(frozen=True, eq=False)
class BaseWizard:
    """Where the procedure stands. Actions give the next state.

    Args:
        steps: the plan.
        index: the step at hand; len(steps) when all are done.
        records: everything measured, in order.
    """

    steps: tuple[Step, ...]
    index: int = 0
    records: tuple[Record, ...] = ()

    @property
    def step(self) -> Step | None:
        """The step at hand, None at the end."""
        return self.steps[self.index] if self.index < len(self.steps) else None

    @property
    def done(self) -> bool:
        return self.step is None

    def of(self, key: str) -> tuple[Record, ...]:
        """Records of one step."""
        return tuple(r for r in self.records if r.step == key)

    def record(
        self, point: np.ndarray, *, angle: float = 0.0, name: str = "", sigma: float = 0.0
    ) -> BaseWizard:
        """Adds a measured point to the step at hand.

        Raises:
            ActionRefusedError: all steps are done, or the point is none.
        """
        step = self.step
        if step is None:
            raise refused("done_measuring")
        if not np.isfinite(point).all():
            raise refused("nothing_measured")
        if step.kind == NESTS and not name:
            raise refused("no_name")
        kept = self.records
        if step.kind == ZERO:  # measured again, the newer one counts
            kept = tuple(r for r in kept if r.step != step.key)
        return replace(self, records=(*kept, Record(step.key, np.array(point, float), angle, name, sigma)))

    def advance(self) -> BaseWizard:
        """On to the next step.

        Raises:
            ActionRefusedError: this one has too few records.
        """
        step = self.step
        if step is None:
            raise refused("done")
        have = len(self.of(step.key))
        if have < step.least:
            raise refused("records", step=step.title, have=have, least=step.least)
        return replace(self, index=self.index + 1)

    def undo(self) -> BaseWizard:
        """Takes the last record back, or steps back where the step at hand has none.

        Raises:
            ActionRefusedError: nothing was done yet.
        """
        step = self.step
        if step is not None and self.of(step.key):
            return replace(self, records=self.records[:-1])
        if self.index == 0:
            raise refused("undo")
        return replace(self, index=self.index - 1)

    def arcs(self, robot: int, towards: np.ndarray | None = None, senses: tuple[int, int] = (1, 1)) -> Arcs:
        """What was recorded of one robot, as `solve_base` takes it.

        Args:
            robot: 1 or 2.
            towards: (3,) [m] in front of the robot, in the tracker's frame.
            senses: +1 where the controller's angle is right-handed about Z (axis 1), Y (axis 2).
        """
        arcs = {}
        for axis in (1, 2):
            mine = self.of(f"{robot}.axis{axis}")
            points = np.array([r.point for r in mine]).reshape(-1, 3)
            angles = senses[axis - 1] * np.array([r.angle for r in mine])
            rows = np.arange(1, len(mine) + 1)
            arcs[axis] = Arc(axis, points, angles, rows, np.zeros(len(mine), int), senses[axis - 1])
        fixed: dict[str, list[np.ndarray]] = {}
        for r in self.of(f"{robot}.nests"):
            fixed.setdefault(r.name, []).append(r.point)
        sigmas = [r.sigma for r in self.records if r.sigma > 0]
        return Arcs(
            Path(f"robot {robot}"),
            arcs,
            towards=towards,
            noise=float(np.mean(sigmas)) if sigmas else None,
            references={name: np.array(p) for name, p in fixed.items()},
        )

    def solve(
        self,
        models: tuple[RobotModel | None, ...],
        senses: tuple[tuple[int, int], ...],
        towards: tuple[np.ndarray | None, ...] | None = None,
    ) -> tuple[tuple[BaseCalibration, ...], Relation | None]:
        """Bases of all robots, and their relation.

        Raises:
            ActionRefusedError: not every step is done.
            DegenerateGeometryError: the records cannot give it.
        """
        if not self.done:
            raise refused("not_done")
        fronts = towards or tuple(None for _ in models)
        bases = []
        for k, (model, sense, front) in enumerate(zip(models, senses, fronts, strict=True), 1):
            base = solve_base(self.arcs(k, front, sense), model)
            bases.append(replace(base, warnings=(*self.zero_warnings(k), *base.warnings)))
        return tuple(bases), relate(bases[0], bases[1]) if len(bases) == 2 else None

    def zero_warnings(self, robot: int) -> tuple[Warning_, ...]:
        """The reflector must come back to its place when all axes do."""
        pair = [self.of(f"{robot}.zero{axis}") for axis in (1, 2)]
        if not all(pair):
            return ()
        one, two = pair[0][-1], pair[1][-1]
        gap, noise = float(np.linalg.norm(one.point - two.point)), max(one.sigma, two.sigma)
        if noise <= 0 or gap <= 6.0 * noise:
            return ()
        return (
            remark(
                "reflector_moved",
                "reflector_zero",
                severe=True,
                robot=robot,
                gap=mm(gap),
                noise=mm(noise),
            ),
        )

    def summary(self) -> str:
        """One line a step: what is recorded, what comes next."""
        lines = []
        for k, step in enumerate(self.steps):
            mine = self.of(step.key)
            mark = "x" if k < self.index else ">" if k == self.index else " "
            span = (
                f", {deg(float(np.ptp([r.angle for r in mine]))):.0f} degrees" if step.axis and mine else ""
            )
            lines.append(f"[{mark}] {step.title}: {len(mine)} recorded{span}")
        return "\n".join(lines)
