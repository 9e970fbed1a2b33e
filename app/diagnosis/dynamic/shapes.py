"""Uncertainty of values that a law is not linear in: the slope of its torque by such a value is one column more.

Solved together with everything else, the column's weight has the value's standard deviation, and the linear values
beside it have theirs with the shape free.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.solution import Solution
from app.diagnosis.effects.dynamic._law import Law, Torques
from app.diagnosis.effects.effect import Place, Quantity
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import UNNAMED

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


STEP = 1e-3  # relative, of the difference quotient


class Tangent(Law):
    """Torque of a law per relative change of one of its shape values."""

    key = "tangent"
    title = "slope of a law by a shape value"
    equation = "tau = d tau / d ln(shape)"
    family = UNNAMED

    def __init__(self, law: Law, place: Place, name: str, values: np.ndarray):
        self.law, self.place, self.name, self.values = law, place, name, values

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({})]

    def quantities(self, situation: State, place: Place) -> tuple[Quantity, ...]:
        return (Quantity(self.name, "", 1.0),)

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        return np.ones(1)

    def columns(self, columns: State, place: Place) -> Torques:
        def torque(factor: float) -> Torques:
            fixed = {**self.place.fixed, self.name: self.place.fixed[self.name] * factor}
            at = Place(self.place.where, fixed)
            return {j: c @ self.values for j, c in self.law.columns(columns, at).items()}

        more, less = torque(1.0 + STEP), torque(1.0 - STEP)
        return {j: ((more[j] - less[j]) / (2.0 * STEP))[:, None] for j in more}


def add_tangents(study: Study, solution: Solution) -> dict[int, Tangent]:
    """Puts a column for every shape value of the selection into it; the numbers of the groups."""
    out: dict[int, Tangent] = {}
    for g in list(study.selection):
        candidate = study.label(g)
        for name in candidate.law.bent:
            if name in candidate.place.fixed:
                columns = study.group(g).columns
                values = solution.of(columns)[0] * study.design.scale[columns]
                tangent = Tangent(candidate.law, candidate.place, name, values)
                out[study.add(tangent, Place({}))] = tangent
    study.selection = {**study.selection, **dict.fromkeys(out, 1.0)}
    return out


def spread_of(
    study: Study, loose: Solution, bends: dict[int, Tangent], law: Law, place: Place
) -> dict[str, float]:
    """Standard deviation of each shape value of a law at a place."""
    out = {}
    for g, tangent in bends.items():
        if tangent.law is law and tangent.place.where == place.where and tangent.place.fixed == place.fixed:
            _, covariance = loose.of(study.group(g).columns)
            spread = float(np.hypot(np.sqrt(covariance[0, 0]), law.rough.get(tangent.name, 0.0)))
            out[tangent.name] = spread * place.fixed[tangent.name]
    return out
