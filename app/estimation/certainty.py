"""How far a 95% region reaches: the one measure of certainty that screens, sheets and the terminal show.

The noise is estimated from few observations, so chi-squared would promise too much: with three degrees of freedom the
region of a point reaches 5.3 standard errors, not 2.8.

Source: Seber and Lee (2003), Linear Regression Analysis, section 5.1; Hotelling (1931).
"""

from __future__ import annotations

import math

import numpy as np
from scipy import special

LEVEL = 0.95


def reach(dof: int, level: float = LEVEL, dimensions: int = 3) -> float:
    """How many standard errors the region reaches; dof 0: the noise is known beforehand."""
    if dof > 0:
        return float(np.sqrt(dimensions * special.fdtri(dimensions, dof, level)))
    return float(np.sqrt(special.chdtri(dimensions, 1.0 - level)))


#: Standard errors in half a 95% interval of one number whose noise is known, or comes from dozens of readings or more.
HALF = reach(0, dimensions=1)

_FIGURES = 2  # of the half width; the value is written to the same place
_PLACES = (-6, 9)  # beyond these a number is written with an exponent


def plus_minus(value: float, std: float, unit: str = "", *, marked: bool = True) -> str:
    """A value as a person reads it: "12.34 ± 0.80 µrad/Nm (95%)"; without an uncertainty "12.34 µrad/Nm".

    Args:
        value: in `unit`.
        std: its standard error in `unit`; what is written is half the 95% interval, `HALF` times as much.
        unit: as it is to be written; "" for a bare number.
        marked: with "(95%)" behind it; False in a table whose head says so.
    """
    half = HALF * std
    unit = f" {unit}" if unit else ""
    if not math.isfinite(half) or half <= 0:
        return f"{value:.4g}{unit}"
    places = _FIGURES - 1 - math.floor(math.log10(half))
    if not _PLACES[0] <= places <= _PLACES[1]:
        said = f"{value:.4g} ± {half:.{_FIGURES}g}"
    elif places <= 0:
        said = f"{round(value, places):.0f} ± {round(half, places):.0f}"
    else:
        said = f"{value:.{places}f} ± {half:.{places}f}"
    return f"{said}{unit} ({LEVEL:.0%})" if marked else f"{said}{unit}"
