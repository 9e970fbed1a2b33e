"""The two-robot cell: arms, tracker, beam, nests, and the circles, axes and frames as they are found."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

import numpy as np
import viser

from app.geometry import Pose
from app.geometry.circle import AxisFit
from app.kinematics.shapes import ball, box, rod
from app.scene.arm import ArmView, draw_shapes
from app.simulation.held import pointer_shapes
from app.simulation.tracker_cell import TrackerCell
from app.simulation.tracker_meeting import pointer
from app.texts import text
from app.units import from_mm

ROOT = "/base"
_BEAM, _BROKEN = (235, 30, 40), (150, 150, 160)
_AXIS = {1: (28, 126, 214), 2: (240, 140, 0)}
_PERPENDICULAR = (190, 60, 200)
_DARK, _STEEL, _RED, _BLUE = (0.16, 0.17, 0.19), (0.74, 0.76, 0.79), (0.8, 0.12, 0.12), (0.2, 0.3, 0.42)


class CellDrawing:
    """One cell in one browser's scene.

    Args:
        scene: the browser's.
        cell: what to draw; its truth is only used to place the bodies.
    """

    def __init__(self, scene: viser.SceneApi, cell: TrackerCell, t: Callable[..., str] = text):
        self._scene, self.cell = scene, cell
        self._root = scene.add_frame(ROOT, show_axes=False)
        self.arms: list[ArmView] = []
        for k, arm in enumerate(cell.arms, 1):
            self._place(f"{ROOT}/robot{k}", arm.T_world_base)
            view = ArmView(scene, arm.robot, root=f"{ROOT}/robot{k}/arm", tool=False)
            self.arms.append(view)
            draw_shapes(scene, f"{view.flange_path}/pointer", pointer_shapes(Pose.of(position=pointer(arm))))
            view.set(arm.rest)
            foot = arm.T_world_base.position
            if foot[2] > from_mm(30.0):
                block = box(
                    (0.26, 0.26, float(foot[2])),
                    (foot[0], foot[1], float(foot[2]) / 2),
                    colour=_BLUE,
                    link="foot",
                )
                draw_shapes(scene, f"{ROOT}/foot{k}", (block,))
            nest = (
                rod(
                    np.array([0.0, 0.0, arm.reflector[2]]),
                    arm.reflector,
                    from_mm(7.0),
                    colour=_DARK,
                    link="bar",
                ),
                ball(arm.reflector, from_mm(26.0), colour=_STEEL, link="reflector"),
            )
            draw_shapes(scene, f"{view.flange_path}/nest", nest)
            scene.add_label(
                f"{ROOT}/robot{k}/name",
                t("base.robot_number", number=k),
                position=(0.0, -0.16, -0.1),
                anchor="top-center",
            )
        floor = tuple(ball(p, from_mm(30.0), colour=_RED, link="nest") for p in cell.nests)
        stands = tuple(
            rod(np.array([p[0], p[1], 0.0]), p, from_mm(8.0), colour=_STEEL, link="stand") for p in cell.nests
        )
        draw_shapes(scene, f"{ROOT}/nests", floor + stands)
        for number, p in enumerate(cell.nests, 1):
            scene.add_label(
                f"{ROOT}/nest{number}", f"N{number}", position=tuple(p + np.array([0.0, 0.0, 0.05]))
            )
        self._tracker = draw_shapes(scene, f"{ROOT}/tracker", _tracker_shapes(cell))
        self.stand(cell.tracker.T_world_tracker)
        scene.add_label(f"{ROOT}/tracker/name", t("base.tracker_label"), position=(0.0, 0.0, 0.32))
        self._found: dict[str, viser.SceneNodeHandle] = {}  # by name: one drawn again replaces the one before
        self._beam: viser.SceneNodeHandle | None = None

    def _place(self, name: str, pose: Pose) -> None:
        self._scene.add_frame(
            name, show_axes=False, wxyz=tuple(pose.quaternion), position=tuple(pose.position)
        )

    def stand(self, T_world_tracker: Pose) -> None:
        """The tracker stands here."""
        self._tracker.position = tuple(T_world_tracker.position)
        self._tracker.wxyz = tuple(T_world_tracker.quaternion)

    def beam(self, end: np.ndarray | None, seen: bool = True) -> None:
        """The beam to a point in the world, red where it comes back; None switches it off."""
        if self._beam is not None:
            self._beam.remove()
            self._beam = None
        if end is not None:
            start = self.cell.tracker.T_world_tracker.position
            self._beam = self._lines(
                "beam", [(start, end)], _BEAM if seen else _BROKEN, from_mm(9.0), keep=False
            )

    def points(self, key: str, points: np.ndarray, axis: int) -> None:
        """Measured points (n, 3) in the world."""
        colours = np.tile(np.array(_AXIS.get(axis, (230, 230, 230)), np.uint8), (len(points), 1))
        handle = self._scene.add_point_cloud(
            f"{ROOT}/points/{key}",
            points.astype(np.float32),
            colours,
            point_size=from_mm(24.0),
            point_shape="circle",
        )
        self._found[handle.name] = handle

    def circle(self, key: str, fit: AxisFit, axis: int, T_world_tracker: Pose, length: float) -> None:
        """A fitted circle and its axis."""
        t = np.linspace(0.0, 2.0 * np.pi, 73)
        ring = fit.centres[0] + fit.radii[0] * (
            np.cos(t)[:, None] * fit.basis[0] + np.sin(t)[:, None] * fit.basis[1]
        )
        ring = T_world_tracker.apply(ring)
        colour = _AXIS[axis]
        self._lines(f"circle/{key}", list(itertools.pairwise(ring)), colour, from_mm(7.0))
        centre = T_world_tracker.apply(fit.centres[0])
        direction = T_world_tracker.rotation @ fit.direction
        ends = (centre - length * direction, centre + length * direction)
        self._lines(f"axis/{key}", [ends], colour, from_mm(12.0))

    def frame(
        self, key: str, T_world_frame: Pose, label: str, foot_2: np.ndarray | None, size: float
    ) -> None:
        """A frame that was found, with the perpendicular it rests on."""
        self._keep(
            self._scene.add_frame(
                f"{ROOT}/frame/{key}",
                axes_length=size,
                axes_radius=size * 0.035,
                wxyz=tuple(T_world_frame.quaternion),
                position=tuple(T_world_frame.position),
            )
        )
        self.label(key, label, T_world_frame.apply(np.array([0.0, 0.0, size * 1.15])))
        if foot_2 is not None:
            self._lines(
                f"perpendicular/{key}", [(T_world_frame.position, foot_2)], _PERPENDICULAR, from_mm(22.0)
            )

    def label(self, key: str, words: str, place: np.ndarray) -> None:
        """A word at a place in the world."""
        self._keep(self._scene.add_label(f"{ROOT}/label/{key}", words, position=tuple(place)))

    def _lines(
        self,
        key: str,
        segments: Sequence[tuple[np.ndarray, np.ndarray]],
        colour,
        width: float,
        keep: bool = True,
    ) -> viser.SceneNodeHandle:
        handle = self._scene.add_line_segments(
            f"{ROOT}/lines/{key}",
            points=np.array(segments, np.float32),
            colors=np.array(colour, np.uint8),
            thickness=width,
        )
        if keep:
            self._found[handle.name] = handle
        return handle

    def _keep(self, handle: viser.SceneNodeHandle) -> None:
        self._found[handle.name] = handle

    def clear(self) -> None:
        """Takes everything found away; the cell stays."""
        self.beam(None)
        for handle in self._found.values():
            handle.remove()
        self._found = {}

    def remove(self) -> None:
        """Takes the whole cell away."""
        self.clear()
        self._root.remove()


def _tracker_shapes(cell: TrackerCell):
    """A head on a tripod; the beam leaves from the origin."""
    height = float(cell.tracker.T_world_tracker.position[2])
    shapes = [
        ball((0.0, 0.0, 0.0), from_mm(85.0), colour=_DARK, link="head"),
        box((0.06, 0.24, 0.26), (0.0, 0.0, -0.02), colour=_RED, link="yoke"),
        rod(
            np.array([0.0, 0.0, -0.34]), np.array([0.0, 0.0, -0.14]), from_mm(80.0), colour=_BLUE, link="body"
        ),
        rod(
            np.array([0.0, 0.0, -height + 0.25]),
            np.array([0.0, 0.0, -0.34]),
            from_mm(40.0),
            colour=_STEEL,
            link="post",
        ),
    ]
    for k in range(3):
        a = 2.0 * np.pi * k / 3
        foot = np.array([0.42 * np.cos(a), 0.42 * np.sin(a), -height])
        shapes.append(rod(np.array([0.0, 0.0, -0.55]), foot, from_mm(20.0), colour=_DARK, link="leg"))
    return tuple(shapes)
