"""The model as it is confirmed: what was named, with the masses refitted without the laws that were withheld.

The "after" figures come from it, it is what is saved, and what other runs are judged by. Values beside which a
withheld law stood in the fit would leave its share in the masses, where no other run finds it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.effects.motion._load import Load
from app.diagnosis.model import ModelEffect
from app.diagnosis.motion.errors import ErrorTable
from app.diagnosis.result import Finding
from app.kinematics import RobotModel
from app.kinematics.dynamics import PER_LINK, flange_to_last_link

if TYPE_CHECKING:
    from app.diagnosis.motion.search import Term
    from app.diagnosis.motion.study import Study


def confirmed(
    study: Study, robot: RobotModel, table: ErrorTable, findings: Mapping[int, Finding]
) -> tuple[np.ndarray, dict[int, ModelEffect]]:
    """Error of the links' inertial parameters (10 n,), and the effects.

    Args:
        findings: term -> what is said of it; all that is named and nothing else.
    """
    theta = table.theta_with([*range(study.known), *findings])
    masses = theta[: study.system.inertial_size].copy()
    at, effects = len(masses), {}
    for i, term in enumerate(study.fit.terms):
        part = theta[at : at + term.group.size]
        at += term.group.size
        if i not in findings:
            continue
        said = findings[i]
        values = {p.name: p.value for p in said.parameters}
        law = term.group.law
        assert law is not None
        if not law.corrected:  # the samples were corrected for the others: their values stand
            values = _values(term, part)
        effects[i] = ModelEffect(said.effect, dict(said.where), values)
        if isinstance(law, Load) and not law.windowed:
            # A load is saved as mass and centre: the rest of its inertia is the last link's.
            masses[-PER_LINK:] += flange_to_last_link(robot) @ (part[:PER_LINK] - law.body(values))
    return masses, effects


def _values(term: Term, part: np.ndarray) -> dict[str, float]:
    law, shape = term.group.law, dict(term.group.shape)
    assert law is not None
    bounded = [name for name in law.shape_bounds if name in shape]
    count = len(law.linear)
    for name, step in zip(bounded, part[count:], strict=False):
        shape[name] = float(np.clip(shape[name] + step, *law.shape_bounds[name]))
    return law.values(part[:count], shape)
