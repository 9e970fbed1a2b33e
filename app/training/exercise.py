"""An exercise, as its file says it: one TOML file each under static/exercises."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any, Literal

import msgspec
import tomli_w

from app import resources
from app.errors import FileFormatError, TeachframeError, UnknownNameError
from app.session.actions import Begin
from app.session.state import mode_named, robot_named
from app.session.steps.exercise import made_key
from app.typed import learnt

FOLDER = resources.STATIC / "exercises"
#: What can be wrong with a cell, as a trainee may answer.
ANSWERS = (
    "nothing", "bent_tip", "spike_moved", "joint_zero", "soft_gearbox", "wrong_tool", "tracker_moved",
)  # fmt: skip
LANGUAGES = ("en", "zh")
#: Exercises that were made here and have been met by this process, by key, and their files' texts; neither changes.
_made: dict[str, Exercise] = {}
_texts: dict[str, str] = {}


class _Part(msgspec.Struct, frozen=True, omit_defaults=True):
    """The root of an exercise's parts."""


class Words(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the trainee reads: the title, the task, what it teaches."""

    title: str
    task: str
    learn: str


class Allowed(_Part, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Helps: a number for the distance, close views, the proposal of the next touch, the drag handle, a hand that
    brings the tip to the spike (or turns the axes for the tracker), the light at contact."""

    distance: bool = True
    closeup: bool = True
    next_touch: bool = True
    handle: bool = True
    touch: bool = True
    light: bool = True


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


learnt(Exercise)


def read_exercise(path: Path) -> Exercise:
    """One exercise from its file.

    Raises:
        FileFormatError: not such a file, or something in it that cannot be; says where.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    except UnicodeDecodeError:
        raise FileFormatError("not a text", file=path, expected="UTF-8") from None
    return parse_exercise(text, path.stem, path)


def parse_exercise(text: str, key: str, file: str | Path) -> Exercise:
    """One exercise from the text of its file.

    Args:
        key: what it is called.
        file: named in errors.

    Raises:
        FileFormatError: not such a file, or something in it that cannot be; says where.
    """
    try:
        exercise = msgspec.convert({"key": key, **msgspec.toml.decode(text)}, Exercise)
    except (msgspec.DecodeError, ValueError) as error:
        raise FileFormatError(
            f"not an exercise ({error})", file=file, expected="the fields of a file in static/exercises"
        ) from None
    try:
        _check(exercise)
    except TeachframeError as error:
        raise FileFormatError(str(error), file=file) from None
    return exercise


def exercise_text(exercise: Exercise) -> str:
    """The text of its file: what `parse_exercise` reads, without what is as usual and without the key."""
    table = msgspec.to_builtins(exercise)
    del table["key"]
    return tomli_w.dumps(table)


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
    aims = msgspec.structs.asdict(exercise.aims)
    for name in (
        "minutes",
        {"touch": "touch_mm", "tool": "tool_mm", "relation": "relation_mm"}[exercise.goal],
    ):
        if not aims[name] > 0.0:  # a part of the score is a share of it
            raise FileFormatError(f"{aims[name]:g}", column=f"aims.{name}", expected="a number above 0")
    for name, value in {**aims, **_lengths(exercise.hidden)}.items():
        if not 0.0 <= value < math.inf:
            raise FileFormatError(f"{value:g}", column=name, expected="a number from 0 on")
    if not 1 <= exercise.hidden.spike_from[0] <= exercise.hidden.spike_from[1]:
        raise FileFormatError(
            "no touch it may happen before", column="hidden.spike_from", expected="first <= last"
        )
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


def _lengths(hidden: Hidden) -> dict[str, float]:
    """Its plain numbers: sizes of what is hidden."""
    return {
        f"hidden.{name}": value
        for name, value in msgspec.structs.asdict(hidden).items()
        if isinstance(value, float)
    }


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
    found = exercises().get(key) or _made.get(key)
    if found is None:
        raise UnknownNameError(key[:80], available=exercises(), what="exercise")
    return found


def made_exercise(lesson: str) -> Exercise:
    """The exercise whose file has this text; from now on `exercise` knows it by its key, which follows from the text.

    Raises:
        FileFormatError: something in it cannot be; says where.
    """
    key = made_key(lesson)
    if key not in _made:
        _made[key] = parse_exercise(lesson, key, f"{key}.toml")
        _texts[key] = lesson
    return _made[key]


def lesson_of(exercise: Exercise) -> str:
    """The text of the file of an exercise that was made here; empty for the shipped ones, which every program has."""
    return _texts.get(exercise.key, "")


def begun_exercise(begun: Begin) -> Exercise:
    """The exercise an attempt was begun with; raises UnknownNameError or FileFormatError."""
    return made_exercise(begun.lesson) if begun.lesson else exercise(begun.exercise)
