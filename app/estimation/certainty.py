"""How far a 95% region reaches: the one measure of certainty that screens, sheets and the terminal show.

The noise is estimated from few observations, so chi-squared would promise too much: with three degrees of freedom the
region of a point reaches 5.3 standard errors, not 2.8.

Source: Seber and Lee (2003), Linear Regression Analysis, section 5.1; Hotelling (1931).
"""

from __future__ import annotations

import numpy as np
from scipy import special

LEVEL = 0.95


def reach(dof: int, level: float = LEVEL, dimensions: int = 3) -> float:
    """How many standard errors the region reaches; dof 0: the noise is known beforehand."""
    if dof > 0:
        return float(np.sqrt(dimensions * special.fdtri(dimensions, dof, level)))
    return float(np.sqrt(special.chdtri(dimensions, 1.0 - level)))
