"""Units as a diagnosis states them."""

from __future__ import annotations

from app.units import SI_FACTORS


def si_factor(unit: str) -> float:
    """Factor to SI of a unit such as `mm`, `deg/s` or `rad/Nm`."""
    above, _, below = unit.partition("/")
    factor = SI_FACTORS.get(above.strip(), 1.0)
    for part in below.replace("*", " ").split() if below else ():
        factor /= SI_FACTORS.get(part, 1.0)
    return factor
