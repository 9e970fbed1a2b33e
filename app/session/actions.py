"""Everything that can be done in a session, as data. SI units; joint positions as tuples [rad or m].

An action holds all it needs: a file that was loaded stands in it with its points, so that a journal can be
replayed where the file no longer is.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from app.diagnosis.model import SavedModel


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
    """The arm stands at `q`: written when a motion ends, not while it lasts. In an exercise the way there is kept too,
    as joint positions a tenth of a second apart."""

    q: tuple[float, ...]
    path: tuple[tuple[float, ...], ...] = ()


class SetUserFrame(Action, frozen=True, tag="user_frame"):
    """The user frame that is jogged in, T_base_user: a place [m] and a quaternion wxyz; None: the table's corner."""

    place: tuple[float, float, float] | None = None
    quaternion: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)


class Record(Action, frozen=True, tag="record"):
    """Records the flange pose of `q` (None: where the arm stands) for a step that has none yet; `back`: a stroke that
    was made along the axis' negative sense, away from the spike."""

    step: str
    q: tuple[float, ...] | None = None
    back: bool = False


class ReRecord(Action, frozen=True, tag="re_record"):
    """Records a step again that was recorded before."""

    step: str
    q: tuple[float, ...] | None = None
    back: bool = False


class Delete(Action, frozen=True, tag="delete"):
    """Takes a recorded point away."""

    step: str


class Comment(Action, frozen=True, tag="comment"):
    """A note at a recorded point."""

    step: str
    text: str


class Enter(Action, frozen=True, tag="enter"):
    """A tool frame typed in, for the mode `direct`: a place [m], and angles [rad] or a quaternion in a convention."""

    position: tuple[float, float, float]
    angles: tuple[float, ...]
    convention: str = "ZYX"


class Calculate(Action, frozen=True, tag="calculate"):
    """Computes the tool frame from the recorded points."""


class Accept(Action, frozen=True, tag="accept"):
    """Makes the result the active tool, under a name."""

    name: str = "tool 1"


class Cancel(Action, frozen=True, tag="cancel"):
    """Throws the points and the result away; the active tool stays what it was."""


class LoadPoints(Action, frozen=True, tag="load_points"):
    """Points from a file, with the mode and the estimator they are meant for.

    Args:
        source: the file's name, for the screen.
        title: what the file calls itself.
        mode: key of the wizard mode.
        method: estimator of the tool point.
        roles: one a row.
        rows: line in the file, one a row.
        columns: names of the columns with numbers, as written.
        values: the numbers in SI units, one tuple a row.
        steps: step of the last written digit of each column, SI units; 0 where exact.
        angles: key of the angle convention; empty where `values` are joint positions.
        robot: the arm whose joints stand in the file; empty where there are flange poses alone.
        joints: joint positions beside the flange poses, one tuple a row; () where only one of the two stands there.
        references: tool points [m] the file states, by name.
        note: what the file remarks about itself.
    """

    source: str
    title: str
    mode: str
    method: str
    roles: tuple[str, ...]
    rows: tuple[int, ...]
    columns: tuple[str, ...]
    values: tuple[tuple[float, ...], ...]
    steps: tuple[float, ...]
    angles: str = ""
    robot: str = ""
    references: dict[str, tuple[float, float, float]] = {}
    note: str = ""
    joints: tuple[tuple[float, ...], ...] = ()


class UseModel(Action, frozen=True, tag="use_model"):
    """The arm in the practice cell is as wrong as a saved model says; None: as described."""

    model: SavedModel | None = None


class Undo(Action, frozen=True, tag="undo"):
    """Takes back the last thing that changed points, mode, result or tool; the arm stays where it is."""


class Redo(Action, frozen=True, tag="redo"):
    """Does again what was taken back last."""


class Begin(Action, frozen=True, tag="begin"):
    """An exercise begins: its arm, its wizard, nothing recorded.

    Args:
        exercise: its key.
        seed: draws what is hidden; it never leaves the server before the end.
        at: when [s since 1970].
        robot: the arm.
        mode, touches: the wizard.
        tools: tools the controller has, the last one active: name, and T_flange_tool row by row [m].
        tracker: the two-robot procedure instead of the tool wizard; with fixed points or without.
        trainee: who does it; empty where nobody gave a name.
        lesson: the exercise's own file, where it is none of the shipped ones: the journal then needs nothing else.
        without: helps its class does not allow, beyond those the exercise itself leaves out.
    """

    exercise: str
    seed: int
    at: float
    robot: str
    mode: str
    touches: int | None = None
    tools: tuple[tuple[str, tuple[float, ...]], ...] = ()
    tracker: Literal["", "nests", "bare"] = ""
    trainee: str = ""
    lesson: str = ""
    without: tuple[str, ...] = ()


class OpenCell(Action, frozen=True, tag="open_cell"):
    """A cell of two robots and a laser tracker is set up.

    Args:
        first, second: names of the robots.
        seed: draws where exactly everything stands.
        nests: fixed points on the floor are part of the procedure.
        pushed: somebody pushes the tracker before robot 2, and tells nobody.
    """

    first: str
    second: str
    seed: int
    nests: bool = True
    pushed: bool = False


class CloseCell(Action, frozen=True, tag="close_cell"):
    """The cell of two robots is taken down with all that was measured in it."""


class Tracked(Action, frozen=True, tag="tracked"):
    """The laser tracker measured a point [m] for the step at hand of the two-robot procedure."""

    point: tuple[float, float, float]
    angle: float = 0.0
    name: str = ""
    sigma: float = 0.0


class TrackerNext(Action, frozen=True, tag="tracker_next"):
    """On to the procedure's next step."""


class TrackerUndo(Action, frozen=True, tag="tracker_undo"):
    """Takes the last measured point back."""


class HangLoad(Action, frozen=True, tag="hang_load"):
    """A load the controller does not know hangs on the flange, drawn by the seed; poses of another are put away."""

    seed: int


class WeighAt(Action, frozen=True, tag="weigh_at"):
    """A pose of the weighing run: its number, from 0, and joint positions; `q` None takes the pose away."""

    number: int
    q: tuple[float, ...] | None = None


class Weighed(Action, frozen=True, tag="weighed"):
    """What the run found: a mass [kg] and its centre in the flange [m], with the half widths of their 95% intervals."""

    mass: float
    centre: tuple[float, float, float]
    mass_half: float
    centre_half: tuple[float, float, float]


class Finish(Action, frozen=True, tag="finish"):
    """The exercise ends.

    Args:
        answer: what the trainee says is wrong; empty where nothing was asked.
        number: of the touch or the joint it is about; 0 where none was named.
        given_up: nothing is scored.
    """

    answer: str = ""
    number: int = 0
    given_up: bool = False


AnyAction = (
    ChooseRobot
    | ChooseMode
    | ChooseMethod
    | Move
    | SetUserFrame
    | Record
    | ReRecord
    | Delete
    | Comment
    | Enter
    | Calculate
    | Accept
    | Cancel
    | LoadPoints
    | UseModel
    | Undo
    | Redo
    | Begin
    | OpenCell
    | CloseCell
    | Tracked
    | TrackerNext
    | TrackerUndo
    | HangLoad
    | WeighAt
    | Weighed
    | Finish
)
