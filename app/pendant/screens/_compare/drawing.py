"""What the Compare screen draws in the cell: arm, ghost, arrows, loads as colours, proposed poses."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import viser

from app.kinematics import RobotModel
from app.pendant.arm import ArmView
from app.pendant.screens._compare.ghost import joints_for_point
from app.pendant.screens._compare.loaded import Loaded
from app.units import from_mm, mm

ROOT = "/compare"
_BEFORE, _AFTER = np.array([217, 123, 22]), np.array([24, 102, 173])
_THIS = np.array([214, 40, 57])
_GOOD, _BAD = np.array([47, 158, 68]), np.array([224, 49, 49])
_MOST_ARROWS = 400
_SHAFT, _HEAD, _HEAD_LENGTH = from_mm(2.0), from_mm(5.5), from_mm(15.0)
_FROM, _FAR = np.array([1.0, -0.8, 0.55]), 2.3  # the eye's direction, and its distance in radii
_BALL = 0.075  # radius of a joint's load, as a share of the reach


class Drawing:
    """Everything of one loaded recording, under one node.

    Args:
        scene: the browser's scene.
        loaded: what is shown.
    """

    def __init__(self, scene: viser.SceneApi, loaded: Loaded):
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
        self._arrows: viser.ArrowsHandle | None = None
        self._label: viser.LabelHandle | None = None
        self._balls = _balls(scene, self._arm, loaded.robot) if loaded.moving else []
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
        for k, ball in enumerate(self._balls):
            ball.color = _load_colour(loaded, index, k, share, self._load_scale[k])
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


def look_at(camera: viser.CameraHandle, loaded: Loaded) -> None:
    """Turns the browser's eye so that the arm and every recorded point are seen."""
    reach = float(loaded.robot.description.get("reach_m", loaded.robot.reach))
    around = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.6 * reach]])
    points = loaded.points
    if points is not None and np.isfinite(points).any():
        around = np.concatenate([around, points[np.isfinite(points).all(1)]])
    low, high = around.min(0), around.max(0)
    centre = (low + high) / 2.0
    far = _FAR * max(float(np.linalg.norm(high - low)) / 2.0, reach / 2.0)
    camera.position = tuple(centre + far * _FROM / np.linalg.norm(_FROM))
    camera.look_at = tuple(centre)


def _pointer(scene: viser.SceneApi, flange: str, tip: np.ndarray, colour: np.ndarray) -> None:
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


def _balls(scene: viser.SceneApi, arm: ArmView, robot: RobotModel) -> list:
    """A ball on every joint of the arm, coloured by its residual."""
    paths, path = [], f"{ROOT}/arm"
    for k in range(robot.joint_count):
        path = f"{path}/joint{k + 1}"
        paths.append(path)
    radius = _BALL * float(robot.description.get("reach_m", robot.reach))
    return [
        scene.add_icosphere(f"{p}/load", radius=radius, opacity=0.75, subdivisions=2, cast_shadow=False)
        for p in paths
    ]


def _load_scale(loaded: Loaded) -> np.ndarray:
    """(n,) torque error that counts as fully red: what one in twenty samples exceeded before [Nm]."""
    before = np.abs(np.nan_to_num(loaded.evidence.before))
    if not loaded.moving:
        return np.ones(loaded.robot.joint_count)
    return np.maximum(np.quantile(before, 0.95, axis=0), 1e-9)


def _load_colour(loaded: Loaded, index: int, joint: int, share: float, scale: float) -> tuple[int, int, int]:
    evidence = loaded.evidence
    before, after = evidence.before[index, joint], evidence.after[index, joint]
    off = abs(float(np.nan_to_num((1.0 - share) * before + share * after)))
    amount = min(off / scale, 1.0)
    red, green, blue = ((1.0 - amount) * _GOOD + amount * _BAD).astype(int)
    return int(red), int(green), int(blue)
