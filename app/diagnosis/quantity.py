"""A fitted number as terminal, report, pendant and fleet write it: one unit, one uncertainty, one wording."""

from __future__ import annotations

from app.diagnosis.result import Parameter
from app.diagnosis.wording import FALLBACK, WORDS
from app.estimation import plus_minus
from app.units import deg, mm, um

#: SI unit of a parameter -> (unit a person reads, conversion), where they differ.
_READ_AS = {
    "rad": ("deg", deg),
    "m": ("mm", mm),
    "rad/Nm": ("µrad/Nm", um),
    "m/N": ("µm/N", um),
    "rad/s": ("deg/s", deg),
    "m/s": ("mm/s", mm),
}
_UNIT_WORDS = ("row", "turn")  # units that are words


def quantity(parameter: Parameter, language: str = FALLBACK, *, marked: bool = True) -> str:
    """ "12.34 ± 0.80 µrad/Nm (95%)", in the units a person reads; `marked=False` leaves "(95%)" to the head of a table.

    The interval is that of a normal law: of a fit's few degrees of freedom `Parameter` knows nothing, and `prove`
    counts how often `std` times the same 1.96 holds the truth.
    """
    unit, convert = _READ_AS.get(
        parameter.unit, ("" if parameter.unit == "1" else parameter.unit, lambda x: x)
    )
    for word in _UNIT_WORDS:
        if unit.endswith(f"/{word}"):
            unit = unit.removesuffix(word) + WORDS.text(f"unit.{word}", language)
    return plus_minus(float(convert(parameter.value)), float(convert(parameter.std)), unit, marked=marked)
