"""What each touch alone does to the result, and how well the others predict it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.calibration.captures import Capture, of_role, stack
from app.calibration.solvers.joint import fit_joint
from app.calibration.solvers.point_fit import NO_TURN


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
    tools, touched, spreads = without_each(rotations, positions)
    shifts = np.linalg.norm(tools - whole, axis=1)
    tips = np.einsum("nij,nj->ni", rotations, tools) + positions
    heldout = np.linalg.norm(tips - touched, axis=1)
    return tuple(
        LeftOut(i, float(shifts[i]), float(heldout[i])) for i in np.flatnonzero(spreads > NO_TURN).tolist()
    )


def without_each(rotations: np.ndarray, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The joint fit of all touches but one, for every one of them, in a time that grows with their number.

    Every sum of the normal equations (app/calibration/solvers/joint.py) loses one term.

    Args:
        rotations: (n, 3, 3) of the flange, n at least 4.
        positions: (n, 3) [m].

    Returns:
        tools (n, 3) and touched points (n, 3) [m], and (n,) the smallest angular spread of the rest [rad]: where it
        is zero the two others are meaningless.
    """
    rest = len(positions) - 1
    centre = positions.mean(axis=0)  # sums of large numbers lose digits
    near = positions - centre
    turned = np.einsum("nji,nj->ni", rotations, near)  # R^T p
    mean_r = (rotations.sum(axis=0) - rotations) / rest
    mean_p = (near.sum(axis=0) - near) / rest
    product = (turned.sum(axis=0) - turned) / rest
    normal = np.eye(3) - np.swapaxes(mean_r, 1, 2) @ mean_r
    right = np.einsum("nji,nj->ni", mean_r, mean_p) - product
    values, vectors = np.linalg.eigh(normal)
    along = np.einsum("nji,nj->ni", vectors, right) / np.maximum(values, 1e-300)
    tools = np.einsum("nij,nj->ni", vectors, along)
    touched = np.einsum("nij,nj->ni", mean_r, tools) + mean_p + centre
    return tools, touched, np.sqrt(np.maximum(values[:, 0], 0.0))
