"""What slow effects follow: time, or temperature where it was recorded."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import Place
from app.diagnosis.static.situation import Situation

_STEADY = 0.5  # K: a temperature that varies by less than this drives nothing
_JUMPY = 1.0


def paces(situation: Situation) -> list[str]:
    """The drivers that are there."""
    warm = situation.temperature is not None and _follows_time(situation.temperature)
    return ["time", "temperature"] if warm else ["time"]


def _follows_time(temperature: np.ndarray) -> bool:
    """A temperature drives something where it varies, and changes slowly: what jumps from row to row is noise."""
    spread = temperature - temperature.mean()
    energy = float(spread @ spread)
    if np.ptp(temperature) < _STEADY or energy <= 0:
        return False
    steps = np.diff(temperature)
    return (
        float(steps @ steps) < _JUMPY * energy
    )  # 2 for white noise, near 0 for a slow curve (von Neumann 1941)


def pace(situation: Situation, place: Place) -> np.ndarray:
    """(m,) [s, rows or K] since the first row."""
    if place.where["driver"] == "temperature":
        assert situation.temperature is not None
        return situation.temperature
    return situation.time


def per_unit(situation: Situation, place: Place) -> str:
    """The unit of a rate's denominator, with its stroke."""
    return "/K" if place.where["driver"] == "temperature" else "/" + situation.time_unit
