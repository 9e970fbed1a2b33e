"""A model learnt on one run and judged on others: torque error joint by joint and step by step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.diagnosis.motion.engine import ready
from app.diagnosis.motion.errors import ErrorTable
from app.diagnosis.motion.sampling import Samples, take_samples
from app.diagnosis.motion.search import Term
from app.diagnosis.motion.study import examine
from app.diagnosis.result import Progress
from app.kinematics import RobotModel
from app.recordings import Table

STEPS = (
    "description alone",
    "+ its masses within their prior",
    "+ dry and viscous friction",
    "+ what was named",
    "+ what was found but not named",
)


@dataclass(frozen=True, eq=False)
class Judged:
    """One run that the model has not seen.

    Args:
        file: its name.
        errors: (steps, n) root mean square error [Nm], in the order of STEPS.
    """

    file: str
    errors: np.ndarray


def judged_on(
    learnt: Table, others: Sequence[Table], robot: RobotModel, *, progress: Progress | None = None
) -> list[Judged]:
    """Errors on other runs of a model that was learnt on one.

    Events (contacts, loads taken up) belong to their own run and are left out; the samples of all runs are
    corrected alike for a wrong factor, a late torque and a leaning base.

    Raises:
        InputError: a recording cannot be used.
    """
    tell = progress or (lambda share, what: None)
    log, motion, _ = ready(learnt, robot)
    study = examine(log, robot, motion, tell, 0)
    terms = study.fit.terms
    fixed = study.samples.y - study.fit.offset
    table = ErrorTable(study.system, study.prior, [t.group for t in terms], fixed, {})
    named = [i for i, good in enumerate(study.judgement.named) if good]
    friction = [i for i in named if _law(t := terms[i]).common and t.group.joint is not None]
    out = []
    for other in others:
        new, moved, _ = ready(other, robot)
        bare = take_samples(new, robot, moved, new.y, tell)
        done = study.corrections
        samples = take_samples(
            new, robot, moved, new.y / (1.0 + done.scale), tell, shift=done.delay, gravity=done.gravity
        )
        rows = [_rms(bare.y, bare.usable)]
        for chosen in ([], friction, named, [*range(len(terms))]):
            corrected = samples if any(_law(terms[i]).corrected for i in chosen) else bare
            rows.append(_rms(_left(table, terms, chosen, corrected), corrected.usable))
        out.append(Judged(other.path.name, np.array(rows)))
    return out


def _left(table: ErrorTable, terms: Sequence[Term], chosen: list[int], samples: Samples) -> np.ndarray:
    """(M, n) torque [Nm] of other samples that the model with the chosen terms leaves."""
    theta = table.theta_with(chosen)
    residual = samples.y.copy()
    at = len(theta) - sum(t.group.size for t in terms)
    for j in range(residual.shape[1]):
        residual[:, j] -= samples.regressor[:, :, j] @ theta[:at]
    for i, term in enumerate(terms):
        group, law = term.group, _law(term)
        part = theta[at : at + len(law.linear)]
        at += group.size
        if i not in chosen or law.corrected or law.windowed:
            continue
        columns = samples.pool(law.columns(samples.state, group.where, group.shape))
        if group.joint is None:
            residual -= columns @ part
        else:
            residual[:, group.joint] -= columns @ part
    return residual


def _law(term: Term):
    assert term.group.law is not None
    return term.group.law


def _rms(residual: np.ndarray, usable: np.ndarray) -> np.ndarray:
    return np.array([np.sqrt(np.mean(r[u] ** 2)) for r, u in zip(residual.T, usable.T, strict=True)])
