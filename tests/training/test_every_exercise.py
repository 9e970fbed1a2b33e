"""A contract for every file under static/exercises: it can be done from start to score, and doing it well pays."""

import numpy as np
import pytest

from app.session import Store
from app.session.state import mode_named
from app.training.attempt import last_attempt
from app.training.exercise import LANGUAGES, exercises
from app.training.score import WEIGHTS, score
from app.training.truth import BESIDE, draw
from tests.training.trainee import GOOD, POOR

ALL = list(exercises().values())
TOOLS = [e for e in ALL if e.goal != "relation"]
SEEDS = (1, 2, 3)
WELL = 75.0  # of 100: what careful work must at least be worth
ADVANTAGE = 20.0


def _id(exercise):
    return exercise.key


def test_there_are_ten_exercises_and_two_with_a_tracker():
    assert len(TOOLS) >= 10 and len(ALL) - len(TOOLS) >= 2
    assert len({e.order for e in ALL}) == len(ALL)
    answers = {e.question.answer for e in ALL if e.question}
    assert answers >= {"bent_tip", "spike_moved", "joint_zero", "wrong_tool", "soft_gearbox", "tracker_moved"}


@pytest.mark.parametrize("exercise", ALL, ids=_id)
def test_it_has_words_in_every_language(exercise):
    for language in LANGUAGES:
        words = exercise.said(language)
        assert words.title and words.task and words.learn
    assert exercise.words["zh"] != exercise.words["en"]


@pytest.mark.parametrize("exercise", ALL, ids=_id)
def test_who_does_it_well_scores_better_than_who_does_it_badly(exercise):
    ahead = []
    for seed in SEEDS:
        good, poor = GOOD.scores(exercise, seed), POOR.scores(exercise, seed)
        assert WELL < good.total <= 100.0 and good.total > poor.total, (good, poor)
        assert {part.key for part in good.parts} <= set(WEIGHTS)
        assert poor.advice and poor.advice[0].code != "well"
        ahead.append(good.total - poor.total)
    assert np.mean(ahead) > ADVANTAGE


@pytest.mark.parametrize("exercise", ALL, ids=_id)
def test_the_journal_alone_gives_the_same_score_again(exercise, tmp_path):
    store = Store(tmp_path)
    session = GOOD.does(exercise, 4, session=store.create())
    entries = last_attempt(session.entries)
    assert score(exercise, last_attempt(store.recorded(session.name).entries)) == score(exercise, entries)


@pytest.mark.parametrize("exercise", TOOLS, ids=_id)
def test_each_attempt_hides_something_else_beside_what_is_drawn(exercise):
    one, two, again = draw(exercise, 1), draw(exercise, 2), draw(exercise, 1)
    assert np.array_equal(one.world.p_base_spike, again.world.p_base_spike)
    if exercise.hidden.tool_spread_mm:
        apart = one.world.T_flange_tool_true.position - two.world.T_flange_tool_true.position
        assert np.abs(apart).max() > BESIDE
    for world in (one.world, two.world):
        drawn = world.picture.T_flange_tool.position - world.T_flange_tool_true.position
        assert np.isclose(np.linalg.norm(drawn), BESIDE)
        assert np.isclose(np.linalg.norm(world.picture.p_base_spike - world.p_base_spike), BESIDE)


@pytest.mark.parametrize("exercise", TOOLS, ids=_id)
def test_its_faults_are_parameters_the_library_has(exercise):
    for fault in draw(exercise, 1).world.faults:
        assert fault.checked(draw(exercise, 1).world.robot) is fault
        assert any(fault.values.values())


@pytest.mark.parametrize("exercise", ALL, ids=_id)
def test_its_wizard_asks_for_what_its_goal_needs(exercise):
    axes = {step.role for step in mode_named(exercise.mode).steps(exercise.touches)} & {"x", "y", "z"}
    assert bool(exercise.aims.axis_deg) == bool(axes)
    aims = exercise.aims
    aim = {"touch": aims.touch_mm, "tool": aims.tool_mm, "relation": aims.relation_mm}[exercise.goal]
    assert aim > 0 and aims.minutes > 0


def test_the_last_exercise_hides_each_of_its_faults_and_sometimes_nothing():
    exercise = exercises()["something_is_wrong"]
    found = {draw(exercise, seed).answer for seed in range(40)}
    assert found == {"nothing", "bent_tip", "joint_zero", "wrong_tool"}
    for seed in range(12):  # an active tool alone gives nothing away: there always is one
        assert draw(exercise, seed).T_flange_tool_active is not None
