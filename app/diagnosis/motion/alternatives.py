"""What else would explain a finding about as well: exact aliases first, then what the log cannot rule out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.scoring import solve
from app.diagnosis.result import Alternative

if TYPE_CHECKING:
    from app.diagnosis.motion.study import Study

CLOSE = 9.2  # difference of the Bayesian criterion that still counts as open
MOST = 6


def alternatives_of(study: Study, index: int) -> tuple[Alternative, ...]:
    """Other effects in the place of term `index`, the rest of the model kept."""
    term = study.fit.terms[index]
    if index in study.done:  # the samples were corrected for it: nothing of it is left to explain
        return ()
    others = [t.group for i, t in enumerate(study.fit.terms) if i != index]
    solution = solve(study.system, others, study.prior)
    board = study.search.board(solution, others, null=False)
    own_gain, own_size = float(study.judgement.gains[index]), term.group.size
    penalty = np.log(max(study.system.rows, 3))
    out: dict[tuple, Alternative] = {}
    level = _level(study, term.group.joint)
    deltas = (own_gain - board.gain) / level + penalty * (board.sizes - own_size)
    for at in np.flatnonzero(deltas < CLOSE).tolist():
        candidate, delta = board[at], float(deltas[at])
        law, where = candidate.group.law, dict(candidate.group.where)
        assert law is not None
        keys = ("joint", "source_joint") if law.within else ("joint", "driver", "source_joint")
        same = all(where.get(k) == term.group.where.get(k) for k in keys)
        if same and (law.key == term.group.label or law.within == term.group.label):
            continue
        if candidate.window is not None:
            edges, t = study.system.edges, study.samples.t
            where["from_s"] = round(float(t[edges[candidate.window[0]]]), 3)
            if law.key != "payload_change":
                where["to_s"] = round(float(t[edges[candidate.window[1]] - 1]), 3)
        key = (law.key, where.get("joint"), where.get("source_joint"), where.get("driver"))
        if key not in out or out[key].delta_bic > delta:
            out[key] = Alternative(law.key, where, delta)
    found = sorted(out.values(), key=lambda a: a.delta_bic)[:MOST]
    return (*_aliases(study, index), *found)


def _level(study: Study, joint: int | None) -> float:
    """What is left over, as a multiple of the noise's variance: a difference counts by so much less."""
    solution, system = study.fit.solution, study.system
    levels = []
    for j in range(system.joints) if joint is None else (joint,):
        white = system.parts[j].residual(solution.columns[j], solution.theta[solution.positions[j]])
        levels.append(float(white @ white) / max(np.count_nonzero(system.whiteners[j].weight), 1))
    return max(1.0, *levels)


def _aliases(study: Study, index: int) -> tuple[Alternative, ...]:
    """What no log of this arm could tell apart, however long."""
    group = study.fit.terms[index].group
    key = group.law.key if group.law else ""
    last = study.system.joints
    if key == "payload":
        return (Alternative("link_inertia", {"link": last}, 0.0),)
    if key == "friction_asymmetry":
        return (Alternative("torque_offset", {"joint": group.where["joint"]}, 0.0),)
    return ()
