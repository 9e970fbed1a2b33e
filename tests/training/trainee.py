"""Somebody who does an exercise without a screen: well, or badly. Speaks actions, like everybody."""

from dataclasses import dataclass

import msgspec
import numpy as np

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.session import Session
from app.session.actions import Accept, Calculate, Finish, Move, Record, ReRecord, Tracked, TrackerNext
from app.session.state import as_tuple
from app.simulation.tracker_procedure import WIDEST
from app.training.cell import begin, world_now
from app.training.levels import LEVELS
from app.training.score import score
from app.training.tracker import tracker_truth
from app.training.truth import draw
from app.units import from_deg

FAR = (  # degrees about the tool's X, Y, Z: as different as a wrist allows
    (0, 0, 0), (45, 0, 20), (-40, 10, -30), (0, 45, 40), (10, -45, -40), (35, 35, 60), (-30, -30, 0), (30, -35, 90),
    (-40, 35, -60), (0, 0, 90), (25, 25, -90), (-25, 25, 45),
)  # fmt: skip
ALIKE = tuple((5 * np.sin(2.4 * k), 5 * np.cos(2.4 * k), 0) for k in range(12))


@dataclass
class Trainee:
    """How somebody works.

    Args:
        tilts: orientations of the touches.
        arc_deg: how far axes are turned for the tracker.
        seconds: between two actions.
        right: gives the right answer.
        again: when something happened on the way, what came before it is recorded once more.
        stroke: length of strokes [m].
        sloppy: records without touching: this far off [m].
        level: how many helps there are; nobody here uses one.
    """

    tilts: tuple = FAR
    arc_deg: float = 100.0
    seconds: float = 15.0
    right: bool = True
    again: bool = True
    stroke: float = 0.15
    sloppy: float = 0.0
    level: str = "eye"

    def does(self, exercise, seed, *, session=None):
        """The session after the exercise; its entries are the journal."""
        session = session or Session()
        session.do(begin(exercise, seed, 1000.0, without=LEVELS[self.level]))
        if exercise.goal == "relation":
            self._measures(session, exercise, seed)
        else:
            self._teaches(session, exercise, seed)
        return session

    def scores(self, exercise, seed):
        """The card of one attempt, at this person's pace."""
        entries = self.does(exercise, seed).entries
        paced = [msgspec.structs.replace(e, t=1000.0 + self.seconds * k) for k, e in enumerate(entries[1:])]
        return score(exercise, paced)

    def _teaches(self, session, exercise, seed):
        truth, rng = draw(exercise, seed), np.random.default_rng(seed)
        touches = [step.key for step in session.state.steps if "touch" in step.roles]
        for key in touches:
            self._touches(session, truth, rng, key, Record)
        before = truth.spike_from if truth.spike_shift.any() else 0
        before = max([before, *(int(f.where.get("from_row", 0)) for f in truth.world.faults)])
        if self.again:
            for key in touches[: max(before - 1, 0)]:
                self._touches(session, truth, rng, key, ReRecord)
        origin = np.array(session.state.q)
        for step in session.state.missing:
            moved = world_now(truth, session.state).stroke(origin, "xyz".index(step.role), self.stroke, rng)
            session.do(Move(as_tuple(moved.q), path=(as_tuple(origin),)))
            session.do(Record(step.key))
        if exercise.goal == "tool":
            session.do(Calculate())
            session.do(Accept())
        wrong = (
            next((c for c in exercise.question.choices if c != truth.answer), "") if exercise.question else ""
        )
        session.do(Finish(truth.answer if self.right else wrong, truth.number if self.right else 0))

    def _touches(self, session, truth, rng, key, action):
        world = world_now(truth, session.state)
        robot = world.robot
        upright = world.hand(robot.home).rotation
        for tilt in self.tilts[session.state.running.records % len(self.tilts) :] + self.tilts:
            aim = Pose.of(upright @ exp_so3(from_deg(np.array(tilt, float))), world.p_base_spike_drawn)
            near = solve_ik(robot, aim, robot.home, T_flange_tool=world.T_flange_tool_hand, max_steps=300)
            touched = world.touch(near.q, rng) if near.reached else near
            if touched.reached:
                break
        assert touched.reached
        q = touched.q
        if self.sloppy:
            off = rng.normal(size=3)
            off *= self.sloppy / np.linalg.norm(off)
            beside = Pose.of(world.hand(q).rotation, world.hand(q).position + off)
            q = solve_ik(robot, beside, q, T_flange_tool=world.T_flange_tool_hand, max_steps=300).q
        start = np.array(session.state.q)
        path = tuple(as_tuple(start + (q - start) * share) for share in np.linspace(0.1, 0.9, 9))
        session.do(Move(as_tuple(q), path=path))
        session.do(action(key))

    def _measures(self, session, exercise, seed):
        truth, rng = tracker_truth(exercise.key, seed), np.random.default_rng(seed)
        cell = truth.cell
        while (step := session.state.running.wizard.step) is not None:
            arm = step.robot - 1
            if truth.pushed is not None and step.robot == 2 and cell is truth.cell:
                cell = cell.moved(truth.pushed)
            if step.kind == "nests":
                for number in range(len(cell.nests)):
                    sight = cell.nest(number, rng)
                    if sight.seen:
                        session.do(Tracked(as_tuple(sight.point), 0.0, f"N{number + 1}", sight.sigma))
            else:
                widest = min(from_deg(self.arc_deg / 2), WIDEST[step.axis - 1])
                angles = cell.visible_angles(arm, step.axis, widest / 6, widest) if step.axis else [0.0]
                for angle in angles:
                    postures = [cell.arms[0].rest, cell.arms[1].rest]
                    postures[arm] = cell.posture(arm, step.axis, float(angle))
                    sight = cell.look(arm, tuple(postures), rng)
                    if sight.seen:
                        session.do(Tracked(as_tuple(sight.point), float(angle), "", sight.sigma))
            session.do(TrackerNext())
        right = "tracker_moved" if truth.pushed is not None else "nothing"
        other = "nothing" if right == "tracker_moved" else "tracker_moved"
        session.do(Finish(right if self.right else other))


GOOD = Trainee()
POOR = Trainee(tilts=ALIKE, arc_deg=25.0, seconds=200.0, right=False, again=False, stroke=0.02, sloppy=0.003)
