"""One run of the two-robot procedure: the cell, where the wizard stands, what is drawn of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from app.calibration.base.relation import Relation
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wizard import NESTS, TURN, BaseWizard, Step, steps
from app.geometry.circle import fit_axis
from app.kinematics import RobotModel
from app.scene.instead import Instead
from app.scene.tracker_cell import CellDrawing
from app.screens._base.exam import PUSH, Exam
from app.session.motion.pace import duration, measuring, pause, travel
from app.simulation.tracker import Sight
from app.simulation.tracker_cell import TrackerCell
from app.simulation.tracker_meeting import Meeting, meet, pointer
from app.simulation.tracker_procedure import WIDEST, senses

if TYPE_CHECKING:
    from app.screens.context import Context

_FROM = np.array([-0.42, -0.74, 0.52])  # the eye's direction
_LOOKS = 13  # places on each way that are kept in view
FRAME = 0.28  # length of a base's drawn axes, in reaches of its arm
_REST = 0.12  # seconds the arm stands at each point


class Run:
    """A cell that is being measured.

    Args:
        context: whose scene, drive and language.
        cell: with its hidden truth.
        nests: fixed points are part of the procedure.
        pushed: somebody pushes the tracker before robot 2, and tells nobody.
        seed: of the tracker's noise.
        exam: the session it belongs to: its wizard, and in an exercise a drawing that stands beside the truth.
    """

    def __init__(
        self,
        context: Context,
        cell: TrackerCell,
        *,
        nests: bool,
        pushed: bool,
        seed: int,
        exam: Exam | None = None,
    ):
        self.cell = self.now = cell
        self.exam = exam
        self._drive, self._t = context.drive, context.t
        self.drawn = cell if exam is None else exam.truth.drawn
        self.wizard = BaseWizard(steps(2, nests)) if exam is None else exam.wizard
        self.bases: tuple[BaseCalibration, ...] = ()
        self.relation: Relation | None = None
        self.meeting: Meeting | None = None
        self.drawing = CellDrawing(context.stage.scene, self.drawn, context.t)
        self._push = (PUSH if pushed else None) if exam is None else exam.truth.pushed
        self._rng = np.random.default_rng(seed)
        self.postures = [arm.rest.copy() for arm in cell.arms]
        self._stations = [self.drawn.tracker.T_world_tracker] * 2
        if self.wizard.step is None or self.wizard.step.robot == 2:  # taken up again where it was left
            self._second_robot()
        for number, step in enumerate(self.wizard.steps):
            if step.kind != NESTS and self.wizard.of(step.key):
                self._draw_points(step)
            if step.kind == TURN and number < self.wizard.index:
                self._draw_circle(step)

    def seen(self) -> tuple[RobotModel, np.ndarray]:
        """The arm that is being measured, as it stands."""
        step = self.wizard.step
        arm = 1 if step is None else step.robot - 1
        return self.cell.arms[arm].robot, self.postures[arm]

    def instead(self) -> Instead:
        """What is looked at: the cell with the ways of both reflectors, and once both tools have met, the arms."""
        cell = self.drawn
        stands = [foot for arm in cell.arms for foot in _foot(arm.T_world_base.position)]
        tips = self.drawn_tips()
        if self.meeting is not None:
            joints = [
                arm.T_world_base.apply(arm.robot.chain.frames(q[None]).joint_positions[0])
                for arm, q in zip(cell.arms, self.postures, strict=True)
            ]
            # The axes that were found are drawn where axis 2 comes by axis 1, and end so far above it.
            tops = [
                points[1] + FRAME * arm.robot.reach * arm.T_world_base.rotation[:, 2]
                for arm, points in zip(cell.arms, joints, strict=True)
            ]
            return Instead(np.vstack([*joints, *stands, *tops, tips]), tips.mean(axis=0), _FROM)
        ways = [
            arm.flange(cell.posture(k, axis, angle)).apply(arm.reflector)
            for k, arm in enumerate(cell.arms)
            for axis in (1, 2)
            for angle in np.linspace(-np.pi, np.pi, _LOOKS)
        ]
        stands += _foot(cell.tracker.T_world_tracker.position)
        arm = 1 if self.wizard.step is None else self.wizard.step.robot - 1
        return Instead(np.vstack([*ways, *stands, *cell.nests]), tips[arm], _FROM)

    # What the arms and the beam do ------------------------------------------------------------------------

    def pose(self, arm: int, q: np.ndarray) -> None:
        """Arm 0 or 1 at q; the beam follows its reflector."""
        self.postures[arm] = q
        self.drawing.arms[arm].set(q)
        self.aim(arm)

    def aim(self, arm: int) -> Sight:
        """The beam on the reflector of an arm, without measuring."""
        sight = self.now.look(arm, (self.postures[0], self.postures[1]), None)
        flange = self.drawn.arms[arm].flange(self.postures[arm])
        self.drawing.beam(flange.apply(self.drawn.arms[arm].reflector), sight.seen)
        return sight

    def turning(self, angle: float) -> Iterator[None]:
        """The axis of the step at hand to `angle` [rad], the other axes to zero; by hand, while the switch is held."""
        step = self._step()
        return self._moving(step.robot - 1, self.now.posture(step.robot - 1, step.axis, angle))

    def homing(self) -> Iterator[None] | None:
        """The arm of the step at hand to the zero position in the same way; None where it stands there."""
        arm = self._step().robot - 1
        rest = self.now.arms[arm].rest
        return None if np.array_equal(self.postures[arm], rest) else self._moving(arm, rest)

    def moves(self) -> bool:
        """True where the step at hand moves its arm: an arc, or the zero position where it is not there yet."""
        step = self._step()
        return step.kind == TURN or (step.kind != NESTS and self.homing() is not None)

    def _step(self) -> Step:
        step = self.wizard.step
        assert step is not None
        return step

    # Measuring --------------------------------------------------------------------------------------------

    def measure(self) -> Sight:
        """The point at hand into the wizard; what was not seen changes nothing."""
        step = self._step()
        arm = step.robot - 1
        if step.kind == NESTS:
            number = len(self.wizard.of(step.key)) % len(self.now.nests)
            sight = self.now.nest(number, self._rng)
            self.drawing.beam(self.drawn.nests[number], sight.seen)
            if sight.point is not None:
                self._record(sight.point, 0.0, f"N{number + 1}", sight.sigma)
            return sight
        sight = self.now.look(arm, (self.postures[0], self.postures[1]), self._rng)
        if sight.point is not None:
            angle = float(self.postures[arm][step.axis - 1]) if step.kind == TURN else 0.0
            self._record(sight.point, angle, "", sight.sigma)
            self._draw_points(step)
        return sight

    def _record(self, point: np.ndarray, angle: float, name: str, sigma: float) -> None:
        if self.exam is not None:
            self.wizard = self.exam.record(point, angle, name, sigma)
        else:
            self.wizard = self.wizard.record(point, angle=angle, name=name, sigma=sigma)

    def undo(self) -> None:
        """Takes the last point back.

        Raises:
            ActionRefusedError: there is none.
        """
        self.wizard = self.wizard.undo() if self.exam is None else self.exam.undo()

    def by_itself(self, every: float, told: Callable[[], None]) -> Iterator[None]:
        """The step at hand, measured and left; `told` is called after every point.

        Args:
            every: [rad] between two points of an arc.
        """
        step = self._step()
        arm = step.robot - 1
        if step.kind == NESTS:
            with measuring(self._drive):
                for _ in range(len(self.now.nests) - len(self.wizard.of(step.key))):
                    self.measure()
                    told()
                    yield from pause(self._drive, 2 * _REST)
        else:
            angles = [float(self.now.arms[arm].rest[0])]
            if step.kind == TURN:
                angles = list(self.now.visible_angles(arm, step.axis, every, WIDEST[step.axis - 1]))
            for angle in angles:
                goal = self.now.posture(arm, step.axis, angle)
                yield from self._moving(arm, goal)
                self.measure()
                told()
                yield from pause(self._drive, _REST)
        self.leave()
        if step.kind == TURN:  # back to zero, as the document has it
            home = self.now.arms[arm].rest
            yield from self._moving(arm, home)
        told()

    def _moving(self, arm: int, goal: np.ndarray) -> Iterator[None]:
        """An arm to a posture, while the enabling switch is held and no faster than T1 allows."""
        start = self.postures[arm].copy()
        return travel(self._drive, start, goal, self._seconds(arm, start, goal), lambda q: self.pose(arm, q))

    def _seconds(self, arm: int, start: np.ndarray, goal: np.ndarray) -> float:
        points = np.array([np.zeros(3), pointer(self.cell.arms[arm])])
        return duration(self.cell.arms[arm].robot, start, goal, points)

    def leave(self) -> None:
        """On to the next step; what the step at hand gave is drawn.

        Raises:
            ActionRefusedError: it has too few points.
        """
        step = self._step()
        self.wizard = self.wizard.advance() if self.exam is None else self.exam.advance()
        if step.kind == TURN:
            self._draw_circle(step)
        after = self.wizard.step
        if after is not None and after.robot == 2 and step.robot == 1:
            self._second_robot()

    def _second_robot(self) -> None:
        """The tracker looks at robot 2 from now on: somebody may have pushed it."""
        if self._push is not None:
            self.now = self.cell.moved(self._push)
            self.drawn = self.drawn.moved(self._push)
            self.drawing.cell = self.drawn
            self.drawing.stand(self.drawn.tracker.T_world_tracker)
        self._stations[1] = self.drawn.tracker.T_world_tracker

    def solve(self) -> Relation | None:
        """Bases and relation, drawn.

        Raises:
            ActionRefusedError: steps are missing.
        """
        self.bases, self.relation = self.wizard.solve(
            tuple(a.robot for a in self.cell.arms), senses(self.cell)
        )
        self.drawing.beam(None)
        for k, base in enumerate(self.bases, 1):
            station = self._stations[k - 1]
            found = station @ base.T_tracker_base
            second = base.second.axes
            t = float((base.T_tracker_base.position - second.point) @ second.direction)
            foot = station.apply(second.point + t * second.direction)
            self.drawing.frame(
                f"base{k}",
                found,
                self._t("base.base_label", number=k),
                foot,
                FRAME * self.cell.arms[k - 1].robot.reach,
            )
        return self.relation

    def meet(self, done: Callable[[Meeting], None]) -> Iterator[None]:
        """Both tools go to one point by the relation found."""
        assert self.relation is not None
        meeting = meet(self.cell, self.relation)
        start = [q.copy() for q in self.postures]

        def show(share: np.ndarray) -> None:
            for k in (0, 1):
                self.postures[k] = start[k] + (meeting.postures[k] - start[k]) * share[0]
                self.drawing.arms[k].set(self.postures[k])

        seconds = max(self._seconds(k, start[k], meeting.postures[k]) for k in (0, 1))
        yield from travel(self._drive, np.zeros(1), np.full(1, 1.0), seconds, show)
        self.meeting = meeting
        done(meeting)

    def drawn_tips(self) -> np.ndarray:
        """(2, 3) where both tips are drawn [m]."""
        pairs = zip(self.drawn.arms, self.postures, strict=True)
        return np.array([arm.flange(q).apply(pointer(arm)) for arm, q in pairs])

    # Drawing ----------------------------------------------------------------------------------------------

    def _draw_points(self, step: Step) -> None:
        points = np.array([r.point for r in self.wizard.of(step.key)])
        self.drawing.points(step.key, self._stations[step.robot - 1].apply(points), step.axis)

    def _draw_circle(self, step: Step) -> None:
        points = np.array([r.point for r in self.wizard.of(step.key)])
        length = 0.9 * self.cell.arms[step.robot - 1].robot.reach
        self.drawing.circle(step.key, fit_axis(points), step.axis, self._stations[step.robot - 1], length)


def _foot(place: np.ndarray) -> list[np.ndarray]:
    """A place and the floor below it."""
    return [place, place * [1.0, 1.0, 0.0]]
