"""Everything drawn in the cell of one session."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Sequence

import numpy as np

from app.calibration.captures import Capture
from app.calibration.result import ToolCalibration
from app.calibration.verify import Verification
from app.geometry import Pose
from app.scene.arm import ArmView
from app.scene.camera import CLOSE_UPS, FOLLOWING, MORE_VIEWS, VIEWS, framed, look, look_straight
from app.scene.captions import (
    Caption,
    Captions,
    boxes,
    column,
    fitting,
    of_axes,
    of_points,
    of_result,
    room_beside,
)
from app.scene.cell import draw_cell
from app.scene.eyes import Eyes
from app.scene.ground import lay_floor, light_up
from app.scene.handle import Dragged, Handle
from app.scene.held_tool import HeldTool
from app.scene.instead import Instead
from app.scene.marks import Marks
from app.scene.met import How, Met
from app.scene.next_arm import NextArm
from app.scene.region import Region
from app.scene.residuals import Residuals
from app.scene.server import SceneServer
from app.scene.tool_axes import ToolAxes
from app.scene.trace import Trace
from app.scene.user_axes import UserAxes
from app.session import SessionState
from app.session.state import accepted
from app.simulation.world import World
from app.units import from_mm

_NUMBERS = itertools.count(1)
_FOLLOW = from_mm(2.0)  # the tip moves this far before a near view moves with it
_HANDLE_EVERY = 0.1  # seconds between two places of the handle while the arm moves
_BODY = 0.13  # half the width of an arm about its joints, as a share of the reach
_LAID_OUT = 6  # passes in which words and what frames them find each other
_HANDLE = 0.13  # size of the handle, as a share of the reach


class Stage:
    """Arm, tool, cell, handle and marks.

    Args:
        server: of the session's scene.
        world: the cell.
        dragged: what a drag at the handle calls, on the event loop.
        dark: dark page or light.
        handle: whether there is a drag handle at all.
    """

    def __init__(
        self, server: SceneServer, world: World, dragged: Dragged, *, dark: bool, handle: bool = True
    ):
        self.scene = self._scene = server.scene
        self._server, self.eyes = server, Eyes(server)
        self._world = world
        light_up(self._scene)
        self.floor(dark)
        # A name of its own each time: the page keeps the pose of a removed node for the next one of that name.
        self.arm = ArmView(self._scene, world.robot, root=f"/arm{next(_NUMBERS)}", tool=False)
        self._held: HeldTool | None = None
        self.met = Met(self._scene, self.arm)
        self.cell(world)
        reach = float(world.robot.description.get("reach_m", world.robot.reach))
        self.handle = Handle(self._scene, dragged, _HANDLE * reach)
        self.marks = Marks(self._scene)
        self.residuals = Residuals(self._scene)
        self.axes = ToolAxes(self._scene, self.arm.flange_path)
        self.region = Region(self._scene, self.arm.flange_path)
        self.trace = Trace(self._scene)
        self.user = UserAxes(self._scene)
        self.next_arm = NextArm(self._scene, world.robot)
        self.show_handle, self.show_marks, self.show_residuals = handle, True, True
        self._near = self._looked_at = self._tracing = False
        self._instead: Callable[[], Instead] | None = None
        self._reach = reach
        self._numbers, self._words = Captions(self._scene), Captions(self._scene)
        self._said: list[Caption] = []  # of the result, and the recorded points that are numbered
        self._numbered: Sequence[Capture] = ()
        self._words_at = np.zeros(3)  # where the tip of the result is
        self._drawn: tuple[object, ...] = ()
        self._hand = world.hand(world.robot.home)
        self._shown: Pose | None = None  # where the handle was put last, and when
        self._placed = -np.inf
        self._tip, self._eye = self._hand.position, np.zeros(3)
        self._followed: np.ndarray | None = None
        self.view("whole")
        server.sized = self._sized

    def _sized(self) -> None:
        """A page is there: what was framed for a window nobody had seen yet is framed for this one."""
        if self._guessed:
            self.view(self._seen_from)

    def floor(self, dark: bool) -> None:
        """Floor and background for a dark or a light page."""
        self._server.gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
        lay_floor(self._scene, dark=dark)

    def cell(self, world: World) -> None:
        """Table, spike and tool of another cell of the same arm."""
        before, self._world = self._world, world
        self.met.show(before, self._held, None)
        stands = before.p_base_spike_drawn, before.table_height
        if self._held is None or not (
            np.array_equal(stands[0], world.p_base_spike_drawn) and stands[1] == world.table_height
        ):
            self._cell = draw_cell(self._scene, world)
        if self._held is None or before.picture is not world.picture:
            if self._held is not None:
                self._held.remove()
            self._held = HeldTool(self._scene, self.arm.flange_path, world)

    @property
    def _away(self) -> bool:
        return self._instead is not None

    def make_room(self, instead: Callable[[], Instead] | None) -> None:
        """Hides arm, handle and cell while something else is shown in their place, which the named views look at then.

        Args:
            instead: what that is now; None brings the cell back.
        """
        self._instead, away = instead, instead is not None
        self.arm.visible = self._cell.visible = not away
        self._place_handle()
        self.next_arm.away(away)
        if away:
            self.met.show(self._world, self._held, None)

    def show_trace(self, found: Verification | None, state: SessionState, until: int | None = None) -> None:
        """The trace of a turn about the tool point, in the place of handle, axes and region; None brings them back."""
        self.trace.show(found, until)
        if self._tracing != (found is not None):
            self._tracing = found is not None
            self._drawn = ()
            self.refresh(state)

    def view(self, name: str) -> None:
        """Looks from one of the named places; a near one goes along with the tip."""
        self._near = name in CLOSE_UPS
        self._seen_from, self._guessed = name, not self.eyes.known
        self._place_handle()
        if self._instead is not None:
            self._followed = None
            look_straight(self.eyes, self._instead().view(name, self.eyes.aspect))
            return
        eye, centre = {**VIEWS, **MORE_VIEWS}[name](self._world)
        self._followed = None
        if name in FOLLOWING:
            eye, centre = eye + self._tip - centre, self._tip
            self._followed = self._tip
        self._eye = eye - centre
        if name == "result":
            look_straight(self.eyes, (eye, centre))
            for _ in range(_LAID_OUT):  # the words are as large as they are seen
                # The arm stands as high as its last stroke has it, and no part of it may be cut off.
                points = self._about_result(eye - centre)
                look_straight(self.eyes, framed(points, eye - centre, self.eyes.aspect, 0.88))
        else:
            look(self.eyes, (eye, centre), nearer=name == "whole")
        self._letter()

    def _about_result(self, back: np.ndarray) -> np.ndarray:
        """(n, 3) what a look at a result has to show from where `back` (3,) points: arm, spike, words [m]."""
        right = np.cross([0.0, 0.0, 1.0], back)
        right /= np.linalg.norm(right)
        joints = self._world.robot.chain.frames(self.arm.q[None]).joint_positions[0]
        half = _BODY * self._reach
        arm = np.vstack([np.zeros(3), joints])
        bodies = [arm - half * right, arm + half * right, arm + 1.6 * half * np.array([0.0, 0.0, 1.0])]
        seen, spike = self.eyes.seen, self._world.p_base_spike_drawn
        written = room_beside(self._said, self._words_at, seen, self._reach)
        numbers = of_points(self._numbered, seen, self._reach)[1]
        return np.vstack([*bodies, self._tip, spike, written, numbers])

    def want_handle(self, *, shift: bool, turn: bool) -> None:
        """Somebody asked for the handle, with these parts: it is there in a near view, too."""
        self._near = False
        self.handle.allow(shift=shift, turn=turn)
        self._place_handle()

    def bodies(self, how: How | None, names: tuple[str, str] = ("", "")) -> None:
        """Colours two bodies that meet; None lets go of them."""
        self.met.show(self._world, self._held, None if self._away else how, names)

    def _place_handle(self) -> None:
        """The handle is where an arm can be dragged, and not where it would hide what is looked at."""
        hidden = self._away or self._tracing or self._near or self._looked_at
        self.handle.visible = self.show_handle and not hidden

    def _write(self, result: ToolCalibration | None, *, misses: bool) -> None:
        """What the drawings of a result say."""
        self._said = []
        if result is not None and len(result.residual_vectors):
            flange = self._world.robot.forward(self.arm.q).matrix
            self._said = [*of_result(result, misses=misses), *of_axes(result, flange)]
            self._words_at = result.p_base

    def _letter(self) -> None:
        """Words and numbers, laid out for what is seen now."""
        seen = self.eyes.seen
        said = fitting(self._said, seen)
        self._words.show(said, *column(said, self._words_at, seen, self._reach))
        self._numbers.show(*of_points(self._numbered, seen, self._reach, boxes(self._words, seen)))

    def window(self, size: tuple[float, float]) -> None:
        """The page's window is so wide and so high [px]."""
        if size != self._server.window:
            self._server.window = size
            self._letter()

    def follow(self) -> None:
        """The handle catches up with the arm; the near views keep the tip in their middle."""
        if self._hand is not self._shown:
            self.hold(self._hand)
        if self._followed is not None and np.linalg.norm(self._tip - self._followed) > _FOLLOW:
            self._followed = self._tip
            look(self.eyes, (self._tip + self._eye, self._tip))

    def hold(self, hand: Pose) -> None:
        """The handle is put where the controller reckons the tool, T_base_tool."""
        self._hand = self._shown = hand
        self._placed = time.monotonic()
        self.handle.place(hand)

    def pose(self, q: np.ndarray, world: World, hand: Pose) -> None:
        """The arm at q (n,), the handle where the controller reckons the tool, T_base_tool."""
        self.arm.set(q)
        if self._held is not None:
            self._held.pose(q, world)
        self._tip = hand.position
        self._hand = hand
        if time.monotonic() - self._placed >= _HANDLE_EVERY:
            self.hold(hand)
        self.next_arm.arm_at(q)

    def refresh(self, state: SessionState) -> None:
        """Marks, residuals and axes, where they changed."""
        result = state.result.result if state.result else None
        wanted = (state.captures, result, state.tool, self.show_handle, self.show_marks, self.show_residuals)
        if len(self._drawn) == len(wanted) and all(a is b for a, b in zip(self._drawn, wanted, strict=True)):
            return
        self._drawn = wanted
        shown = state.ordered if self.show_marks and not self._tracing else ()
        self.marks.show(shown)
        self._numbered = shown
        # A result that waits for its decision is looked at, not moved: the handle would hide the arrows.
        self._looked_at = result is not None and not accepted(state)
        self._place_handle()
        self.residuals.show(result if self.show_residuals and not accepted(state) else None)
        region = result if self.show_residuals and not self._tracing else None
        self.region.show(region)
        self._write(region, misses=not accepted(state))
        self._letter()
        tool = (
            result.T_flange_tool if result is not None else state.tool.T_flange_tool if state.tool else None
        )
        self.axes.show(None if self._tracing else tool)
