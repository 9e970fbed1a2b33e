"""How well a tool is known, drawn at its tip: the 95% ellipsoid of its point and the 95% cones of its taught axes."""

from __future__ import annotations

import numpy as np
import viser

from app.calibration.quality.region import ellipsoid
from app.calibration.result import AxisCone, ToolCalibration
from app.geometry.rotation import quaternion_from_rotation
from app.scene.exaggeration import factor_for
from app.units import from_deg, from_mm

_LARGEST = from_mm(70.0)  # the longest half axis may be drawn this long
_WIDEST = from_deg(8.0)  # half angle of a cone as drawn
_LENGTH = from_mm(200.0)  # of a cone
_SIDES = 40
_ORANGE = (226, 96, 20)
_AXES = {"x": (214, 48, 49), "y": (46, 139, 87), "z": (42, 98, 184)}


def region_factor(result: ToolCalibration) -> int:
    """How many times larger than it is the ellipsoid is drawn."""
    return factor_for(float(ellipsoid(result).semi_axes[0]), _LARGEST)


def cone_factor(cone: AxisCone) -> int:
    """How many times wider than it is a cone is drawn."""
    return factor_for(cone.half_angle, _WIDEST)


def cone_ends(result: ToolCalibration) -> list[np.ndarray]:
    """(3,) where each cone ends, in the flange [m]."""
    rotation = result.T_flange_tool.rotation
    return [result.tool_point + _LENGTH * rotation[:, "xyz".index(cone.axis)] for cone in result.cones]


class Region:
    """Ellipsoid and cones; they hang on the flange and move with it.

    Args:
        flange_path: scene node of the flange.
    """

    def __init__(self, scene: viser.SceneApi, flange_path: str):
        self._scene, self._path = scene, flange_path
        self._handles: list[viser.SceneNodeHandle] = []
        self._number = 0

    def show(self, result: ToolCalibration | None) -> None:
        """Draws what is known of a result, or nothing."""
        for handle in self._handles:
            handle.remove()
        self._handles = []
        if result is None or not (len(result.residual_vectors) and result.sigma > 0):
            return
        self._number += 1  # the page keeps the pose of a removed node for the next one of that name
        root = f"{self._path}/region{self._number}"
        frame = self._scene.add_frame(root, show_axes=False, position=tuple(result.tool_point))
        self._handles.append(frame)
        found, factor = ellipsoid(result), region_factor(result)
        self._scene.add_icosphere(
            f"{root}/ellipsoid",
            1.0,
            _ORANGE,
            scale=_three(factor * found.semi_axes),
            wxyz=tuple(quaternion_from_rotation(found.directions)),
            opacity=0.45,
            cast_shadow=False,
            receive_shadow=False,
        )
        for cone in result.cones:
            self._cone(root, cone, result.T_flange_tool.rotation)

    def _cone(self, root: str, cone: AxisCone, rotation: np.ndarray) -> None:
        factor = cone_factor(cone)
        axis = rotation[:, "xyz".index(cone.axis)]
        vertices, faces = _cone_mesh(axis, min(factor * cone.half_angle, from_deg(80.0)))
        self._scene.add_mesh_simple(
            f"{root}/cone_{cone.axis}",
            vertices,
            faces,
            color=_AXES[cone.axis],
            opacity=0.35,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )


def _three(values: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(v) for v in values)
    return x, y, z


def _cone_mesh(axis: np.ndarray, half_angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of a cone from the origin along `axis` (3,)."""
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    a = np.cross(axis, helper)
    a /= np.linalg.norm(a)
    b = np.cross(axis, a)
    around = np.arange(_SIDES) * (2.0 * np.pi / _SIDES)
    out = np.cos(around)[:, None] * a + np.sin(around)[:, None] * b
    rim = _LENGTH * (np.cos(half_angle) * axis + np.sin(half_angle) * out)
    k = np.arange(_SIDES)
    faces = np.stack([np.zeros(_SIDES, int), 1 + k, 1 + (k + 1) % _SIDES], axis=1)
    return np.concatenate([np.zeros((1, 3)), rim]).astype(np.float32), faces.astype(np.uint32)
