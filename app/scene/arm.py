"""Draws an arm: nested joint frames whose own turn is all that changes when it moves.

Everything that moves together and has one colour is one mesh, so an arm is some twenty messages once and
one quaternion a joint afterwards.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import viser

from app.geometry.rotation import quaternion_from_rotation
from app.kinematics import RobotModel
from app.kinematics.shapes import Shape
from app.kinematics.solids import Solid, faces, robot_solids, solids, tool_shapes

GHOST_OPACITY = 0.35
_SEEN = 1e-6  # rad or m: a joint that moved less is not sent; inverse kinematics never leaves one quite alone
#: Moves vertices (n, 3) [m] of a drawing.
Bend = Callable[[np.ndarray], np.ndarray]
Mesh = tuple[int, tuple[int, int, int], np.ndarray, np.ndarray]


class ArmView:
    """One arm in a scene.

    Calls belong inside the caller's `client.atomic()`, so that an arm never shows half a move.

    Args:
        scene: a client's or the server's scene.
        robot: what to draw.
        root: name of the scene node it hangs on; place that node to place the arm.
        ghost: translucent, for a second opinion of where the arm is.
        tool: draws the tool a shipped robot carries (robots/<name>/tool.urdf).
    """

    def __init__(
        self,
        scene: viser.SceneApi,
        robot: RobotModel,
        root: str = "/arm",
        ghost: bool = False,
        tool: bool = True,
    ):
        self.robot = robot
        chain = robot.chain
        self._steps = chain.steps
        self._placements = [quaternion_from_rotation(step.rotation) for step in self._steps]
        self._root = scene.add_frame(root, show_axes=False)
        paths, self._joints, last = {0: root}, [], root
        for step, placement in zip(self._steps, self._placements, strict=True):
            last = paths[step.body] = f"{last}/joint{step.body}"
            self._joints.append(
                scene.add_frame(
                    last, show_axes=False, wxyz=tuple(placement), position=tuple(step.translation)
                )
            )
        self.paths = paths  # body -> the node that it is drawn on
        self.flange_path = f"{last}/flange"
        self._flange = scene.add_frame(
            self.flange_path,
            show_axes=False,
            wxyz=tuple(quaternion_from_rotation(chain.flange_rotation)),
            position=tuple(chain.flange_translation),
        )
        for index, (body, colour, vertices, triangles) in enumerate(arm_meshes(robot)):
            _add(scene, f"{paths[body]}/solid{index}", colour, vertices, triangles, ghost)
        if tool:
            draw_meshes(scene, f"{self.flange_path}/tool_body", merged(tool_shapes(robot)), ghost=ghost)
        self._q = np.zeros(robot.joint_count)
        self.set(robot.home)

    def set(self, q: np.ndarray) -> None:
        """Shows the arm at q (n,) [rad or m]; only joints that moved are sent."""
        q = np.asarray(q, float)
        moved_joints = np.abs(q - self._q) > _SEEN
        for step, placement, node in zip(self._steps, self._placements, self._joints, strict=True):
            if not moved_joints[step.source]:
                continue
            value = step.multiplier * float(q[step.source]) + step.offset
            if step.prismatic:
                node.position = tuple(step.translation + step.rotation @ step.axis * value)
            else:
                node.wxyz = _then_turn(placement, step.axis, value)
        self._q = np.where(moved_joints, q, self._q)

    @property
    def q(self) -> np.ndarray:
        """(n,) where it is shown [rad or m]."""
        return self._q.copy()

    @property
    def visible(self) -> bool:
        return self._root.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._root.visible = value

    def remove(self) -> None:
        """Takes the arm, and whatever hangs on its flange, out of the scene."""
        self._root.remove()


def draw_shapes(scene: viser.SceneApi, root: str, shapes: Sequence[Shape]) -> viser.FrameHandle:
    """Draws shapes that stand still relative to the node `root`: a tool, a spike, a table."""
    return draw_meshes(scene, root, merged(shapes))


def draw_meshes(
    scene: viser.SceneApi,
    root: str,
    meshes: Sequence[Mesh],
    *,
    ghost: bool = False,
    bend: Bend | None = None,
) -> viser.FrameHandle:
    """The same of shapes that were merged before; bent, where wanted."""
    frame = scene.add_frame(root, show_axes=False)
    for index, (_, colour, vertices, triangles) in enumerate(meshes):
        if bend is not None:
            vertices = bend(vertices).astype(np.float32)
        _add(scene, f"{root}/solid{index}", colour, vertices, triangles, ghost)
    return frame


def arm_meshes(robot: RobotModel) -> tuple[Mesh, ...]:
    """Meshes of an arm, worked out once for all who see it."""
    if "meshes" not in robot.kept:
        robot.kept["meshes"] = _merged(robot_solids(robot))
    return robot.kept["meshes"]


def merged(shapes: Sequence[Shape]) -> tuple[Mesh, ...]:
    """What `draw_meshes` draws of shapes."""
    return _merged(solids(shapes))


def _merged(parts: Sequence[Solid]) -> tuple[Mesh, ...]:
    """One mesh for each body and colour."""
    families: dict[tuple[int, tuple[int, int, int]], list[tuple[np.ndarray, np.ndarray]]] = {}
    for solid in parts:
        red, green, blue = (round(255 * c) for c in solid.colour)
        drawn = faces(solid.points) if solid.mesh is None else (solid.mesh.vertices, solid.mesh.triangles)
        families.setdefault((solid.body, (red, green, blue)), []).append(drawn)
    meshes = []
    for (body, colour), members in families.items():
        starts = np.cumsum([0] + [len(vertices) for vertices, _ in members])
        vertices = np.concatenate([vertices for vertices, _ in members]).astype(np.float32)
        triangles = np.concatenate([t + start for (_, t), start in zip(members, starts, strict=False)])
        meshes.append((body, colour, vertices, triangles.astype(np.uint32)))
    return tuple(meshes)


def _add(scene: viser.SceneApi, name: str, colour, vertices, triangles, ghost: bool) -> None:
    scene.add_mesh_simple(
        name,
        vertices,
        triangles,
        color=colour,
        opacity=GHOST_OPACITY if ghost else None,
        cast_shadow=not ghost,
        receive_shadow=not ghost,
    )


def _then_turn(placement: np.ndarray, axis: np.ndarray, angle: float) -> tuple[float, float, float, float]:
    """placement * (cos a/2, axis sin a/2), wxyz; on plain floats, because numpy's calls cost more than the sums."""
    w0, x0, y0, z0 = placement.tolist()
    w1, s = math.cos(angle / 2), math.sin(angle / 2)
    x1, y1, z1 = (s * part for part in axis.tolist())
    return (
        w0 * w1 - x0 * x1 - y0 * y1 - z0 * z1,
        w0 * x1 + x0 * w1 + y0 * z1 - z0 * y1,
        w0 * y1 - x0 * z1 + y0 * w1 + z0 * x1,
        w0 * z1 + x0 * y1 - y0 * x1 + z0 * w1,
    )
