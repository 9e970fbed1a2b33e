"""Two arms from two pose recordings: whether their relation can be had, and how that is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.calibration.base.checks.units import units_of_poses
from app.calibration.base.frame import adjoint
from app.calibration.base.poses import PoseBase
from app.calibration.base.wording import phrase, remark
from app.calibration.result import Warning_
from app.estimation import HALF
from app.geometry import Pose
from app.kinematics import RobotModel
from app.units import deg, from_deg, from_mm, mm

_WEAK = from_mm(5.0)  # m: a base known worse than this is worth a warning
_DESCRIPTION = (from_mm(50.0), from_deg(2.0))  # what no wrong description of an arm explains away
_SAME = 1e-9


@dataclass(frozen=True, eq=False)
class PoseRelation:
    """The second base in the first, or why there is none.

    Args:
        T_base1_base2: None where the recordings cannot give it.
        covariance: (6, 6) in base 2's axes.
    """

    T_base1_base2: Pose | None
    covariance: np.ndarray
    warnings: tuple[Warning_, ...]


def share_first_body(one: RobotModel, two: RobotModel) -> bool:
    """True where two descriptions differ in nothing but where joint 2 sits on link 1: two arms on one first axis."""
    a, b = one.chain, two.chain
    if a.joint_count != b.joint_count or a.joint_count < 3 or one.joints[0].name != two.joints[0].name:
        return False

    def same(name: str, rows: slice) -> bool:
        return np.allclose(getattr(a, name)[rows], getattr(b, name)[rows], atol=_SAME)

    first, rest = slice(0, 1), slice(2, None)
    alike = all(same(n, r) for n in ("rotations", "translations", "axes") for r in (first, rest))
    second = same("rotations", slice(1, 2)) and same("translations", slice(1, 2))
    return alike and not second


def relate_poses(
    first: PoseBase, second: PoseBase, robots: tuple[RobotModel, RobotModel], joint1: tuple[float, float]
) -> PoseRelation:
    """T_base1_base2, unless the recordings themselves show that they do not share one tracker frame.

    Args:
        first, second: bases from poses.
        robots: their descriptions.
        joint1: mean angle of joint 1 in each recording [rad].
    """
    T12 = first.T_tracker_base.inverse() @ second.T_tracker_base
    back = adjoint(T12.inverse())
    covariance = back @ first.covariance @ back.T + second.covariance
    if not share_first_body(*robots):
        return PoseRelation(T12, covariance, (remark("tracker_unchecked"),))
    apart, turn = float(np.linalg.norm(T12.position)), float(np.linalg.norm(T12.rotvec))
    open_by = float(np.sqrt(np.trace(covariance[:3, :3]))), float(np.sqrt(np.trace(covariance[3:, 3:])))
    beyond = (
        apart > 5.0 * open_by[0] + _DESCRIPTION[0],
        turn > 5.0 * open_by[1] + _DESCRIPTION[1],
    )
    if not any(beyond):
        return PoseRelation(T12, covariance, ())
    seen = remark(
        "tracker_moved",
        "tracker_poses",
        severe=True,
        name=robots[0].joints[0].name,
        first=deg(joint1[0]),
        second=deg(joint1[1]),
        apart=mm(apart),
        turn=deg(turn),
        open=mm(open_by[0]),
        open_turn=deg(open_by[1]),
    )
    return PoseRelation(None, covariance, (seen,))


def pose_warnings(base: PoseBase, rows: np.ndarray) -> tuple[Warning_, ...]:
    """What a person should know of a base from poses.

    Args:
        rows: (n,) line in the file of every pose.
    """
    if base.scale is not None:  # nothing else that could be said of these numbers means anything
        return (units_of_poses(*base.scale),)
    return (*_aside(base, rows), *_weak(base))


def _aside(base: PoseBase, rows: np.ndarray) -> tuple[Warning_, ...]:
    if not base.aside:
        return ()
    named = tuple(
        phrase("rows.off", row=int(rows[i]), off=mm(d)) for i, d in zip(base.aside, base.off, strict=True)
    )
    return (remark("outlier", "outlier_poses", rows=named, rms=mm(base.heldout_rms)),)


def _weak(base: PoseBase) -> tuple[Warning_, ...]:
    worst = float(np.sqrt(np.linalg.eigvalsh(base.covariance[:3, :3])[-1]))
    if worst < _WEAK:
        return ()
    return (
        remark(
            "weak_poses",
            place=HALF * mm(worst),
            turn=HALF * deg(float(np.sqrt(np.trace(base.covariance[3:, 3:])))),
            wrist=deg(base.wrist),
            condition=base.fit.condition,
        ),
    )
