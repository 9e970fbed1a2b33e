"""The frame's figures, as the page receives them: typed, and always those of the arm that is seen."""

from __future__ import annotations

import msgspec
import numpy as np

from app.geometry import CONVENTIONS, Pose
from app.kinematics import RobotModel
from app.screens._tool.words import Words
from app.screens._training import headline
from app.screens.context import Context
from app.session.motion.drive import How
from app.session.motion.user_frame import user_frame
from app.units import deg, mm
from app.workers.axes import pairs
from app.workers.hinted import Hinted


class Axis(msgspec.Struct, frozen=True):
    """One pair of jog buttons with its live value.

    Args:
        axis: number in its frame, from 0.
        name: what the operator calls it.
        value: as shown, with its unit.
        number: the same as a number; low, high: its limits, where it has some (joints).
    """

    axis: int
    name: str
    value: str
    number: float
    low: float | None = None
    high: float | None = None


class Read(msgspec.Struct, frozen=True, tag_field="t", tag="read"):
    """Everything on the page's frame.

    Args:
        how: `standing`, `moving`, `waiting` for the switch, `measuring` without it, `stopped`.
        enabled, tripped: the enabling switch is held; it fell silent and has to be let go.
        errand: what a motion that waits or runs is for.
        frame, increment, override: how it is jogged.
        robot, tool, base: names of what is active.
        axes: pairs of the chosen frame.
        pose: (name, value) of position and angles of the tool point, or of the flange.
        of: whose position that is, in words.
        touch: tip and spike in words; touching: they meet.
        hit: names of two bodies that are as near as the guard lets them come.
        points: recorded and all.
        task, clock: name and time of the exercise that is being done; empty for none.
        level, message: what was said last; said: its number.
        screen: a screen that wants to be opened.
        own: False while another arm than the session's own is seen.
        handle: there is a drag handle.
        hint, hinted: number and words of the trainer's hint that was not put away yet; 0 and empty for none.
        hints: how many wait, that one among them.
        watched: a trainer looks on.
    """

    how: How
    state: str
    enabled: bool
    tripped: bool
    errand: str
    frame: str
    increment: str
    override: int
    robot: str
    tool: str
    base: str
    axes: tuple[Axis, ...]
    pose: tuple[tuple[str, str], ...]
    of: str
    touch: str
    touching: bool
    points: str
    level: str
    message: str
    said: int
    screen: str
    own: bool
    handle: bool
    hint: int = 0
    hinted: str = ""
    hints: int = 0
    watched: bool = False
    task: str = ""
    clock: str = ""


def read(context: Context, hints: Hinted) -> Read:
    """The figures now; from any thread."""
    hint = hints.first
    drive, t, state = context.drive, context.t, context.session.state
    seen = context.seen
    robot, q = (drive.model, drive.q) if seen is None else seen()
    own = seen is None
    flange = drive.world.shown_flange(q) if own else robot.forward(q)
    tool = state.tool if own else None
    pose = flange @ tool.T_flange_tool if tool is not None else flange
    distance = context.world.distance(q) if own else float("inf")
    touching = context.aids.light and distance <= context.world.contact_distance
    if not own or not context.aids.light:
        touch = ""
    elif touching:
        touch = t("status.touching")
    else:
        near = context.aids.distance
        touch = f"{mm(distance):.1f} mm" if near else t("status.free")
    log = context.log[-1:] or [(0.0, "info", t("message.welcome"))]
    frame = context.jogging.frame
    return Read(
        how=drive.how,
        state=t(f"status.{drive.how}"),
        enabled=drive.live,
        tripped=drive.enabling.tripped,
        errand=drive.errand,
        frame=frame,
        increment=context.jogging.increment,
        override=round(100 * drive.override),
        robot=robot.said("title", context.language),
        tool=tool.name if tool is not None else t("status.bare"),
        base=t("status.user_base") if frame == "user" else t("status.world"),
        axes=_axes(context, robot, q, pose, frame if own else "joint"),
        pose=_pose(context, pose),
        # Why its keys are grey is said where they are.
        of=("" if own else t("move.not_jogged")) + t("move.position" if tool is not None else "move.flange"),
        touch=touch,
        touching=touching,
        # The wizard's, which is for the own arm.
        points=t("status.points", done=len(state.steps) - len(state.missing), all=len(state.steps))
        if own
        else "",
        level=log[0][1],
        message=log[0][2],
        said=len(context.log) and hash(log[0]) & 0x7FFFFFFF,
        screen=context.wanted_screen,
        own=own,
        handle=context.aids.handle,
        hint=hint.id if hint is not None else 0,
        hinted=hint.text if hint is not None else "",
        hints=hints.count,
        watched=hints.watched,
        task=headline.title(context, state.running) if state.running is not None else "",
        clock=headline.clock(state.running) if state.running is not None else "",
    )


def _axes(context: Context, robot: RobotModel, q: np.ndarray, pose: Pose, frame: str) -> tuple[Axis, ...]:
    names = pairs(frame, robot.joint_count, context.vocabulary)
    if frame == "joint":
        return tuple(_joint(robot, k, name, float(q[k])) for k, name in names)
    if frame == "user":
        pose = user_frame(context.session.state, context.world).inverse() @ pose
    place, turned = mm(pose.position), _turned(pose)
    return tuple(
        Axis(k, name, f"{place[k]:.1f} mm", float(place[k]))
        if k < 3
        else Axis(k, name, f"{turned[k - 3]:.2f}°", float(turned[k - 3]))
        for k, name in names
    )


def _turned(pose: Pose) -> np.ndarray:
    """(3,) degrees about X, Y, Z, of the rotation written as Rz Ry Rx."""
    c, b, a = deg(CONVENTIONS["ZYX"].from_rotation(pose.rotation))
    return np.array([a, b, c])


def _joint(robot: RobotModel, k: int, name: str, value: float) -> Axis:
    joint = robot.joints[k]
    to_screen, unit, digits = (mm, " mm", 1) if joint.prismatic else (deg, "°", 2)
    shown = float(to_screen(value))
    return Axis(
        k,
        name,
        f"{shown:.{digits}f}{unit}",
        shown,
        float(to_screen(joint.lower)),
        float(to_screen(joint.upper)),
    )


def _pose(context: Context, pose: Pose) -> tuple[tuple[str, str], ...]:
    form, words = CONVENTIONS[context.convention], Words(context)
    numbers = form.from_rotation(pose.rotation)
    if not form.angular:
        shown = [f"{v:.5f}" for v in numbers]
    elif words.radians(form.key):
        shown = [f"{v:.4f} rad" for v in numbers]
    else:
        shown = [f"{v:.2f}°" for v in deg(numbers)]
    lengths = [(axis, f"{v:.2f}") for axis, v in zip("XYZ", mm(pose.position), strict=True)]
    return (*lengths, *zip(words.angles(form.key), shown, strict=True))
