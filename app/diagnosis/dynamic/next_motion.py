"""What to record next: poses at which a finding and its best rival differ most.

With e the torque of the finding less that of the rival, both as large as this log has them, and C the covariance of the
finding's values, a pose with torques e tells them apart by e' (I + X C X')^-1 e, in units of the noise.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.names import Member, rivals
from app.diagnosis.wording import effect, joint_or_arm, note

if TYPE_CHECKING:
    from app.diagnosis.dynamic.fitting import Fitted


COUNT = 3
APART = 0.5  # rad between two proposals
SPEEDS = (0.3, 1.0)  # of the log's usual speed: laws of one joint differ most between slow and fast


def next_motion(fitted: Fitted, named: list[Member]) -> tuple[tuple[tuple[float, ...], ...], tuple[str, ...]]:
    """Poses (at most COUNT) of this log's path to pass again, and sentences on what to record."""
    keys = dict.fromkeys(m.candidate.law.key for m in named if m.candidate.law.apart)
    said = tuple(note(f"apart_{key}") for key in keys)
    pair = next(((m, r[0][0]) for m in named if (r := rivals(fitted.asked, m))), None)
    if pair is None:
        return (), said
    member, rival = pair
    study, state = fitted.asked, fitted.asked.state
    law, place = member.candidate.law, member.candidate.place
    own = {j: c @ member.values for j, c in law.columns(state, place).items()}
    other = rival.law.columns(state, rival.place)
    score = np.zeros(len(state.t))
    for j, torque in own.items():
        if j not in other:
            score += (torque / study.design.whiteners[j].spread) ** 2
            continue
        fit, *_ = np.linalg.lstsq(other[j], torque, rcond=1e-9)
        score += ((torque - other[j] @ fit) / study.design.whiteners[j].spread) ** 2
    chosen: list[int] = []
    for at in np.argsort(-score).tolist():
        if score[at] > 0 and all(np.linalg.norm(state.q[at] - state.q[c]) > APART for c in chosen):
            chosen.append(at)
        if len(chosen) == COUNT:
            break
    robot = fitted.robot
    q = np.clip(state.q[chosen], robot.lower, robot.upper)
    poses = tuple(tuple(float(v) for v in row) for row in q)
    joint = int(place.where.get("joint", 1))
    fast = float(state.speed[joint - 1])
    remark = note(
        "pass_poses", one=effect(law.key), other=effect(rival.law.key),
        place=joint_or_arm(int(place.where["joint"]) if "joint" in place.where else None), joint=joint,
        speeds=tuple(f"{share * fast:.2g}" for share in SPEEDS), unit="m/s" if state.sliding[joint - 1] else "rad/s",
    )  # fmt: skip
    return poses, (*said, remark)
