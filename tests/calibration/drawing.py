"""Touches drawn with known truth."""

import numpy as np

from app.calibration.captures import Capture
from app.geometry import Pose, exp_so3, rot_z

TOOL = np.array([0.12, 0.0, 0.35])
SPIKE = np.array([1.0, 0.1, 0.4])


def turns(count, tilt, rng, twist=0.7):
    """(n, 3, 3) tool down, tilted by up to `tilt` [rad] all around, turned by up to `twist` about itself."""
    around = 2.4 * np.arange(count) + rng.uniform(0.0, 1.0)
    lean = tilt * np.sqrt(rng.uniform(0.5, 1.0, count))
    tilted = exp_so3(np.stack([lean * np.cos(around), lean * np.sin(around), 0 * lean], axis=1))
    return tilted @ rot_z(rng.uniform(-twist, twist, count))


def touches(count=5, tilt=0.6, noise=0.0, seed=0, rotations=None):
    """Rotations (n, 3, 3) and positions (n, 3) [m] of touches of SPIKE with TOOL."""
    rng = np.random.default_rng(seed)
    rotations = turns(count, tilt, rng) if rotations is None else rotations
    positions = SPIKE - rotations @ TOOL + rng.normal(0.0, noise, (len(rotations), 3))
    return rotations, positions


def captures(rotations, positions, role="touch"):
    """One capture a touch."""
    return [
        Capture(f"{role}{i + 1}", role, Pose.of(r, p), None, i + 1)
        for i, (r, p) in enumerate(zip(rotations, positions, strict=True))
    ]


def stroke(origin, role, vector, turn=None):
    """A capture whose tip went by `vector` [m] (in the flange) from `origin`'s, turned by `turn`."""
    flange = origin.T_base_flange
    rotation = flange.rotation @ (np.eye(3) if turn is None else turn)
    tip = flange.apply(TOOL) + flange.rotation @ np.asarray(vector, float)
    return Capture(role, role, Pose.of(rotation, tip - rotation @ TOOL), None, 99)
