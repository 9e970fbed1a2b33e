"""An exercise made in a page: right fields make a file like the shipped ones, wrong ones a line each."""

import numpy as np
import pytest

from app.classroom.making import NUMBERS, WRONG, drafted, tried, usual
from app.training.exercise import exercise, exercise_text, exercises, made_exercise
from app.training.truth import draw
from tests.training.trainee import GOOD

FILLED = {**usual(), "title_en": "Two", "task_en": "Touch.", "robot": "jby50", "touches": "6"}


def said(draft, language="en"):
    return [line.text(language) for line in draft.mistakes]


@pytest.mark.parametrize("wrong", WRONG)
def test_every_fault_makes_an_exercise_that_hides_it(wrong):
    fields = {**FILLED, "wrong": wrong, "joint": "5", "load_kg": "50", "load_z_mm": "300"}
    draft = drafted(fields, "en")
    assert not draft.mistakes
    made = made_exercise(draft.text)
    assert draw(made, 5).answer == wrong and made.words["zh"].title == "Two"
    if wrong != "nothing":
        assert made.question is not None and made.question.answer == wrong


def test_a_made_exercise_can_be_done_and_passed():
    made = made_exercise(drafted(FILLED, "en").text)
    assert GOOD.scores(made, 3).total > 60.0


def test_a_bent_tip_is_bent_by_what_was_asked_for():
    """The length of the slip is within the spread of what the page said."""
    made = made_exercise(drafted({**FILLED, "wrong": "bent_tip", "bent_mm": "4"}, "en").text)
    (fault,) = draw(made, 5).world.faults
    assert 1e3 * np.linalg.norm(list(fault.values.values())) == pytest.approx(4.0, rel=0.11)


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"title_en": ""}, "Title: nothing is written there."),
        (
            {"tool_spread_mm": "wide"},
            "Tool point off the drawn one by up to: wide is not a number from 0 to 60.",
        ),
        ({"tool_spread_mm": "nan"}, "not a number from 0 to 60"),
        ({"touches": "4.5"}, "Touches: 4.5 is not a whole number"),
        ({"touches": "8"}, "Touches: 8 is not a whole number from 3 to 7."),
        ({"robot": "../../etc"}, "Robot: ../../etc cannot be chosen."),
        ({"wrong": "bent_tip", "from_touch": "5"}, "comes after the last one"),
        ({"wrong": "spike_moved", "to_touch": "9"}, "only 6 touches"),
        ({"wrong": "joint_zero", "joint": "9"}, "Joint: 9 is not a whole number from 1 to 6."),
        ({"wrong": "soft_gearbox"}, "the load is 0 kg"),
        ({"wrong": "bent_tip", "goal": "touch"}, "only where the tool is taught"),
        ({"title_en": "x" * 81}, "81 characters, at most 80"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(changes, line):
    draft = drafted({**FILLED, **changes}, "en")
    assert not draft.text and any(line in one for one in said(draft)), said(draft)
    assert all("".join(said(draft, "zh")) >= "\u4e00" for _ in [0]) and said(draft, "zh") != said(draft)


def test_all_mistakes_are_said_at_once():
    assert len(drafted({**FILLED, "title_en": "", "minutes": "0", "aim_mm": "x"}, "en").mistakes) == 3


@pytest.mark.parametrize("key", list(exercises()))
def test_shipped_exercises_pass_the_trial(key):
    assert not tried(exercise_text(exercise(key)), "en")


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ('effect = "tool_slip"', 'effect = "tool_slap"', "unknown"),
        ("dx_mm", "dx_cm", "unknown value of tool_slip"),
        ("tool_mm = 0.8", "tool_mm = 0", "aims.tool_mm"),
        ("minutes = 12", "minutes = -1", "aims.minutes"),
        ("tool_spread_mm = 9.0", 'tool_spread_mm = "wide"', "Expected `float`"),
        ("touches = 6", "touches =", "not an exercise"),
        ("3,\n", '"a",\n', "The file"),
    ],
)  # fmt: skip
def test_a_file_with_a_mistake_is_a_line(old, new, line):
    text = exercise_text(exercise("bent_tip"))
    assert old in text, text
    (problem,) = tried(text.replace(old, new, 1), "en")
    assert line in problem.text("en") and "\n" not in problem.text("en")


def test_a_joint_the_arm_does_not_have_is_a_line():
    text = exercise_text(exercise("joint_three"))
    assert tried(text.replace("joint = 3", "joint = 99", 1), "en")


def test_the_bounds_of_every_number_hold_what_it_is_usually():
    assert all(low <= value <= high for value, low, high in NUMBERS.values())
