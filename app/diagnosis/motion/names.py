"""Before a name is given: does the residual follow that law, or only something like it?

A law is withheld where a free curve of the same joint explains much beyond it, where several laws of the joint's angle
together draw a curve that none of them is, where what is left over is more than what it explains, or where
its values are none a real arm can have. What remains is tested against every curve, against the stated
noise, and for a memory that no sensor has.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.motion.exact import ExactFit
from app.diagnosis.motion.imitation import imitators
from app.diagnosis.motion.remains import Remains, remains_of
from app.diagnosis.motion.scoring import Board, minus_log_p, null_scores, score_all
from app.diagnosis.motion.search import LEVEL, Search, Term
from app.diagnosis.motion.system import Group
from app.diagnosis.motion.uncertainty import widening
from app.diagnosis.wording import curve, effect, joint_or_arm, reason, remark_of_reasons
from app.phrases import Phrase

#: A curve that takes less than this share off a joint's noise is below what smoothing and averaging may leave.
MATERIAL = 0.01
ENDS = 0.05  # share of a log in which a change that lasts has nothing to be compared with
SHADOW = 0.05  # share of a law's own gain that a free curve may add before the name is withheld
BLUR = 0.03  # relative uncertainty of a ripple's order beyond which it is no period
SWINGS = 1.5  # a ripple shows at least so many
#: A law worth less than this share of a withheld one on its joint may be its shadow; friction is in every joint.
FOLLOWER = {"viscous_friction": 0.1, "coulomb_friction": 0.1}
FOLLOWER_ELSE = 1.0


@dataclass(frozen=True, eq=False)
class Judgement:
    """What may be named.

    Args:
        named: per term of the fit, True where its name stands.
        gains: per term, whitened fall of the sum of squares it is worth.
        leftover_p: family-wise p of what remains.
        leftover_where: joint and driver of it.
        reasons: why names were withheld, and what remains.
        p_values: per term, family-wise, against the null of the final model's residual.
    """

    named: list[bool]
    gains: np.ndarray
    leftover_p: float
    leftover_where: dict
    reasons: tuple[str, ...]
    p_values: list[float]


def judge(
    search: Search, fit: ExactFit, stated: np.ndarray | None, moved: np.ndarray, done: dict[int, np.ndarray]
) -> Judgement:
    """Tests every name, and what is left over.

    Args:
        stated: (n,) stated noise of the pooled torques [Nm], that of the motion in it, or None.
        moved: (n,) what errors of the motion alone make of it [Nm].
        done: term -> what the samples were corrected by before its coefficients were fitted.
    """
    selected = [t.group for t in fit.terms]
    gains = search.losses_without(selected, done) if selected else np.zeros(0)
    curves = [g for g in search.system.groups if g.law is None]
    board = score_all(search.system, fit.solution, curves, {}, [])
    null = null_scores(board, search.signs)
    bar = max(float(np.quantile(null, 1 - LEVEL)), np.log10(len(board) / LEVEL))
    best = int(np.argmax(board.score))
    p_value = float((1 + np.sum(null >= board.score[best])) / (1 + len(null)))
    rows = np.count_nonzero(search.system.whiteners[board[best].group.joint or 0].weight)
    small = board.gain[best] - board.sizes[best] < MATERIAL * rows
    if small or board.score[best] < np.log10(len(board) / LEVEL):
        p_value = max(p_value, 0.05)
    where = dict(board[best].group.where)
    remains = remains_of(search.system, fit.solution, stated, moved, fit.offset)
    reasons = list(remains.sentences())
    worst = remains.worst()
    if worst is not None and p_value > LEVEL:
        p_value, where = 1.0 / (1 + len(null)), {"joint": worst + 1}
    why = [_objection(search, board, bar, remains, term, values, cov, gain) for term, values, cov, gain in zip(
        fit.terms, fit.values, fit.covariances, gains, strict=True)]  # fmt: skip
    for i in range(search.known):
        why[i] = None
    everything = search.board(fit.solution, selected)
    wild = null_scores(everything, search.signs)
    scores = minus_log_p(gains, np.array([g.size for g in selected], int))
    p_terms = [float((1 + np.sum(wild >= s)) / (1 + len(wild))) for s in scores]
    for i, p in enumerate(p_terms):
        if i >= search.known and p > LEVEL and not why[i]:
            why[i] = reason("chance")
    for i in np.flatnonzero(_uncertain(search, fit, done, len(everything))).tolist():
        why[i] = why[i] or reason("uncertain")
    _own_angle(fit.terms, why)
    response = search.system.samples.y - fit.offset
    for i, imitated in imitators(search, fit.terms, response, done).items():
        why[i] = why[i] or imitated
    _followers(fit.terms, gains, why)
    reasons += remark_of_reasons(
        [
            (effect(t.group.label), joint_or_arm(t.group.where.get("joint")), r)
            for t, r in zip(fit.terms, why, strict=True)
            if r
        ]
    )
    if any(why) and p_value > LEVEL:
        strongest = max((i for i, r in enumerate(why) if r), key=lambda i: gains[i])
        p_value = 1.0 / (1 + len(null))
        where = {
            k: v for k, v in fit.terms[strongest].group.where.items() if k in ("joint", "driver", "body")
        }
    named = [not r and i >= search.known for i, r in enumerate(why)]
    return Judgement(named, gains, p_value, where, tuple(reasons), p_terms)


def _objection(
    search: Search, board: Board, bar: float, remains: Remains, term: Term, values, covariance, gain: float
) -> Phrase | None:
    """Why this name may not be given; None where nothing speaks against it."""
    law, group = term.group.law, term.group
    assert law is not None
    if not search.change and not law.lawful(values):
        return reason("unlawful")
    extra, driver = _beyond(board, group, bar)
    if extra > SHADOW * gain:
        return reason("curve", driver=curve(driver))
    if group.joint is not None and remains.energy[group.joint] > gain:
        return reason("leftover_joint")
    if group.joint is None and float(remains.energy.sum()) > gain:
        return reason("leftover")
    if law.windowed and "to_s" not in group.where:
        t = search.system.samples.t
        before = (group.where["from_s"] - t[0]) / (t[-1] - t[0])
        if not ENDS < before < 1 - ENDS:
            return reason("ends")
    if law.key == "torque_ripple":
        order, names = values["order"], list(values)
        std = float(np.sqrt(max(covariance[names.index("order"), names.index("order")], 0.0)))
        assert group.joint is not None
        span = float(np.ptp(search.system.samples.state.q[:, group.joint]))
        if std > BLUR * order or order * span < SWINGS * 2 * np.pi:
            return reason("period")
    return None


def _uncertain(search: Search, fit: ExactFit, done: dict[int, np.ndarray], candidates: int) -> np.ndarray:
    """(terms,) True where a term could be nothing by the spread that stretches of the log show.

    Masses are shared by all joints: what is wrong with one and left over pulls at laws of the others.
    """
    solution = fit.solution
    widened = widening(search.system, solution, search.prior)
    out, at = np.zeros(len(fit.terms), bool), len(solution.theta) - sum(t.group.size for t in fit.terms)
    for i, term in enumerate(fit.terms):
        place = slice(at, at + term.group.size)
        at += term.group.size
        part = solution.theta[place] + done.get(i, 0.0)
        spread = solution.covariance[place, place] * widened[place] * widened[place][:, None]
        wald = np.array([part @ np.linalg.solve(spread, part)])
        sure = np.log10(candidates / LEVEL)
        out[i] = i >= search.known and minus_log_p(wald, np.array([term.group.size]))[0] < sure
    return out


def _own_angle(terms: list[Term], why: list[Phrase | None]) -> None:
    """Two or more laws of one joint's angle together are a curve, not laws."""
    for joint in {t.group.joint for t in terms if t.group.joint is not None}:
        here = [
            i
            for i, t in enumerate(terms)
            if t.group.joint == joint and t.group.label in ("torque_ripple", "joint_spring")
        ]
        ripples = sum(terms[i].group.label == "torque_ripple" for i in here)
        if ripples >= 2 or (len(here) >= 2 and any(why[i] for i in here)):
            for i in here:
                why[i] = why[i] or reason("own_angle")


def _followers(terms: list[Term], gains: np.ndarray, why: list[Phrase | None]) -> None:
    """A small law beside a large one that was withheld may be its shadow."""
    for i, term in enumerate(terms):
        if why[i] or term.group.joint is None:
            continue
        near = {term.group.joint, int(term.group.where.get("source_joint", 0)) - 1}
        withheld = [gains[k] for k, t in enumerate(terms) if why[k] and t.group.joint in near]
        if withheld and gains[i] < FOLLOWER.get(term.group.label, FOLLOWER_ELSE) * max(withheld):
            why[i] = reason("shadow")


def _beyond(board: Board, group: Group, bar: float) -> tuple[float, str]:
    """The largest significant gain of a free curve where this law acts."""
    best, driver = 0.0, ""
    for candidate, gain, score in zip(board.all(), board.gain, board.score, strict=True):
        if score <= bar or (group.joint is not None and candidate.group.joint != group.joint):
            continue
        spare = gain - candidate.size
        if spare > best:
            best, driver = float(spare), candidate.group.name
    return best, driver
