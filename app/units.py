"""Units at the edges: the only file that holds a conversion factor.

Inside the program everything is metres, radians, seconds, kilograms and newton-metres. A quantity that
leaves or enters (file, screen, command line) carries its unit in its name and passes through here.
"""

from __future__ import annotations

import math

MM_PER_M = 1000.0
UM_PER_M = 1.0e6
MM_PER_CM = 10.0
MM_PER_INCH = 25.4
DEG_PER_RAD = 180.0 / math.pi

#: Suffix of a column or parameter -> factor that brings its values to SI (`iso` is a moment written by ISO 8601, which
#: is read as seconds since 1970).
SI_FACTORS: dict[str, float] = {
    "mm": 1.0 / MM_PER_M,
    "m": 1.0,
    "deg": 1.0 / DEG_PER_RAD,
    "rad": 1.0,
    "s": 1.0,
    "ms": 1.0e-3,
    "us": 1.0e-6,
    "ns": 1.0e-9,
    "iso": 1.0,
    "Nm": 1.0,
    "A": 1.0,
    "rad_s": 1.0,
    "deg_s": 1.0 / DEG_PER_RAD,
    "m_s": 1.0,
    "mm_s": 1.0 / MM_PER_M,
    "kg": 1.0,
    "degC": 1.0,
    "Nm_per_A": 1.0,
}


def mm(metres):
    """Metres -> millimetres; scalars and arrays."""
    return metres * MM_PER_M


def from_mm(millimetres):
    """Millimetres -> metres; scalars and arrays."""
    return millimetres / MM_PER_M


def deg(radians):
    """Radians -> degrees; scalars and arrays."""
    return radians * DEG_PER_RAD


def from_deg(degrees):
    """Degrees -> radians; scalars and arrays."""
    return degrees / DEG_PER_RAD


def um(metres):
    """Metres -> micrometres; scalars and arrays."""
    return metres * UM_PER_M


def from_um(micrometres):
    """Micrometres -> metres; scalars and arrays."""
    return micrometres / UM_PER_M
