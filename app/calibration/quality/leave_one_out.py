"""What each touch alone does to the result, and how well the others predict it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.calibration.captures import Capture, of_role, stack
from app.calibration.solvers.joint import fit_joint
from app.errors import DegenerateGeometryError


@dataclass(frozen=True)
class LeftOut:
    """One touch left out.

    Args:
        index: of the touch, from 0.
        shift: how far the tool point moves without it [m].
        heldout: distance of its tip from the point that the others touched, with the tool of the others [m].
    """

    index: int
    shift: float
    heldout: float


def leave_one_out(captures: Sequence[Capture]) -> tuple[LeftOut, ...]:
    """One entry a touch whose absence still leaves a solvable rest; () for three touches."""
    rotations, positions = stack(of_role(captures, "touch"))
    if len(positions) < 4:
        return ()
    whole = fit_joint(rotations, positions).tool
    out = []
    for i in range(len(positions)):
        keep = np.arange(len(positions)) != i
        try:
            rest = fit_joint(rotations[keep], positions[keep])
        except DegenerateGeometryError:
            continue
        tip = rotations[i] @ rest.tool + positions[i]
        out.append(
            LeftOut(i, float(np.linalg.norm(rest.tool - whole)), float(np.linalg.norm(tip - rest.touched)))
        )
    return tuple(out)
