"""The tool's axes, from strokes of the tip or from sightings of a fixed point.

A stroke keeps the tool's orientation and moves the tip along one of its axes:

    v = R_o^T (R_x t + p_x - R_o t - p_o)          (11)-(15), the axis seen in the flange

Two axes make a frame: the first is kept as taught, the second is made square to it (eqs. 17 and 18 keep X).

Source: Xiong, Ye, Jiang (2012), eqs. (11)-(18).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from app.calibration.captures import Capture
from app.calibration.result import AxisCone
from app.calibration.wording import degenerate
from app.units import deg, mm

#: Strokes below this cannot show a direction at all [m].
NO_STROKE = 1e-6
#: Axes closer than this to one line make no frame [rad].
PARALLEL = 0.02
_PLACE = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, eq=False)
class Axis:
    """One taught axis in the flange.

    Args:
        name: "x", "y" or "z".
        direction: (3,) unit.
        stroke: length that showed it [m].
        lever: (3, 3) how an error of the tool point moves the end of the stroke, in the flange.
    """

    name: str
    direction: np.ndarray
    stroke: float
    lever: np.ndarray


def stroke_axis(name: str, origin: Capture, end: Capture, tool: np.ndarray) -> Axis:
    """The axis along which the tip went from `origin` to `end` (eqs. 13-16).

    Raises:
        DegenerateGeometryError: the tip did not move.
    """
    first, second = origin.T_base_flange, end.T_base_flange
    vector = first.rotation.T @ (second.apply(tool) - first.apply(tool))
    return _axis(name, vector, first.rotation.T @ second.rotation - np.eye(3))


def seen_axis(name: str, vector: np.ndarray, lever: np.ndarray | None = None) -> Axis:
    """An axis given as a vector in the flange [m]."""
    return _axis(name, np.asarray(vector, float), np.zeros((3, 3)) if lever is None else lever)


def _axis(name: str, vector: np.ndarray, lever: np.ndarray) -> Axis:
    length = float(np.linalg.norm(vector))
    if length < NO_STROKE:
        letter = name.upper()
        raise degenerate("short_stroke", rank=0, needed=1, unseen=f"tool {letter}", axis=letter)
    return Axis(name, vector / length, length, lever)


def frame_from(kept: Axis, second: Axis) -> np.ndarray:
    """R_flange_tool whose axis `kept` is exact and whose axis `second` is made square to it.

    Raises:
        DegenerateGeometryError: both on one line.
    """
    across = second.direction - (second.direction @ kept.direction) * kept.direction
    length = float(np.linalg.norm(across))
    if length < PARALLEL:
        raise degenerate(
            "nearly_parallel",
            rank=1,
            needed=2,
            first=kept.name.upper(),
            second=second.name.upper(),
            deg=float(deg(np.arcsin(length))),
        )
    columns = np.zeros((3, 3))
    a, b = _PLACE[kept.name], _PLACE[second.name]
    columns[:, a], columns[:, b] = kept.direction, across / length
    third = 3 - a - b
    sign = 1.0 if (b - a) % 3 == 1 else -1.0
    columns[:, third] = sign * np.cross(columns[:, a], columns[:, b])
    return columns


def frame_from_z(z: Axis) -> np.ndarray:
    """R_flange_tool with Z as taught and X the flange's X made square to it (its Y, where X runs along Z)."""
    for column in (0, 1):
        helper = seen_axis("x", np.eye(3)[column])
        if abs(z.direction[column]) < 0.99:
            return frame_from(z, helper)
    raise AssertionError("a unit vector cannot lie along two axes")


def cone(axis: Axis, covariance: np.ndarray, sigma: float, dof: int) -> AxisCone:
    """How well the axis is known: both ends of the stroke carry touch noise, and the tool point its own error.

    Args:
        covariance: (3, 3) of the tool point [m^2].
        sigma: one-sigma noise of one touch on one axis [m].
        dof: degrees of freedom behind sigma; 0 where it is known beforehand.
    """
    ends = 2.0 * sigma**2 * np.eye(3) + axis.lever @ covariance @ axis.lever.T
    across = np.eye(3) - np.outer(axis.direction, axis.direction)
    spread = float(np.sqrt(np.linalg.eigvalsh(across @ ends @ across)[-1])) / axis.stroke
    quantile = special.fdtri(2, dof, 0.95) if dof > 0 else special.chdtri(2, 0.05) / 2.0
    return AxisCone(axis.name, axis.stroke, spread, float(np.arctan(spread * np.sqrt(2.0 * quantile))))


def describe(axis: Axis) -> str:
    """One line: what was moved how far."""
    return f"{axis.name.upper()} over {mm(axis.stroke):.1f} mm"
