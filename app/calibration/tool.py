"""Captures -> ToolCalibration: the road that every mode with touches takes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from app import catalog
from app.calibration.captures import Capture, forward, of_role, stack, the_one
from app.calibration.orientation import Axis, cone, frame_from, frame_from_z, stroke_axis
from app.calibration.result import ToolCalibration
from app.calibration.solvers.joint import fit_joint
from app.calibration.solvers.pairwise import delta, fit_pairwise
from app.calibration.solvers.point_fit import PointFit
from app.calibration.solvers.robust import fit_robust
from app.errors import UnknownNameError
from app.geometry import Pose

METHODS: dict[str, Callable[..., PointFit]] = {
    "joint": fit_joint,
    "pairwise": fit_pairwise,
    "robust": fit_robust,
}
#: Orientation key -> the strokes it needs; the first is kept as taught, the second made square to it.
ORIENTATIONS: dict[str, tuple[str, ...]] = {
    "default": (),
    "z": ("z",),
    "zx": ("x", "z"),
    "xy": ("x", "y"),
}
CHECKS = "app.calibration.checks"


def calibrate(
    captures: Sequence[Capture],
    *,
    method: str = "joint",
    orientation: str | None = None,
    least_turn: float = 0.0,
    context: dict[str, Any] | None = None,
) -> ToolCalibration:
    """Tool point from the touches, axes from the strokes, then every check.

    Args:
        captures: any order of roles; the touches in the order they were made.
        method: "joint", "pairwise" or "robust".
        orientation: "default", "z", "zx" or "xy"; None takes what the roles allow.
        least_turn: angular spread [rad] that cannot be told from none, from the rounding of the angles.
        context: what checks may know besides (`tool_active`, `session_tool`, …).

    Raises:
        UnknownNameError: no such method or orientation.
        TooFewPointsError, DegenerateGeometryError: the touches cannot determine the tool point.
        CellValueError: a stroke that the orientation needs is missing.
    """
    if method not in METHODS:
        raise UnknownNameError(method, available=METHODS, what="method")
    captures = forward(captures)
    if orientation is None:
        orientation = allowed_orientation(captures)
    if orientation not in ORIENTATIONS:
        raise UnknownNameError(orientation, available=ORIENTATIONS, what="orientation")
    touches = of_role(captures, "touch")
    rotations, positions = stack(touches)
    fit = METHODS[method](rotations, positions, least=least_turn)
    rotation, axes = taught_axes(captures, orientation, fit.tool)
    covariance = fit.unit_covariance * fit.sigma**2
    result = ToolCalibration(
        T_flange_tool=Pose.of(rotation, fit.tool),
        p_base=fit.touched,
        method=method,
        orientation=orientation,
        residual_vectors=fit.residuals,
        delta=delta(rotations, positions, fit.tool),
        covariance=covariance,
        sigma=fit.sigma,
        dof=fit.dof,
        condition=fit.condition,
        rank=3,
        rows=tuple(c.row or i + 1 for i, c in enumerate(touches)),
        gains=fit.gains,
        weights=fit.weights,
        cones=tuple(cone(axis, covariance, fit.sigma, fit.dof) for axis in axes),
    )
    return checked(result, captures, context)


def checked(
    result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any] | None = None
) -> ToolCalibration:
    """The result with what every check found."""
    if context and context.get("quiet"):  # a mode that goes on from here and checks its own result
        return result
    found = []
    for check in catalog.members(CHECKS, "CHECK").values():
        found += check.look(result, captures, context or {})
    return result.with_warnings(*sorted(found, key=lambda w: (not w.severe, w.note)))


def allowed_orientation(captures: Sequence[Capture]) -> str:
    """The fullest orientation that the roles there are allow."""
    roles = {role.removeprefix("-") for c in captures for role in c.roles}
    if "origin" in roles:
        for key in ("zx", "xy", "z"):
            if set(ORIENTATIONS[key]) <= roles:
                return key
    return "default"


def taught_axes(
    captures: Sequence[Capture], orientation: str, tool: np.ndarray
) -> tuple[np.ndarray, tuple[Axis, ...]]:
    """R_flange_tool and the axes that were shown by strokes."""
    names = ORIENTATIONS[orientation]
    if not names:
        return np.eye(3), ()
    origin = the_one(captures, "origin")
    axes = tuple(stroke_axis(name, origin, the_one(captures, name), tool) for name in names)
    return (frame_from_z(axes[0]) if len(axes) == 1 else frame_from(axes[0], axes[1])), axes
