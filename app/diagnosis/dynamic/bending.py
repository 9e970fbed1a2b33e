"""What a selection is not linear in: shape values of laws, and the times of events, each moved beside all the rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar

from app.diagnosis.thresholds.events import MERGE
from app.diagnosis.thresholds.evidence import BETTER

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


def bend(study: Study) -> None:
    """Shape values of laws that are not linear in them, each at the most evidence beside the rest."""
    for g in list(study.selection):
        candidate = study.label(g)
        for name, reach in candidate.law.bent.items():
            if name not in candidate.place.fixed or g not in study.selection:
                continue
            rest = {k: v for k, v in study.selection.items() if k != g}
            start = float(candidate.place.fixed[name])

            def place_at(value: float, candidate=candidate, name=name):
                place = candidate.place
                return type(place)(place.where, {**place.fixed, name: value}, cost=place.cost)

            def worse(log_value: float, rest=rest, candidate=candidate, place_at=place_at) -> float:
                place = place_at(float(np.exp(log_value)))
                return -study.events.gain(rest, candidate.law, place)

            least = max(candidate.law.least(study.state, candidate.place, name), start * np.exp(-reach))
            low, high = np.log(min(least, start)), np.log(start) + reach
            best = minimize_scalar(worse, bounds=(low, high), method="bounded", options={"xatol": reach / 30})
            if -float(best.fun) > -worse(np.log(start)) + BETTER:
                place = place_at(float(np.exp(best.x)))
                study.selection = {**rest, study.add(candidate.law, place, candidate.needs): 1.0}


def reshape(study: Study) -> None:
    """Events looked at again: edges moved, two of one kind merged where one does nearly as well."""
    for g in list(study.selection):
        if g in study.selection and study.label(g).law.windowed:
            rest = {k: v for k, v in study.selection.items() if k != g}
            alike = [k for k in rest if study.label(k).law is study.label(g).law]
            for dropped in ([alike] if alike else []) + [[]]:
                beside = {k: v for k, v in rest.items() if k not in dropped}
                law, place = study.label(g).law, study.label(g).place
                moved, gain = study.events.moved(beside, law, place)
                margin = -MERGE if dropped else BETTER
                if study.evidence.score(beside) + gain > study.evidence.score(study.selection) + margin:
                    study.selection = {**beside, study.add(law, moved): 1.0}
                    break
