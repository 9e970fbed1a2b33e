"""What the Compare screen draws in the cell: arm, ghost, arrows, loads as colours, proposed poses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from app.kinematics import RobotModel
from app.scene import Scene
from app.scene.arm import ArmView
from app.scene.instead import Instead
from app.screens._compare.ghost import joints_for_point
from app.screens._compare.loaded import Loaded
from app.units import from_mm, mm

ROOT = "/compare"
_BEFORE, _AFTER = np.array([217, 123, 22]), np.array([24, 102, 173])
_THIS = np.array([214, 40, 57])
_GOOD, _BAD = np.array([47, 158, 68]), np.array([224, 49, 49])
_MOST_ARROWS = 400
_SHAFT, _HEAD, _HEAD_LENGTH = from_mm(2.0), from_mm(5.5), from_mm(15.0)
_POSES_SEEN = 300
_FROM = np.array([1.0, -0.8, 0.55])  # the eye's direction
_NOISE_IS_GREEN = 4.0
_RING, _TUBE = 0.085, 0.013  # of a joint's ring, as shares of the reach


class Drawing:
    """Everything of one loaded recording, under one node.

    Args:
        scene: the browser's scene.
        loaded: what is shown.
    """

    def __init__(self, scene: Scene, loaded: Loaded):
        self._scene, self._loaded = scene, loaded
        self._root = scene.add_frame(ROOT, show_axes=False)
        self._arm = ArmView(scene, loaded.robot, f"{ROOT}/arm", tool=False)
        tip = loaded.evidence.flange_tool
        self._tip = None if tip is None else np.asarray(tip, float)
        self._ghost: ArmView | None = None
        if self._tip is not None and loaded.points is not None:
            self._ghost = ArmView(scene, loaded.robot, f"{ROOT}/ghost", ghost=True, tool=False)
            for arm, colour in ((self._arm, _BEFORE), (self._ghost, _THIS)):
                _pointer(scene, arm.flange_path, self._tip, colour)
        self._arrows: Any = None
        self._label: Any = None
        self._rings = _rings(scene, loaded.robot) if loaded.moving else []
        self._load_scale = _load_scale(loaded)
        self._next: list[ArmView] = []

    def update(self, loaded: Loaded) -> None:
        """The same recording, with more known of it."""
        self._loaded, self._load_scale = loaded, _load_scale(loaded)

    def row(self, index: int, share: float, factor: float) -> None:
        """Arm and ghost at one row; `share` of the way from before (0) to after (1)."""
        loaded = self._loaded
        q = loaded.evidence.q[index]
        self._arm.set(q)
        for k, ring in enumerate(self._rings):
            ring.color = _load_colour(loaded, index, k, share, self._load_scale[k])
        if self._ghost is None or loaded.points is None or self._tip is None:
            return
        shift = loaded.vectors(share)[index]
        frames = loaded.robot.chain.frames(q[None])
        tip = frames.flange_positions[0] + frames.flange_rotations[0] @ self._tip
        self._ghost.set(joints_for_point(loaded.robot, q, self._tip, tip + factor * shift))
        text = f"{mm(float(np.linalg.norm(shift))):.2f} mm × {factor:g}"
        if self._label is None:
            self._label = self._scene.add_label(
                f"{ROOT}/label", text, position=tuple(tip + factor * shift), anchor="bottom-left"
            )
        else:
            self._label.text = text
            self._label.position = tuple(tip + factor * shift)

    def arrows(self, index: int, share: float, factor: float, *, shown: bool = True) -> None:
        """Residuals of all rows where the simulation puts the tool; the shown row in red."""
        loaded = self._loaded
        if not shown or loaded.points is None:
            if self._arrows is not None:
                self._arrows.remove()
                self._arrows = None
            return
        rows = np.flatnonzero(loaded.evidence.kept & np.isfinite(loaded.points).all(1))
        if len(rows) > _MOST_ARROWS:
            rows = rows[np.linspace(0, len(rows) - 1, _MOST_ARROWS).astype(int)]
        rows = np.union1d(rows, [index])
        start = loaded.points[rows]
        points = np.stack([start, start + factor * loaded.vectors(share)[rows]], axis=1).astype(np.float32)
        colours = np.tile(((1.0 - share) * _BEFORE + share * _AFTER).astype(np.uint8), (len(rows), 1))
        colours[rows == index] = _THIS
        if self._arrows is not None and len(self._arrows.points) == len(rows):
            self._arrows.points, self._arrows.colors = points, colours
            return
        if self._arrows is not None:
            self._arrows.remove()
        self._arrows = self._scene.add_arrows(
            f"{ROOT}/arrows",
            points,
            colours,
            shaft_radius=_SHAFT,
            head_radius=_HEAD,
            head_length=_HEAD_LENGTH,
        )

    def next_poses(self, poses: Sequence[Sequence[float]]) -> None:
        """Proposed poses as ghosts; an empty list takes them away."""
        for arm in self._next:
            arm.remove()
        self._next = []
        for k, q in enumerate(poses):
            arm = ArmView(self._scene, self._loaded.robot, f"{ROOT}/next{k}", ghost=True, tool=False)
            arm.set(np.asarray(q, float))
            self._next.append(arm)

    def remove(self) -> None:
        """Takes everything away."""
        self._root.remove()


def instead(loaded: Loaded, index: int) -> Instead:
    """The arm and every recorded point, and the flange at a row, for whoever looks there."""
    q = loaded.evidence.q[np.linspace(0, loaded.count - 1, min(loaded.count, _POSES_SEEN)).astype(int)]
    frames = loaded.robot.chain.frames(q)
    around = np.concatenate(
        [np.zeros((1, 3)), frames.joint_positions.reshape(-1, 3), frames.flange_positions]
    )
    points = loaded.points
    if points is not None and np.isfinite(points).any():
        around = np.concatenate([around, points[np.isfinite(points).all(1)]])
    flange = loaded.robot.forward(loaded.evidence.q[min(index, loaded.count - 1)])
    return Instead(around, flange.position, _FROM)


def _pointer(scene: Scene, flange: str, tip: np.ndarray, colour: np.ndarray) -> None:
    """A line from the flange to the tool point and a ball there, so that two tips can be told apart."""
    scene.add_line_segments(
        f"{flange}/pointer",
        np.array([[np.zeros(3), tip]], np.float32),
        colour,
        thickness=from_mm(6.0),
    )
    scene.add_icosphere(
        f"{flange}/tip",
        radius=from_mm(11.0),
        color=colour,
        position=tuple(tip),
        subdivisions=2,
        cast_shadow=False,
    )


def _rings(scene: Scene, robot: RobotModel) -> list:
    """A ring around every joint's axis, coloured by its residual."""
    reach = float(robot.description.get("reach_m", robot.reach))
    rings, path = [], f"{ROOT}/arm"
    for k in range(robot.joint_count):
        path = f"{path}/joint{k + 1}"
        vertices, triangles = _torus(robot.chain.axes[k], _RING * reach, _TUBE * reach)
        rings.append(
            scene.add_mesh_simple(
                f"{path}/load", vertices, triangles, color=_GOOD, cast_shadow=False, receive_shadow=False
            )
        )
    return rings


