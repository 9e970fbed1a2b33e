"""The next touch: reachable, within limits, free of collision, and with what it would bring."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from app.calibration.next_touch.candidates import TouchLimits, candidates
from app.calibration.next_touch.plan import plan_touches
from app.calibration.next_touch.prediction import USUAL_NOISE, predicted_covariance, predicted_error
from app.calibration.wording import degenerate, phrase
from app.geometry import Pose
from app.kinematics import RobotModel, solve_ik
from app.units import mm

#: Says whether a joint position (n,) hits anything: anything that is true (or not empty) is a hit.
Collides = Callable[[np.ndarray], object]
_LOOK_AHEAD = 2


@dataclass(frozen=True, eq=False)
class Proposal:
    """Where to touch next.

    Args:
        T_base_flange: the flange that brings the tip to the spike.
        q: (n,) joint positions that reach it, for the ghost arm; None where no robot was given.
        following: (m, 3, 3) flange rotations planned after it.
        now: predicted half length of the 95% region with the touches made [m]; inf while undetermined.
        after: with this touch as well [m].
        at_end: with all planned touches [m].
        sigma_after: (3,) along the flange's axes after this touch [m].
        refused: how many better orientations the arm could not take up.
    """

    T_base_flange: Pose
    q: np.ndarray | None
    following: np.ndarray
    now: float
    after: float
    at_end: float
    sigma_after: np.ndarray
    refused: int

    def sentence(self, language: str = "en") -> str:
        """What an operator reads."""
        if np.isfinite(self.after):
            key = "both" if np.isfinite(self.now) else "first"
        else:
            key = "open_end" if np.isfinite(self.at_end) else "open"
        fields = {"now": mm(self.now), "after": mm(self.after), "end": mm(self.at_end)}
        return phrase(f"next.{key}", **fields).text(language)


def propose(
    rotations: np.ndarray,
    *,
    tool: np.ndarray,
    spike: np.ndarray,
    touches: int = 4,
    noise: float = USUAL_NOISE,
    limits: TouchLimits | None = None,
    reference: np.ndarray | None = None,
    tool_axis: np.ndarray | None = None,
    robot: RobotModel | None = None,
    q_near: np.ndarray | None = None,
    collides: Collides | None = None,
    seed: int = 0,
) -> Proposal:
    """The best next touch of a set of `touches`.

    Args:
        rotations: (n, 3, 3) of the flange at the touches made, the first one the reference; n may be 0.
        tool: (3,) the tool point as far as it is known, to bring the tip to the spike [m].
        spike: (3,) the touched point in base [m].
        touches: how many there will be; with as many made, the plan looks two ahead.
        noise: one-sigma of one touch on one axis [m].
        limits: tilt and turn allowed.
        reference: (3, 3) flange orientation that tilts are counted from; else the first touch's.
        tool_axis: (3,) in the flange; else from the flange to the tool point.
        robot: where given, the pose is reached by it within its limits.
        q_near: (k,) joint positions to start from; else the robot's home.
        collides: joint positions -> true where something would be hit.
        seed: of the plan.

    Raises:
        DegenerateGeometryError: no touch made and no reference given, or no allowed orientation is reachable.
    """
    limits = limits or TouchLimits()
    upright = reference
    if upright is None:
        if not len(rotations):
            raise degenerate("too_few", "no_start", rank=0, needed=1)
        upright = np.asarray(rotations[0])
    axis = np.asarray(tool if tool_axis is None else tool_axis, float)
    length = float(np.linalg.norm(axis))
    axis = axis / length if length > 1e-9 else np.array([0.0, 0.0, 1.0])
    choice = candidates(upright, axis, limits)
    left = np.arange(len(choice))
    count = max(touches - len(rotations), 1 if len(rotations) < touches else _LOOK_AHEAD)
    refused = 0
    reach: dict[int, np.ndarray | None] = {}
    while len(left):
        order = [int(left[i]) for i in plan_touches(rotations, choice[left], count, seed=seed)]
        q = None
        if robot is not None:
            bad = [
                i
                for i in set(order)
                if _reach(i, reach, choice, tool, spike, robot, q_near, collides) is None
            ]
            if bad:
                refused += len(bad)
                left = np.setdiff1d(left, bad)
                continue
            q = reach[order[0]]
        first = choice[order[0]]
        made = [*rotations, first]
        return Proposal(
            Pose.of(first, spike - first @ tool),
            q,
            choice[order[1:]],
            predicted_error(np.asarray(rotations), noise),
            predicted_error(np.array(made), noise),
            predicted_error(np.array([*rotations, *choice[order]]), noise),
            np.sqrt(np.diag(predicted_covariance(np.array(made), noise))),
            refused,
        )
    raise degenerate("out_of_reach", rank=0, needed=1)


def _reach(
    index: int,
    known: dict[int, np.ndarray | None],
    choice: np.ndarray,
    tool: np.ndarray,
    spike: np.ndarray,
    robot: RobotModel,
    q_near: np.ndarray | None,
    collides: Collides | None,
) -> np.ndarray | None:
    """Joint positions for a candidate, or None; each is worked out once."""
    if index not in known:
        target = Pose.of(choice[index], spike - choice[index] @ tool)
        known[index] = None
        starts: Sequence[np.ndarray] = [robot.home] if q_near is None else [q_near, robot.home]
        for start in starts:
            found = solve_ik(robot, target, start, max_steps=100)
            if found.reached and not (collides and collides(found.q)):
                known[index] = found.q
                break
    return known[index]
