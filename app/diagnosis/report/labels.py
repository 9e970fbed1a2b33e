"""Drivers by the names engines give them, as a person reads them: `qd3 [rad/s]` is the speed of joint 3 in deg/s."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from app.units import deg, mm

_SHAPE = re.compile(r"\s*(?P<name>.*?)\s*(?:\[(?P<unit>[^\]]*)\])?\s*$")
_NUMBER = re.compile(r"(?:\bjoint\s*|\bq+d*|\s)(\d+)\b")
#: Words of a label -> the driver's key in `where`, and its name; the first that fits counts.
_KINDS = (
    (re.compile(r"gravity"), "gravity_torque", "gravity torque"),
    (re.compile(r"temperature"), "temperature", "temperature"),
    (re.compile(r"accel|^qdd"), "acceleration", "acceleration"),
    (re.compile(r"approach"), "approach", "last move"),
    (re.compile(r"speed|velocity|^qd"), "speed", "speed"),
    (re.compile(r"\btime\b"), "time", "time"),
    (re.compile(r"angle|position|^q\d"), "own_angle", "angle"),
)
_UNITS = {
    "rad": ("deg", deg),
    "rad/s": ("deg/s", deg),
    "rad/s^2": ("deg/s²", deg),
    "m": ("mm", mm),
    "m/s": ("mm/s", mm),
    "m/s^2": ("mm/s²", mm),
    "degC": ("°C", lambda x: x),
}
_SECONDS_SHOWN = 600.0
_SECONDS_A_MINUTE = 60.0


@dataclass(frozen=True, eq=False)
class Driver:
    """One driver.

    Args:
        key: as in a finding's `where`; the label itself where it is none of those.
        joint: whose it is, from 1; None where it belongs to none.
        label: for an axis, unit included.
        values: (m,) in that unit.
    """

    key: str
    joint: int | None
    label: str
    values: np.ndarray


def driver(label: str, values: np.ndarray) -> Driver:
    """A driver by the name an engine gave it."""
    match = _SHAPE.match(label)
    name, unit = (match.group("name"), match.group("unit")) if match else (label, None)
    values = np.asarray(values, float)
    key, title = next(((k, t) for pattern, k, t in _KINDS if pattern.search(name)), (name, name))
    number = _NUMBER.search(name)
    joint = int(number.group(1)) if number and key != "time" else None
    unit, convert = _UNITS.get(unit or "", (unit, lambda x: x))
    values = convert(values)
    if key == "time" and unit == "s":
        values = values - np.nanmin(values) if len(values) else values
        if len(values) and np.nanmax(values) > _SECONDS_SHOWN:
            values, unit = values / _SECONDS_A_MINUTE, "min"
    if key == "own_angle" and unit == "mm":
        title = "position"
    said = title if joint is None else f"{title} of joint {joint}"
    return Driver(key, joint, f"{said} [{unit}]" if unit and unit not in ("-", "1") else said, values)
