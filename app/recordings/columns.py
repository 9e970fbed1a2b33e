"""Names of columns: quantity, number and unit.

`q3_deg` is quantity `q3` in degrees. A quantity that has a dimension must say its unit; those without one
(quaternions, text) must not.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from app.units import SI_FACTORS

#: Columns that hold text, or pure numbers, and so carry no unit.
TEXT = frozenset({"role", "target", "pose", "session", "comment", "name"})
UNITLESS = frozenset({"axis", "qw", "qx", "qy", "qz"})

#: Dimensioned quantities -> the units they may come in.
_LENGTH, _ANGLE = ("mm", "m"), ("deg", "rad")
_QUANTITIES: tuple[tuple[re.Pattern[str], tuple[str, ...]], ...] = tuple(
    (re.compile(pattern + r"\Z"), units)
    for pattern, units in (
        (r"q\d+", (*_ANGLE, *_LENGTH)),
        (r"qc\d+", (*_ANGLE, *_LENGTH)),
        (r"theta\d+", _ANGLE),  # of the motor, seen behind the gear
        (r"qd\d+", ("rad_s", "deg_s", "m_s", "mm_s")),
        (r"tau\d+", ("Nm",)),
        (r"i\d+", ("A",)),
        (r"[xyz]\d?", _LENGTH),
        (r"target_[xyz]", _LENGTH),
        (r"length", _LENGTH),
        (r"[abc]", _ANGLE),
        (r"angle", _ANGLE),
        (r"t", ("s", "ms", "us", "ns", "iso")),
        (r"temperature\d*", ("degC",)),
        (r"payload", ("kg",)),
    )
)
_SUFFIXES = sorted(SI_FACTORS, key=len, reverse=True)


@dataclass(frozen=True)
class Column:
    """A column's name taken apart.

    Args:
        name: as written in the file.
        quantity: the name without its unit.
        unit: the unit, or None where it needs none.
        known: False for columns that are kept and ignored.
        missing_unit: the units that would have been right, where one is needed and absent or wrong.
    """

    name: str
    quantity: str
    unit: str | None
    known: bool
    missing_unit: tuple[str, ...] = ()

    @property
    def moment(self) -> bool:
        """True for moments written by ISO 8601, which are no numbers as they stand."""
        return self.unit == "iso"

    @property
    def factor(self) -> float:
        """Factor to SI."""
        return SI_FACTORS[self.unit] if self.unit else 1.0


def parse_column(name: str) -> Column:
    """Takes a column's name apart; never raises: the table decides what a missing unit means."""
    if name in TEXT or name in UNITLESS:
        return Column(name, name, None, True)
    for suffix in _SUFFIXES:
        if name.endswith("_" + suffix):
            quantity = name[: -len(suffix) - 1]
            allowed = units_of(quantity)
            if allowed is None:
                continue
            if suffix in allowed:
                return Column(name, quantity, suffix, True)
    for candidate in (name, name.rpartition("_")[0]):
        allowed = units_of(candidate) if candidate else None
        if allowed is not None:
            return Column(name, candidate, None, True, allowed)
    return Column(name, name, None, False)


def units_of(quantity: str) -> tuple[str, ...] | None:
    """Units a dimensioned quantity may come in; None where the name is not one."""
    for pattern, units in _QUANTITIES:
        if pattern.match(quantity):
            return units
    return None
