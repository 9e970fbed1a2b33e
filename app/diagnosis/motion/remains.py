"""What is left of each joint's torque: more than the stated noise, or with a memory that no sensor has?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.motion.errors import raw_columns
from app.diagnosis.motion.scoring import Solution
from app.diagnosis.motion.system import System
from app.diagnosis.wording import joints, note
from app.phrases import Said

EXCESS = 0.10  # of the stated variance
ABOVE = 0.05  # of the variance that free curves leave
LONGEST_MEMORY = 0.25  # s: sensors and drives forget faster than this
_SURE = 5.0  # standard deviations


@dataclass(frozen=True, eq=False)
class Remains:
    """Per joint.

    Args:
        ratio: (n,) variance of the residual over the stated one; nan where none is stated.
        memory: (n,) time [s] over which the residual hangs together.
        energy: (n,) what is left over, in squares of the whitened noise; 0 where nothing is.
        above: (n,) variance over that of a fit with every law and curve at once; nan where it is no larger.
    """

    ratio: np.ndarray
    memory: np.ndarray
    energy: np.ndarray
    above: np.ndarray

    def worst(self) -> int | None:
        """The joint with the most left over, or None."""
        return int(np.argmax(self.energy)) if self.energy.max() > 0 else None

    def sentences(self) -> list[Said]:
        """Remarks on what is left over, joints that say the same together."""
        said: dict[str, list[tuple[int, float]]] = {}
        for j in np.flatnonzero(self.energy > 0).tolist():
            if np.isfinite(self.ratio[j]) and self.ratio[j] > 1 + EXCESS:
                key, size = "above_stated", np.sqrt(self.ratio[j])
            elif np.isfinite(self.above[j]):
                key, size = "above_curves", np.sqrt(self.above[j])
            else:
                key, size = "hangs_together", self.memory[j]
            said.setdefault(key, []).append((j + 1, float(size)))
        return [
            note(key, joints=joints([j for j, _ in found]), sizes=tuple(f"{size:.2f}" for _, size in found))
            for key, found in said.items()
        ]


def remains_of(
    system: System, solution: Solution, stated: np.ndarray | None, moved: np.ndarray, moved_out: np.ndarray
) -> Remains:
    """Compares the residual with the stated noise, and looks for a memory in it.

    Args:
        stated: (n,) one-sigma of a pooled torque [Nm].
        moved: (n,) part of it that comes from errors of the motion: no curve takes it up, and a repeat has it too.
        moved_out: (M, n) torque [Nm] of laws that the linear model has on the other side.
    """
    n, columns = system.joints, raw_columns(system, solution.selected)
    ratio, memory, energy = np.full(n, np.nan), np.zeros(n), np.zeros(n)
    above = np.full(n, np.nan)
    for j, (part, col, pos, whitener) in enumerate(
        zip(system.parts, solution.columns, solution.positions, system.whiteners, strict=True)
    ):
        rows = whitener.weight > 0
        count = int(rows.sum())
        if count < 50:
            continue
        white = part.residual(col, solution.theta[pos])[rows]
        level = float(white @ white) / count
        spread = whitener.spread * np.sqrt(max(level, 1e-12))
        rho = whitener.correlation()
        memory[j] = system.samples.step * (0.5 + float(np.sum(np.abs(rho[1:]))))
        free = count / (1 + 2 * float(np.sum(rho[1:] ** 2)))
        if stated is not None:
            # An autoregression with a long memory promises more than there is: what is there counts.
            plain = system.samples.y[:, j] - moved_out[:, j] - columns[j] @ solution.theta[pos]
            size = float(np.sqrt(np.mean(plain[system.samples.usable[:, j]] ** 2)))
            ratio[j] = (min(spread, size) / stated[j]) ** 2
            if ratio[j] > 1 + EXCESS + _SURE * np.sqrt(2 / free):
                energy[j] = count * (ratio[j] - 1) * (stated[j] / whitener.sigma) ** 2
        beyond = level / (1 + (moved[j] / whitener.spread) ** 2)
        if beyond > 1 + ABOVE + _SURE * np.sqrt(2 / count):
            energy[j] = max(energy[j], count * (beyond - 1))
            above[j] = level
        if stated is None and memory[j] > max(LONGEST_MEMORY, 6 * system.samples.step):
            energy[j] = max(energy[j], count * (spread / whitener.sigma) ** 2)
    return Remains(ratio, memory, energy, above)