def _torus(axis: np.ndarray, radius: float, tube: float) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (v, 3) and triangles (f, 3) of a ring around an axis through the origin."""
    around, across = 40, 10
    u, v = np.meshgrid(
        np.linspace(0, 2 * np.pi, around, endpoint=False),
        np.linspace(0, 2 * np.pi, across, endpoint=False),
        indexing="ij",
    )
    flat = np.linalg.svd(axis[None])[2][1:]  # two directions square to the axis
    out = np.cos(u)[..., None] * flat[0] + np.sin(u)[..., None] * flat[1]
    vertices = out * (radius + tube * np.cos(v))[..., None] + np.sin(v)[..., None] * tube * axis
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    here, right = i * across + j, (i + 1) % around * across + j
    up, over = i * across + (j + 1) % across, (i + 1) % around * across + (j + 1) % across
    triangles = np.stack([here, right, over, here, over, up], axis=-1).reshape(-1, 3)
    if np.linalg.det(np.stack([*flat, axis])) < 0:  # outside stays outside
        triangles = triangles[:, ::-1]
    return vertices.reshape(-1, 3).astype(np.float32), triangles.astype(np.uint32)


def _load_scale(loaded: Loaded) -> np.ndarray:
    """(n,) torque error that counts as fully red [Nm]: what one in twenty samples exceeded before, and well above
    what is left after, so that a joint with nothing but noise stays green.
    """
    if not loaded.moving:
        return np.ones(loaded.robot.joint_count)
    before, after = (np.nan_to_num(r) for r in (loaded.evidence.before, loaded.evidence.after))
    noise = np.sqrt(np.mean(after**2, axis=0))
    return np.maximum(np.maximum(np.quantile(np.abs(before), 0.95, axis=0), _NOISE_IS_GREEN * noise), 1e-9)


def _load_colour(loaded: Loaded, index: int, joint: int, share: float, scale: float) -> tuple[int, int, int]:
    evidence = loaded.evidence
    before, after = evidence.before[index, joint], evidence.after[index, joint]
    off = abs(float(np.nan_to_num((1.0 - share) * before + share * after)))
    amount = min(off / scale, 1.0)
    red, green, blue = ((1.0 - amount) * _GOOD + amount * _BAD).astype(int)
    return int(red), int(green), int(blue)
