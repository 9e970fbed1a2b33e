"""How somebody stands, what is next, where points are lost."""

import msgspec
import pytest

from app.classroom.losses import losses
from app.classroom.progress import Lesson, Standing, next_lesson, standing, trend
from app.training.advice import Advice
from app.training.exercise import exercise
from app.training.levels import PASS
from app.training.score import Part, ScoreCard

LESSON = Lesson("l1", "first_tool", exercise("first_tool"))


def card(total, begun=0.0, **changes):
    usual = ScoreCard("first_tool", 1, begun, 60.0, total, (), {"tool_mm": 2.0}, {}, "", 0, "", 0)
    return msgspec.structs.replace(usual, **changes)


def test_best_last_error_time_and_trend():
    at = standing(LESSON, [card(40.0), card(70.0, 100.0), card(50.0, 200.0, figures={"tool_mm": 0.7})], 999.0)
    assert (at.tries, at.best, at.passed, at.error, at.seconds, at.last) == (3, 70.0, True, 0.7, 60.0, 200.0)
    assert at.trend == 5.0 and at.totals == (40.0, 70.0, 50.0)


def test_given_up_is_a_try_and_nothing_else():
    at = standing(LESSON, [card(0.0, given_up=True)], 999.0)
    assert (at.tries, at.best, at.passed, at.error, at.trend) == (1, None, False, None, None)


def test_the_trend_looks_at_the_last_tries_only():
    assert trend([0.0, 0.0, 0.0, 50.0, 60.0, 70.0, 80.0, 90.0]) == pytest.approx(10.0)
    assert trend([70.0]) is None


@pytest.mark.parametrize(
    ("cards", "now", "late"),
    [
        ([], 99.0, False),
        ([], 101.0, True),
        ([card(PASS, 39.0)], 500.0, False),  # passed in time
        ([card(PASS, 41.0)], 500.0, True),  # ended after it
        ([card(PASS - 0.1, 10.0)], 500.0, True),
    ],
)
def test_late_is_who_did_not_pass_in_time(cards, now, late):
    assert standing(msgspec_due(100.0), cards, now).late == late


def msgspec_due(due):
    return Lesson("l1", "first_tool", exercise("first_tool"), due=due)


def test_next_is_the_first_that_is_not_passed_and_can_be_done():
    broken = Lesson("l0", "gone", None, "a mistake")
    other = Lesson("l2", "bent_tip", exercise("bent_tip"))
    assert next_lesson([broken, LESSON, other], {}) is LESSON
    assert next_lesson([broken, LESSON, other], {"l1": Standing(passed=True)}) is other
    assert next_lesson([LESSON], {"l1": Standing(passed=True)}) is None


def parts(**values):
    return tuple(Part(key, value, weight) for key, (value, weight) in values.items())


def test_points_are_lost_where_the_parts_say():
    one = card(50.0, parts=parts(accuracy=(0.5, 50.0), time=(1.0, 50.0)), advice=(Advice("tilt"),))
    two = card(75.0, parts=parts(accuracy=(1.0, 50.0), time=(0.5, 50.0)), advice=(Advice("tilt"),))
    all_wrong = card(0.0, parts=parts(accuracy=(0.0, 50.0), time=(1.0, 50.0)))
    found = losses({"a": [all_wrong, one], "b": [two], "c": [card(0.0, given_up=True)]})
    assert (found.tries, found.people, found.given_up, found.mean) == (3, 2, 1, 62.5)
    first, second = found.parts
    assert (first.part, first.points, first.of, first.worst) == ("accuracy", 25.0, 50.0, 0.33)
    assert (second.part, second.points) == ("time", 8.3)
    assert found.advice == (("tilt", 2),)


def test_lost_points_and_kept_points_are_the_total():
    """The mean total of tries is 100 less all that is lost."""
    tries = [card(0.0, parts=parts(accuracy=(k / 4, 50.0), time=(1 - k / 4, 10.0))) for k in range(5)]
    total = sum(100 * sum(p.value * p.weight for p in t.parts) / 60.0 for t in tries) / 5
    found = losses({"a": tries})
    assert 100.0 - sum(part.points for part in found.parts) == pytest.approx(total, abs=0.1)


def test_what_was_taken_for_wrong_is_counted():
    wrong = card(10.0, right_answer="bent_tip", answer="spike_moved")
    silent, right = (
        card(10.0, right_answer="bent_tip"),
        card(90.0, right_answer="bent_tip", answer="bent_tip"),
    )
    assert losses({"a": [wrong, silent, right]}).wrong == (("spike_moved", 1), ("unsaid", 1))


def test_nobody_tried_is_nothing_lost():
    assert losses({"a": []}) == losses({})
