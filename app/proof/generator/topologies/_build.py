"""From a table of link lengths to an arm with masses, written in frames that follow no one convention."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.rotations import from_rpy, random_direction, turn

HALF = np.pi / 2


def draw_arm(
    name: str,
    rng: np.random.Generator,
    rows: Sequence[tuple[float, float, float, float]],
    *,
    limits: Sequence[tuple[float, float]],
    masses: Sequence[float],
    speed: Sequence[float],
    effort: Sequence[float],
    slides: Sequence[int] = (),
    height: float = 0.0,
) -> Arm:
    """An arm from Denavit-Hartenberg rows.

    Args:
        rows: (a, alpha, d, theta at zero) of each link [m, rad].
        masses: [kg] of each link, varied by up to 30%.
        slides: joints (from 0) that slide along their axis.
        height: of the first joint over the base [m].
    """
    n = len(rows)
    x, z = np.eye(3)[0], np.eye(3)[2]
    rotations, translations = [], []
    inner, offset = np.eye(3), height * z
    for a, alpha, d, theta in rows:
        rotations.append(inner @ turn(z, np.array(theta)))
        translations.append(offset)
        inner, offset = turn(x, np.array(alpha)), d * z + a * x
    rotations.append(inner)
    translations.append(offset)
    mass = np.array(masses) * rng.uniform(0.7, 1.3, n)
    coms, inertias = np.empty((n, 3)), np.empty((n, 3, 3))
    for k in range(n):
        reach = translations[k + 1]
        length = np.linalg.norm(reach)
        coms[k] = rng.uniform(0.3, 0.6) * reach + rng.uniform(0.0, 0.02 + 0.08 * length) * random_direction(
            rng
        )
        thick = 0.03 + 0.05 * (mass[k] / 10.0) ** (1 / 3)
        spread = (length / 4.0) ** 2 * np.outer(reach, reach) / max(length, 1e-9) ** 2
        spread = spread + np.diag(rng.uniform(0.7, 1.3, 3) * thick**2 / 4.0)
        inertias[k] = mass[k] * (np.trace(spread) * np.eye(3) - spread)
    arm = Arm(
        name,
        np.array(rotations),
        np.array(translations),
        np.tile(z, (n, 1)),
        np.array([k in slides for k in range(n)]),
        np.array([low for low, _ in limits]),
        np.array([high for _, high in limits]),
        np.array(speed, float),
        np.array(effort, float),
        mass,
        coms,
        inertias,
    )
    return _relabelled(arm, rng) if rng.random() < 0.5 else arm


def _relabelled(arm: Arm, rng: np.random.Generator) -> Arm:
    """The same arm with every link's frame turned by some quarter turns, so that joint axes are x, y or z."""
    rotations, translations = arm.rotations.copy(), arm.translations.copy()
    axes, coms, inertias = arm.axes.copy(), arm.coms.copy(), arm.inertias.copy()
    for k in range(arm.n):
        quarter = np.rint(from_rpy(*(HALF * rng.integers(0, 4, 3))))
        rotations[k] = rotations[k] @ quarter
        axes[k] = quarter.T @ axes[k]
        coms[k] = quarter.T @ coms[k]
        inertias[k] = quarter.T @ inertias[k] @ quarter
        rotations[k + 1] = quarter.T @ rotations[k + 1]
        translations[k + 1] = quarter.T @ translations[k + 1]
    return arm.changed(
        rotations=rotations, translations=translations, axes=axes, coms=coms, inertias=inertias
    )
