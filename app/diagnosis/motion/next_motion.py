"""What to record next: poses to pass, and how fast, at which the two best explanations differ most.

For a state x let e be the torque that A predicts minus that of B, both fitted to this log, and M the columns of
what B leaves free: the states are taken with the largest e^T (I + M H^-1 M^T)^-1 e, in units of the noise,
which counts what the free parameters cannot take up. Where no log of this arm can tell, it is said what could.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.effects.motion._state import State
from app.diagnosis.motion.scoring import Solution, solve
from app.diagnosis.motion.system import Group
from app.diagnosis.result import Finding
from app.diagnosis.wording import effect, joint_or_arm, note
from app.kinematics import RobotModel
from app.kinematics.dynamics import (
    PER_LINK,
    flange_to_last_link,
    gravity_and_force_columns,
    inertial_parameters,
)
from app.kinematics.regressor import torque_regressor
from app.phrases import Phrase

if TYPE_CHECKING:
    from app.diagnosis.motion.study import Study

COUNT = 3
DRAWN = 400
APART = 0.5  # rad between two proposals
FASTER = 1.3  # times the log's usual speed, at most
_FLOOR = 0.05  # m above the base that a proposed flange keeps
#: Effects that another recording would separate from what looks the same in any log: the remarks `apart_EFFECT`.
SEPARATES = ("payload", "torque_constant", "friction_asymmetry")


def next_motion(
    study: Study, robot: RobotModel, findings: tuple[Finding, ...]
) -> tuple[tuple[tuple[float, ...], ...], tuple[str, ...]]:
    """Poses (at most COUNT), and sentences on what to record."""
    said = tuple(dict.fromkeys(note(f"apart_{f.effect}") for f in findings if f.effect in SEPARATES))
    pair = _rivals(study, findings)
    if pair is None:
        return (), said
    index, rival, names = pair
    state = _drawn(study, robot)
    if not len(state.t):
        return (), said
    score = _separation(study, robot, index, rival, state)
    chosen: list[int] = []
    for at in np.argsort(-score).tolist():
        if score[at] > 0 and all(np.linalg.norm(state.q[at] - state.q[c]) > APART for c in chosen):
            chosen.append(at)
        if len(chosen) == COUNT:
            break
    if not chosen:
        return (), said
    j = rival.joint if rival.joint is not None else int(np.argmax(np.abs(state.qd[chosen[0]])))
    advice = note(
        "pass_poses",
        speeds=tuple(f"{state.qd[c, j]:+.2f}" for c in chosen),
        unit="m/s" if state.sliding[j] else "rad/s",
        joint=j + 1,
        **names,
    )
    return tuple(tuple(float(v) for v in state.q[c]) for c in chosen), (*said, advice)


def _rivals(study: Study, findings: tuple[Finding, ...]) -> tuple[int, Group, dict[str, Phrase]] | None:
    """The term with the nearest alternative that another log could tell from it, and that alternative's group."""
    best, pair = np.inf, None
    for finding in findings:
        index = next(
            (
                i
                for i, t in enumerate(study.fit.terms)
                if i >= study.known
                and t.group.label == finding.effect
                and _same(t.group.where, finding.where)
            ),
            None,
        )
        if index is None or study.fit.terms[index].group.law is None:
            continue
        for other in finding.alternatives:
            group = next(
                (
                    g
                    for g in study.search.groups
                    if g.label == other.effect and not g.base and _same(g.where, other.where)
                ),
                None,
            )
            if group is not None and other.delta_bic < best:
                best = other.delta_bic
                place = joint_or_arm(other.where.get("joint"))
                names = {"one": effect(finding.effect), "other": effect(other.effect), "place": place}
                pair = (index, group, names)
    return pair


def _same(a, b) -> bool:
    return all(a.get(k) == b.get(k) for k in ("joint", "source_joint", "driver"))


def _drawn(study: Study, robot: RobotModel) -> State:
    """Random states within limits of place and speed, the flange above the floor."""
    old, rng = study.samples.state, np.random.default_rng(0)
    n = robot.joint_count
    low, high = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)
    q = rng.uniform(low, high, (DRAWN, n))
    q = q[robot.chain.frames(q).flange_positions[:, 2] > _FLOOR]
    m = len(q)
    top = np.where(robot.velocity > 0, np.minimum(robot.velocity, FASTER * old.speed), FASTER * old.speed)
    qd = rng.uniform(-1.0, 1.0, (m, n)) * top
    some = rng.integers(0, len(old.t), m)
    gravity_columns, force_columns = gravity_and_force_columns(robot, q)
    columns = torque_regressor(robot, q, qd, old.qdd[some])
    torque = columns @ inertial_parameters(robot)
    return replace(
        old.at(some),
        q=q, qd=qd, torque=torque, torque_rate=np.zeros((m, n)),
        gravity_torque=gravity_columns @ study.corrections.gravity,
        gravity_columns=gravity_columns, force_columns=force_columns,
        payload_columns=columns[:, :, -PER_LINK:] @ flange_to_last_link(robot),
    )  # fmt: skip


def _separation(study: Study, robot: RobotModel, index: int, rival: Group, state: State) -> np.ndarray:
    """(m,) information a state adds for A against B."""
    system = study.system
    selected = [t.group for t in study.fit.terms]
    other = solve(system, [*selected[:index], rival, *selected[index + 1 :]], study.prior)
    noise = np.array([max(w.spread, 1e-12) for w in system.whiteners])
    inertial = torque_regressor(robot, state.q, state.qd, state.qdd)
    with_a = _columns(study.fit.solution, inertial, state) @ study.fit.solution.theta
    columns = _columns(other, inertial, state)
    difference = (with_a - columns @ other.theta) / noise
    columns = columns / noise[:, None]
    spread = np.eye(len(noise)) + columns @ other.covariance @ np.swapaxes(columns, 1, 2)
    solved = np.linalg.solve(spread, difference[:, :, None])[:, :, 0]
    return np.einsum("mn,mn->m", difference, solved)


def _columns(solution: Solution, inertial: np.ndarray, state: State) -> np.ndarray:
    """(m, n, p) of a model at other states; steps of a shape count as zero."""
    m, n, size = inertial.shape
    out = np.zeros((m, n, len(solution.theta)))
    out[:, :, :size] = inertial
    at = size
    for group in solution.selected:
        assert group.law is not None
        values = group.law.columns(state, group.where, group.shape)
        place = slice(at, at + values.shape[-1])
        if group.joint is None:
            out[:, :, place] = values
        else:
            out[:, group.joint, place] = values
        at += group.size
    return out
