"""An exercise, as its file says it: one TOML file each under static/exercises."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any, Literal

import msgspec

from app import resources
from app.errors import FileFormatError, TeachframeError, UnknownNameError
from app.session.state import mode_named, robot_named

FOLDER = resources.STATIC / "exercises"
#: What can be wrong with a cell, as a trainee may answer.
ANSWERS = (
    "nothing",
    "bent_tip",
    "spike_moved",
    "joint_zero",
    "soft_gearbox",
    "wrong_tool",
    "tracker_moved",
)
LANGUAGES = ("en", "zh")


class _Part(msgspec.Struct, frozen=True):
    """The root of an exercise's parts."""


class Words(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the trainee reads: the title, the task, what it teaches."""

    title: str
    task: str
    learn: str


class Allowed(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Helps: a number for the distance, close views, the proposal of the next touch, the drag handle, a hand that
    brings the tip to the spike."""

    distance: bool = True
    closeup: bool = True
    next_touch: bool = True
    handle: bool = True
    touch: bool = True


class FaultPart(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One effect of the diagnosis' library. Values carry their unit in their name (`offset_deg`); each is drawn within
    `spread` of what stands here, of either sign where `signs` says so. `from_row: [3, 5]` is drawn too."""

    effect: str
    where: dict[str, Any] = {}
    values: dict[str, float] = {}
    fixed: dict[str, float] = {}
    spread: float = 0.1
    signs: bool = True


class Hidden(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is true and not told.

    Args:
        tool_spread_mm: the true tool point lies up to this far from the drawing's, on each axis.
        tool_turn_deg: its axes are turned by up to this.
        spike_spread_mm: the spike stands up to this far from where the description has it, on each axis.
        touch_noise_mm: one-sigma error of a touch the program makes, per axis.
        spike_moved_mm: the spike is pushed this far, in a direction that is drawn, before touch `spike_from`.
        spike_from: first and last touch it may happen before.
        active: the tool the controller has from the start: none, the right one, or that of another torch.
        wrong_by_mm: how far the other torch's point is away.
        load_kg, load_centre_mm: what the arm carries.
        faults: what is wrong with the arm or the tool's seat.
        one_of: keys of exercises, one of whose hidden parts is drawn.
        robots: the arms of a two-robot cell.
        tracker_pushed_mm, tracker_turned_deg: what happens to the tracker between the robots.
    """

    tool_spread_mm: float = 0.0
    tool_turn_deg: float = 0.0
    spike_spread_mm: float = 0.0
    touch_noise_mm: float = 0.15
    spike_moved_mm: float = 0.0
    spike_from: tuple[int, int] = (3, 4)
    active: Literal["none", "right", "wrong"] = "none"
    wrong_by_mm: float = 15.0
    load_kg: float = 0.0
    load_centre_mm: tuple[float, float, float] = (0.0, 0.0, 0.0)
    faults: tuple[FaultPart, ...] = ()
    one_of: tuple[str, ...] = ()
    robots: tuple[str, ...] = ()
    tracker_pushed_mm: float = 0.0
    tracker_turned_deg: float = 0.0


class Question(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the trainee is asked to name.

    Args:
        choices: answers offered.
        answer: the right one; empty where it is drawn (`hidden.one_of`).
        number: what the number is about that is asked beside it.
    """

    choices: tuple[str, ...]
    answer: str = ""
    number: Literal["", "touch", "joint"] = ""


class Aims(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """From where on a part of the score is full: errors, time, way. 0 leaves the part out."""

    touch_mm: float = 0.0
    tool_mm: float = 0.0
    axis_deg: float = 0.0
    relation_mm: float = 0.0
    minutes: float = 10.0
    travel_m: float = 0.0


class Exercise(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One exercise.

    Args:
        key: the file's name.
        order: place in the list.
        difficulty: 1 to 5.
        robot: the arm.
        goal: touch the spike, teach the tool, or find where the second robot stands.
        mode, touches: the wizard.
        nests: fixed points belong to the two-robot procedure.
        words: by language.
    """

    key: str
    order: int
    difficulty: int
    goal: Literal["touch", "tool", "relation"]
    robot: str
    mode: str = "touch"
    touches: int = 4
    nests: bool = True
    words: dict[str, Words]
    allowed: Allowed = Allowed()
    hidden: Hidden = Hidden()
    question: Question | None = None
    aims: Aims = Aims()

    def said(self, language: str) -> Words:
        """Its words in a language, English where that has none."""
        return self.words.get(language, self.words["en"])


def read_exercise(path: Path) -> Exercise:
    """One exercise from its file.

    Raises:
        FileFormatError: not such a file, or something in it that cannot be; says where.
    """
    try:
        table = msgspec.toml.decode(path.read_bytes())
        exercise = msgspec.convert({"key": path.stem, **table}, Exercise)
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    except (msgspec.DecodeError, ValueError) as error:
        raise FileFormatError(
            f"not an exercise ({error})", file=path, expected="see app/training/exercise.py"
        ) from None
    try:
        _check(exercise)
    except TeachframeError as error:
        raise FileFormatError(str(error), file=path) from None
    return exercise


def _check(exercise: Exercise) -> None:
    robot_named(exercise.robot)
    mode = mode_named(exercise.mode)
    if not mode.least_touches <= exercise.touches <= mode.most_touches:
        raise FileFormatError(f"{exercise.touches} touches", column="touches", expected="what the mode takes")
    if not 1 <= exercise.difficulty <= 5:
        raise FileFormatError(f"difficulty {exercise.difficulty}", column="difficulty", expected="1 to 5")
    for language in LANGUAGES:
        if language not in exercise.words:
            raise FileFormatError("no words", column=f"words.{language}", expected="title, task and learn")
    if (exercise.goal == "relation") != (len(exercise.hidden.robots) == 2):
        raise FileFormatError(
            "robots", column="hidden.robots", expected="two where the goal is relation, else none"
        )
    for name in exercise.hidden.robots:
        robot_named(name)
    question = exercise.question
    for answer in (*question.choices, *([question.answer] if question.answer else [])) if question else ():
        if answer not in ANSWERS:
            raise UnknownNameError(answer, available=ANSWERS, what="answer", column="question")
    if question and question.answer and question.answer not in question.choices:
        raise FileFormatError("the answer is none of the choices", column="question.answer")
    if bool(exercise.hidden.one_of) and (question is None or question.answer):
        raise FileFormatError("one_of draws the answer", column="question.answer", expected="no answer")


@cache
def exercises() -> dict[str, Exercise]:
    """All exercises by key, in their order."""
    found = [read_exercise(path) for path in sorted(FOLDER.glob("*.toml"))]
    return {exercise.key: exercise for exercise in sorted(found, key=lambda e: (e.order, e.key))}


def exercise(key: str) -> Exercise:
    """One exercise.

    Raises:
        UnknownNameError: there is none of this key.
    """
    if key not in exercises():
        raise UnknownNameError(key, available=exercises(), what="exercise")
    return exercises()[key]
