"""What slow effects follow: time, or temperature where it was recorded."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from app.diagnosis.effects.effect import Place
from app.diagnosis.models.kinematic.situation import Situation
from app.diagnosis.thresholds.drivers import JUMPY, SETTLING, STEADY


def paces(situation: Situation) -> list[str]:
    """The drivers that are there."""
    warm = situation.temperature is not None and _follows_time(situation.temperature)
    return ["time", "temperature"] if warm else ["time"]


def forms(situation: Situation) -> Iterator[tuple[str, Mapping[str, float], float]]:
    """Driver, time constant (none: proportional), and the cost of the choice [nats]."""
    cost = float(np.log(1 + len(SETTLING)))
    for driver in paces(situation):
        yield driver, {}, cost
        if driver == "time":
            for part in SETTLING:
                yield driver, {"tau": part * max(float(np.ptp(situation.time)), 1e-9)}, cost


def shaped(situation: Situation, place: Place) -> np.ndarray:
    """(m,) the pace, or tau (1 - exp(-t / tau)) where the place has a time constant."""
    t, tau = pace(situation, place), place.fixed.get("tau")
    return t if tau is None else tau * -np.expm1(-np.maximum(t, 0.0) / tau)


def _follows_time(temperature: np.ndarray) -> bool:
    """A temperature drives something where it varies, and changes slowly: what jumps from row to row is noise."""
    spread = temperature - temperature.mean()
    energy = float(spread @ spread)
    if np.ptp(temperature) < STEADY or energy <= 0:
        return False
    steps = np.diff(temperature)
    return float(steps @ steps) < JUMPY * energy


def pace(situation: Situation, place: Place) -> np.ndarray:
    """(m,) [s, rows or K] since the first row."""
    if place.where["driver"] == "temperature":
        assert situation.temperature is not None
        return situation.temperature
    return situation.time


def per_unit(situation: Situation, place: Place) -> str:
    """The unit of a rate's denominator, with its stroke."""
    return "/K" if place.where["driver"] == "temperature" else "/" + situation.time_unit
