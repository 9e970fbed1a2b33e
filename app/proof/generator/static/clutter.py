"""An arm as it was built: every length, twist and zero a little off, or masses that are not those described."""

from __future__ import annotations

import numpy as np

from app.proof.generator.arm import Arm, link_axes
from app.proof.generator.rotations import turn, turn_vector

#: One-sigma errors of a well-made arm, per millimetre of clutter asked for.
LENGTH = 1.0  # m per m
TWIST = 1.2  # rad per m: 0.3 mm goes with 0.02 degrees
ZERO = 1.7  # rad per m
LUMPED_KG_PER_M = 20.0  # where a description states no masses


def as_built(arm: Arm, size: float, rng: np.random.Generator) -> Arm:
    """The arm with errors of one sigma `size` [m] in every length, and turns to match.

    The first zero and the last link stay as they are: they are the base's and the tool's.
    """
    rotations, translations = arm.rotations.copy(), arm.translations.copy()
    for link in range(1, arm.n):
        x, y, z = link_axes(arm, link)
        translations[link] += LENGTH * size * (rng.normal() * x + rng.normal() * z)
        twist = TWIST * size * (rng.normal() * x + rng.normal() * y)
        rotations[link] = turn_vector(twist) @ rotations[link]
        zero = ZERO * size * rng.normal()
        if arm.slides[link]:
            translations[link] += rotations[link] @ arm.axes[link] * zero
        else:
            rotations[link] = rotations[link] @ turn(arm.axes[link], np.array(zero))
    return arm.changed(rotations=rotations, translations=translations)


def misweighed(arm: Arm, share: float, rng: np.random.Generator) -> Arm:
    """The arm with masses up to `share` off and centres up to `share` of their distance."""
    factor = 1.0 + share * rng.uniform(-1.0, 1.0, arm.n)
    coms = arm.coms * (1.0 + share * rng.uniform(-1.0, 1.0, (arm.n, 3)))
    return arm.changed(masses=arm.masses * factor, coms=coms, inertias=arm.inertias * factor[:, None, None])


def lumped(arm: Arm) -> Arm:
    """The arm with a mass in the middle of every link, by its length."""
    reach = arm.translations[1:]
    mass = LUMPED_KG_PER_M * np.linalg.norm(reach, axis=1)
    return arm.changed(masses=mass, coms=0.5 * reach, inertias=0.01 * mass[:, None, None] * np.eye(3))
