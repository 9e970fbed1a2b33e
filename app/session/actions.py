"""Everything that can be done in a session, as data. SI units; joint positions as tuples [rad or m].

An action holds all it needs: a file that was loaded stands in it with its points, so that a journal can be
replayed where the file no longer is.
"""

from __future__ import annotations

import msgspec


class Action(msgspec.Struct, frozen=True, tag_field="do", forbid_unknown_fields=True, omit_defaults=True):
    """The root of all actions."""


class ChooseRobot(Action, frozen=True, tag="choose_robot"):
    """Another arm: everything recorded with the one before is put away."""

    robot: str


class ChooseMode(Action, frozen=True, tag="choose_mode"):
    """A wizard mode and how many touches it takes (None: the mode's own number). Recorded points are kept
    where the new list has a step of the same name and role."""

    mode: str
    touches: int | None = None


class ChooseMethod(Action, frozen=True, tag="choose_method"):
    """The estimator of the tool point: `joint` or `pairwise`."""

    method: str


class Move(Action, frozen=True, tag="move"):
    """The arm stands at `q`: written when a motion ends, not while it lasts."""

    q: tuple[float, ...]


class Record(Action, frozen=True, tag="record"):
    """Records the flange pose of `q` (None: where the arm stands) for a step that has none yet."""

    step: str
    q: tuple[float, ...] | None = None


class ReRecord(Action, frozen=True, tag="re_record"):
    """Records a step again that was recorded before."""

    step: str
    q: tuple[float, ...] | None = None


class Delete(Action, frozen=True, tag="delete"):
    """Takes a recorded point away."""

    step: str


class Comment(Action, frozen=True, tag="comment"):
    """A note at a recorded point."""

    step: str
    text: str


class Calculate(Action, frozen=True, tag="calculate"):
    """Computes the tool frame from the recorded points."""


class Accept(Action, frozen=True, tag="accept"):
    """Makes the result the active tool, under a name."""

    name: str = "tool 1"


class Cancel(Action, frozen=True, tag="cancel"):
    """Throws the points and the result away; the active tool stays what it was."""


class LoadedPoint(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """One row of a points file: its role, the flange in base as 3 x 4 rows [m], joints where the file has them."""

    role: str
    T_base_flange: tuple[tuple[float, float, float, float], ...]
    q: tuple[float, ...] | None = None
    row: int = 0


class LoadPoints(Action, frozen=True, tag="load_points"):
    """Points from a file, with the mode and the estimator they are meant for.

    Args:
        source: the file's name, for the screen.
        mode: key of the wizard mode.
        method: `joint` or `pairwise`.
        points: the rows.
        rounding: half the last digit of positions [m] and angles [rad] as printed, 0 where exact.
        angles: key of the angle convention the file was written in.
    """

    source: str
    mode: str
    method: str
    points: tuple[LoadedPoint, ...]
    rounding: tuple[float, float] = (0.0, 0.0)
    angles: str = "ZYX"


class Undo(Action, frozen=True, tag="undo"):
    """Takes back the last thing that changed points, mode, result or tool; the arm stays where it is."""


class Redo(Action, frozen=True, tag="redo"):
    """Does again what was taken back last."""


AnyAction = (
    ChooseRobot
    | ChooseMode
    | ChooseMethod
    | Move
    | Record
    | ReRecord
    | Delete
    | Comment
    | Calculate
    | Accept
    | Cancel
    | LoadPoints
    | Undo
    | Redo
)
