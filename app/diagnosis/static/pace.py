"""What slow effects follow: time, or temperature where it was recorded."""

from __future__ import annotations

import numpy as np

from app.diagnosis.static.effect import Place
from app.diagnosis.static.situation import Situation

_STEADY = 0.5  # K: a temperature that varies by less than this drives nothing


def paces(situation: Situation) -> list[str]:
    """The drivers that are there."""
    warm = situation.temperature is not None and np.ptp(situation.temperature) > _STEADY
    return ["time", "temperature"] if warm else ["time"]


def pace(situation: Situation, place: Place) -> np.ndarray:
    """(m,) [s, rows or K] since the first row."""
    if place.where["driver"] == "temperature":
        assert situation.temperature is not None
        return situation.temperature
    return situation.time


def per_unit(situation: Situation, place: Place) -> str:
    """The unit of a rate's denominator, with its stroke."""
    return "/K" if place.where["driver"] == "temperature" else "/" + situation.time_unit
