"""Draws an arm: nested joint frames whose own turn is all that changes when it moves.

Everything that moves together and has one colour is one mesh, so an arm is some twenty messages once and
one quaternion a joint afterwards.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
import viser

from app.geometry.pose import Pose
from app.geometry.rotation import quaternion_from_rotation
from app.kinematics import RobotModel, load_robot
from app.kinematics.shapes import Shape, rod
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
        self._placements = [quaternion_from_rotation(r) for r in chain.rotations]
        self._root = scene.add_frame(root, show_axes=False)
        paths, self._joints = [root], []
        for k in range(robot.joint_count):
            paths.append(f"{paths[-1]}/joint{k + 1}")
            self._joints.append(
                scene.add_frame(
                    paths[-1],
                    show_axes=False,
                    wxyz=tuple(self._placements[k]),
                    position=tuple(chain.translations[k]),
                )
            )
        self.flange_path = f"{paths[-1]}/flange"
        self._flange = scene.add_frame(
            self.flange_path,
            show_axes=False,
            wxyz=tuple(quaternion_from_rotation(chain.flange_rotation)),
            position=tuple(chain.flange_translation),
        )
        for index, (body, colour, vertices, triangles) in enumerate(_arm_meshes(robot)):
            _add(scene, f"{paths[body]}/solid{index}", colour, vertices, triangles, ghost)
        if tool:
            draw_shapes(scene, f"{self.flange_path}/tool_body", tool_shapes(robot), ghost=ghost)
        self._q = np.zeros(robot.joint_count)
        self.set(robot.home)

    def set(self, q: np.ndarray) -> None:
        """Shows the arm at q (n,) [rad or m]; only joints that moved are sent."""
        q = np.asarray(q, float)
        moved_joints = np.abs(q - self._q) > _SEEN
        for k in np.flatnonzero(moved_joints):
            axis, placement = self.robot.chain.axes[k], self._placements[k]
            if self.robot.joints[k].prismatic:
                chain = self.robot.chain
                moved = chain.translations[k] + chain.rotations[k] @ axis * q[k]
                self._joints[k].position = tuple(moved)
            else:
                self._joints[k].wxyz = _then_turn(placement, axis, float(q[k]))
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


def draw_shapes(
    scene: viser.SceneApi,
    root: str,
    shapes: Sequence[Shape],
    *,
    ghost: bool = False,
    bend: Bend | None = None,
) -> viser.FrameHandle:
    """Draws shapes that stand still relative to the node `root`: a tool, a spike, a table; bent, where wanted."""
    frame = scene.add_frame(root, show_axes=False)
    for index, (_, colour, vertices, triangles) in enumerate(_merged(solids(shapes))):
        if bend is not None:
            vertices = bend(vertices).astype(np.float32)
        _add(scene, f"{root}/solid{index}", colour, vertices, triangles, ghost)
    return frame


def pointer_shapes(T_flange_tool: Pose) -> tuple[Shape, ...]:
    """A plain pointer from the flange to a tool point, for tools that have no drawing of their own."""
    tip = T_flange_tool.position
    length = float(np.linalg.norm(tip))
    if length < 1e-4:
        return ()
    radius = min(0.02, 0.12 * length)
    neck = tip * max(0.55, 1.0 - 0.08 / length)
    steel, dark = (0.72, 0.74, 0.76), (0.16, 0.17, 0.19)
    return (
        rod(np.zeros(3), neck, radius, 0.7 * radius, link="tool", colour=dark),
        rod(neck, tip, 0.6 * radius, 0.0, link="tool tip", colour=steel),
    )


@cache
def _shipped_meshes(name: str) -> tuple[Mesh, ...]:
    return _merged(robot_solids(load_robot(name)))


def _arm_meshes(robot: RobotModel) -> tuple[Mesh, ...]:
    """Meshes of a robot; those of a shipped one are computed once for all browsers."""
    return _shipped_meshes(robot.name) if robot.description else _merged(robot_solids(robot))


def _merged(parts: Sequence[Solid]) -> tuple[Mesh, ...]:
    """One mesh for each body and colour."""
    families: dict[tuple[int, tuple[int, int, int]], list[tuple[np.ndarray, np.ndarray]]] = {}
    for solid in parts:
        red, green, blue = (round(255 * c) for c in solid.colour)
        families.setdefault((solid.body, (red, green, blue)), []).append(faces(solid.points))
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
