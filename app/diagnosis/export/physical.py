"""Masses that a fit gives and no body can have -> the nearest that one can.

Ten parameters belong to a body of positive mass everywhere exactly where its pseudo-inertia is positive definite:

    P = [ S  h ; h^T m ],   S = 1/2 tr(I) E - I,   I about the frame's origin

Simulators refuse anything else. The nearest such P (Frobenius) has P's eigenvalues lifted to a small positive one.

Source: Wensing, Kim, Slotine (2018), IEEE RA-L 3(1), eq. (12).
"""

from __future__ import annotations

import numpy as np

#: Smallest eigenvalue that is left, relative to the largest, and at least [kg or kg m^2]: what simulators take.
_SMALLEST, _FLOOR = 1e-7, 1e-9


def physical(inertial: np.ndarray) -> np.ndarray:
    """(10,) parameters, unchanged where a body can have them."""
    pseudo = _pseudo(inertial)
    values, vectors = np.linalg.eigh(pseudo)
    least = max(_SMALLEST * float(values[-1]), _FLOOR)
    if values[0] >= least:
        return inertial
    return _parameters(vectors @ np.diag(np.maximum(values, least)) @ vectors.T)


def _pseudo(inertial: np.ndarray) -> np.ndarray:
    xx, xy, yy, xz, yz, zz = inertial[4:]
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    out = np.empty((4, 4))
    out[:3, :3] = 0.5 * np.trace(about) * np.eye(3) - about
    out[:3, 3] = out[3, :3] = inertial[1:4]
    out[3, 3] = inertial[0]
    return out


def _parameters(pseudo: np.ndarray) -> np.ndarray:
    second = pseudo[:3, :3]
    about = np.trace(second) * np.eye(3) - second
    six = [about[0, 0], about[0, 1], about[1, 1], about[0, 2], about[1, 2], about[2, 2]]
    return np.array([pseudo[3, 3], *pseudo[:3, 3], *six])
