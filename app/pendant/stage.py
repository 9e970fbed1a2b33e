"""Everything drawn in the cell of one browser."""

from __future__ import annotations

import itertools

import numpy as np
import viser

from app.calibration.verify import Verification
from app.geometry import Pose
from app.pendant.arm import ArmView
from app.pendant.scene.camera import FOLLOWING, MORE_VIEWS, VIEWS, look
from app.pendant.scene.cell import draw_cell
from app.pendant.scene.ground import lay_floor, light_up
from app.pendant.scene.handle import Dragged, Handle
from app.pendant.scene.held_tool import HeldTool
from app.pendant.scene.marks import Marks
from app.pendant.scene.next_arm import NextArm
from app.pendant.scene.region import Region
from app.pendant.scene.residuals import Residuals
from app.pendant.scene.tool_axes import ToolAxes
from app.pendant.scene.trace import Trace
from app.pendant.scene.user_axes import UserAxes
from app.session import SessionState
from app.session.state import accepted
from app.simulation.world import World
from app.units import from_mm

_NUMBERS = itertools.count(1)
_FOLLOW = from_mm(2.0)  # the tip moves this far before a near view moves with it
_HANDLE = 0.13  # size of the handle, as a share of the reach


class Stage:
    """Arm, tool, cell, handle and marks.

    Args:
        client: the browser.
        world: the cell.
        dragged: what a drag at the handle calls, on the event loop.
        dark: dark page or light.
        handle: whether there is a drag handle at all.
    """

    def __init__(
        self, client: viser.ClientHandle, world: World, dragged: Dragged, *, dark: bool, handle: bool = True
    ):
        self._client, self._scene = client, client.scene
        self._world = world
        light_up(self._scene)
        self.floor(dark)
        # A name of its own each time: the page keeps the pose of a removed node for the next one of that name.
        self.arm = ArmView(self._scene, world.robot, root=f"/arm{next(_NUMBERS)}", tool=False)
        self._held: HeldTool | None = None
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
        self.handle.visible = handle
        self._drawn: tuple[object, ...] = ()
        self._away = self._tracing = False
        self._tip, self._eye = world.hand(world.robot.home).position, np.zeros(3)
        self._followed: np.ndarray | None = None
        self.view("whole")

    def floor(self, dark: bool) -> None:
        """The floor for a dark or a light page."""
        lay_floor(self._scene, dark=dark)

    def cell(self, world: World) -> None:
        """Table, spike and tool of another cell of the same arm."""
        before, self._world = self._world, world
        stands = before.p_base_spike_drawn, before.table_height
        if self._held is None or not (
            np.array_equal(stands[0], world.p_base_spike_drawn) and stands[1] == world.table_height
        ):
            self._cell = draw_cell(self._scene, world)
        if self._held is None or before.picture is not world.picture:
            if self._held is not None:
                self._held.remove()
            self._held = HeldTool(self._scene, self.arm.flange_path, world)

    def make_room(self, away: bool) -> None:
        """Hides arm, handle and cell while something else is shown in their place; False brings them back."""
        self._away = away
        self.arm.visible = self._cell.visible = not away
        self.handle.visible = not away and self.show_handle
        self.next_arm.away(away)

    def show_trace(self, found: Verification | None, state: SessionState, until: int | None = None) -> None:
        """The trace of a turn about the tool point, in the place of handle, axes and region; None brings them back."""
        self.trace.show(found, until)
        if self._tracing != (found is not None):
            self._tracing = found is not None
            self._drawn = ()
            self.refresh(state)

    def view(self, name: str) -> None:
        """Looks from one of the named places; a near one goes along with the tip."""
        eye, centre = {**VIEWS, **MORE_VIEWS}[name](self._world)
        self._followed = None
        if name in FOLLOWING:
            eye, centre = eye + self._tip - centre, self._tip
            self._followed = self._tip
        self._eye = eye - centre
        look(self._client.camera, (eye, centre))

    def follow(self) -> None:
        """The near views keep the tip in their middle."""
        if self._followed is not None and np.linalg.norm(self._tip - self._followed) > _FOLLOW:
            self._followed = self._tip
            look(self._client.camera, (self._tip + self._eye, self._tip))

    def pose(self, q: np.ndarray, world: World, hand: Pose) -> None:
        """The arm at q (n,), the handle where the controller reckons the tool, T_base_tool."""
        self.arm.set(q)
        if self._held is not None:
            self._held.pose(q, world)
        self._tip = hand.position
        self.handle.place(hand)
        self.next_arm.arm_at(q)

    def refresh(self, state: SessionState) -> None:
        """Marks, residuals and axes, where they changed."""
        result = state.result.result if state.result else None
        wanted = (state.captures, result, state.tool, self.show_handle, self.show_marks, self.show_residuals)
        if len(self._drawn) == len(wanted) and all(a is b for a, b in zip(self._drawn, wanted, strict=True)):
            return
        self._drawn = wanted
        self.marks.show(state.ordered if self.show_marks and not self._tracing else ())
        # A result that waits for its decision is looked at, not moved: the handle would hide the arrows.
        free = not self._away and not self._tracing
        self.handle.visible = free and self.show_handle and (result is None or accepted(state))
        self.residuals.show(result if self.show_residuals and not accepted(state) else None)
        self.region.show(result if self.show_residuals and not self._tracing else None)
        tool = (
            result.T_flange_tool if result is not None else state.tool.T_flange_tool if state.tool else None
        )
        self.axes.show(None if self._tracing else tool)
