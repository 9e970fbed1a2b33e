"""An exercise that was made here: its file's text is all there is to it, and goes with the attempt."""

import msgspec
import pytest

from app.errors import ActionRefusedError, FileFormatError
from app.screens.exercising import aids_of
from app.session import Session
from app.training import exercise as shelf
from app.training.cell import begin, world_of
from app.training.exercise import exercise, exercise_text, exercises, made_exercise, parse_exercise
from app.training.score import score
from tests.training.trainee import GOOD


def like(key, **changes):
    """A shipped exercise as somebody made it again."""
    return exercise_text(msgspec.structs.replace(exercise(key), **changes))


@pytest.mark.parametrize("key", list(exercises()))
def test_what_is_written_is_read_as_the_same_exercise(key):
    assert parse_exercise(exercise_text(exercise(key)), key, "x") == exercise(key)


def test_a_made_exercise_is_known_by_its_content():
    one, other = made_exercise(like("first_tool", touches=5)), made_exercise(like("first_tool", touches=6))
    assert one.key != other.key and exercise(one.key) is one
    assert made_exercise(like("first_tool", touches=5)) is one


def test_an_attempt_carries_the_exercise_so_that_another_program_goes_on_with_it(monkeypatch):
    made = made_exercise(like("first_tool", touches=5))
    begun = begin(made, 7, 0.0)
    session = Session()
    session.do(begun)
    monkeypatch.setattr(shelf, "_made", {})  # a program that never met it
    again = Session()
    again.do(begun)
    assert world_of(again.state) is not None and len(again.state.steps) == 5


def test_an_attempt_with_another_file_than_its_key_says_is_refused():
    begun = begin(made_exercise(like("first_tool")), 7, 0.0)
    with pytest.raises(ActionRefusedError, match="not the one it was begun with"):
        Session().do(msgspec.structs.replace(begun, lesson=like("first_tool", touches=5)))
    with pytest.raises(ActionRefusedError, match="not the one it was begun with"):
        Session().do(msgspec.structs.replace(begun, exercise="first_tool"))


def test_a_made_exercise_is_scored_like_the_shipped_one():
    """Same hidden truth by the same seed, same touches: the same score."""
    made = made_exercise(like("first_tool"))
    assert GOOD.scores(made, 3).total == GOOD.scores(exercise("first_tool"), 3).total
    assert score(made, GOOD.does(made, 3).entries[1:]).exercise == made.key


def test_helps_a_class_does_not_allow_are_not_there():
    session = Session()
    session.do(begin(exercise("first_tool"), 7, 0.0, without=("distance", "touch")))
    aids = aids_of(session.state)
    assert not aids.distance and not aids.touch and aids.closeup


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("order = ", "not an exercise"),
        ("order = 1", "missing required field"),
        (like("first_tool").replace('robot = "jby50"', 'robot = "jby5"'), "did you mean jby50"),
        (like("first_tool", touches=400), "400 touches"),
    ],
)
def test_a_file_with_a_mistake_says_where(text, said):
    with pytest.raises(FileFormatError, match=said):
        made_exercise(text)
