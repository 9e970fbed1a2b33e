"""Is what remains more than the noise that is known?"""

from __future__ import annotations

from scipy import special

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.noise import NoiseLevel, position_rms

#: Chance below which the excess counts, and the ratio it must reach: stated figures are rarely exact.
LEVEL = 1e-4
RATIO = {"stated": 1.3, "repeats": 1.15}


def beyond_noise(fitted: Fitted, known: NoiseLevel) -> bool:
    """True where the position residual is larger than noise known from repeats or stated."""
    if known.sigma is None:
        return False
    ratio = position_rms(fitted) / known.sigma
    if ratio < RATIO[known.source]:
        return False
    chance = special.fdtrc(fitted.dof, min(known.dof, 1e6), ratio**2)
    return bool(chance < LEVEL)


def below_noise(fitted: Fitted, known: NoiseLevel) -> bool:
    """True where the residual is smaller than known noise can be: something fitted the noise itself."""
    if known.sigma is None:
        return False
    ratio = position_rms(fitted) / known.sigma
    return bool(special.fdtr(fitted.dof, min(known.dof, 1e6), ratio**2) < LEVEL)
