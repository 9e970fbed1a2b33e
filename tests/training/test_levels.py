"""The parts of a score are its whole; fewer helps are worth more; no advice asks for what the task forbids."""

from dataclasses import replace

import msgspec
import pytest

from app.session.actions import Finish
from app.training.exercise import exercise, exercises
from app.training.levels import LEVELS, alone, level_of, levels_of
from app.training.score import apportioned, score
from app.training.truth import draw
from tests.training.trainee import FAR, GOOD, POOR

ALL = list(exercises().values())
BUTTONS = 80.0  # points the first level is worth at most, where it has all helps


@pytest.mark.parametrize("chosen", ALL, ids=lambda e: e.key)
def test_the_parts_add_up_to_the_whole_as_measured_and_as_shown(chosen):
    for who in (GOOD, POOR, replace(GOOD, seconds=47.0)):
        for level in levels_of(chosen):
            card = replace(who, level=level).scores(chosen, 2)
            assert sum(part.weight for part in card.parts) == 100.0
            assert sum(part.points for part in card.parts) == pytest.approx(card.total, abs=0.06)
            assert sum(card.shown) == round(card.total)
            for part, points in zip(card.parts, card.shown, strict=True):
                assert 0 <= points <= part.weight and abs(points - part.points) < 1.0
            assert card.level == level


@pytest.mark.parametrize("chosen", ALL, ids=lambda e: e.key)
def test_the_same_work_is_worth_more_with_fewer_helps_and_all_only_without(chosen):
    levels = levels_of(chosen)
    totals = [replace(GOOD, level=level).scores(chosen, 2).total for level in levels]
    assert totals == sorted(totals) and len(set(totals)) == len(totals)
    assert alone(chosen, LEVELS[levels[-1]]) == 1.0
    if all(getattr(chosen.allowed, help_) for help_ in ("touch", "next_touch", "distance", "light")):
        assert totals[0] < BUTTONS


def test_levels_that_take_nothing_away_are_not_offered():
    assert levels_of(exercise("first_tool")) == ("guided", "light", "eye")
    assert levels_of(exercise("by_eye_and_light")) == ("light", "eye")
    assert levels_of(exercise("two_robots")) == ("guided", "eye")


def test_a_level_is_known_again_from_what_an_attempt_was_begun_without():
    for level in LEVELS:
        begun = replace(GOOD, level=level).does(exercise("first_tool"), 1).entries[1].action
        assert level_of(begun) == level


@pytest.mark.parametrize("seed", range(12))
def test_no_point_is_lost_for_a_number_nobody_could_enter(seed):
    chosen = exercise("something_is_wrong")
    assert chosen.question is not None and not chosen.question.number
    entries = GOOD.does(chosen, seed).entries[1:]
    ended = msgspec.structs.replace(entries[-1], action=Finish(draw(chosen, seed).answer, 0))
    card = score(chosen, (*entries[:-1], ended))
    assert next(part.value for part in card.parts if part.key == "answer") == 1.0


def test_who_touches_the_first_again_as_he_is_told_is_not_told_that_two_are_alike():
    chosen = exercise("bent_tip")
    again = replace(GOOD, tilts=(*FAR[:5], FAR[0], *FAR[5:]), again=False)
    card = again.scores(chosen, 3)
    codes = [advice.code for advice in card.advice]
    assert codes and "tilt" not in codes and "tidy" not in codes


def test_recording_again_costs_nothing_where_the_task_may_ask_for_it():
    assert "tidy" not in {part.key for part in GOOD.scores(exercise("bent_tip"), 3).parts}
    assert "tidy" in {part.key for part in GOOD.scores(exercise("first_tool"), 3).parts}


def test_whole_points_are_given_to_the_largest_remainders():
    assert apportioned([33.4, 33.3, 33.3], 100) == [34, 33, 33]
    assert apportioned([13.0, 41.6, 0.0], 55) == [13, 42, 0]
    assert apportioned([49.9999999, 50.0], 100) == [50, 50]
