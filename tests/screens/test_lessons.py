"""Lessons: helps fade from level to level; a demonstration takes nothing away."""

import numpy as np
import pytest

from app.screens._training import showing
from app.session.actions import Begin, Record
from app.training.exercise import exercise, exercises
from app.training.levels import LEVELS, PASS, levels_of, next_up
from tests.desk import plain, until
from tests.standing_out import standing_out

WITH_BUTTONS = 80.0  # points that buttons alone are never worth


def training(desk):
    return desk.view("begin_lesson")


def begin(desk, key, level):
    desk.does(lambda: training(desk).begin_lesson(key, level))
    assert isinstance(desk.state.running.begun, Begin)


def finish(desk):
    desk.does(lambda: training(desk)._finish())
    return desk.context.shelf.records.history(training(desk)._trainee)[-1]


def test_pressing_three_buttons_four_times_passes_the_first_level_and_no_more(sit_at, brisk):
    desk = sit_at(robot="jby50")
    desk.context.rng = np.random.default_rng(2)
    begin(desk, "first_tool", "guided")
    for _ in range(4):
        view = desk.view("deciding")
        until(lambda view=view: view._next_touch.proposal or view._next_touch._refused, "the proposal")
        desk.moves(view._next_touch.go)
        desk.moves(view._help)
        desk.does(view._record_next)
    desk.does(view._compute)
    desk.does(view.deciding.accept)
    finishing = desk.context.t("training.finish")
    assert standing_out(desk.context.ui, "tool") == [finishing]  # and not the turn about the tool besides
    card = finish(desk)
    assert card.level == "guided" and PASS <= card.total < WITH_BUTTONS
    assert sum(part.points for part in card.parts) == pytest.approx(card.total, abs=0.05)
    assert sum(card.shown) == round(card.total)
    assert next(part.value for part in card.parts if part.key == "alone") == 0.0
    labels = desk.shown()
    assert any(label.startswith("Next: My first tool point (contact light only)") for label in labels)
    assert "Try again" in labels
    desk.press(next(label for label in labels if label.startswith("Next: ")))
    assert desk.state.running.begun.without == LEVELS["light"] and not desk.state.captures


def test_what_a_level_takes_away_is_not_there(sit_at):
    desk = sit_at(robot="jby50")
    seen = {}
    for level in levels_of(exercise("first_tool")):
        begin(desk, "first_tool", level)
        touched = desk.context.world.touch(desk.context.model.home, np.random.default_rng(0)).q
        desk.place(touched)
        assert desk.context.world.touching(desk.q)
        desk.does(desk.view("deciding")._record_next)
        read, said = desk.live.read(), desk.context.log[-1][2]
        labels = desk.shown()
        seen[level] = (
            "Touch the spike" in labels, read.touching, read.touch != "", read.handle,
        )  # fmt: skip
        assert "in the air" not in said
        desk.does(lambda: training(desk)._give_up())
    assert seen == {
        "guided": (True, True, True, True),
        "light": (False, True, True, True),
        "eye": (False, False, False, False),
    }


def test_by_eye_a_touch_in_the_air_is_recorded_like_any_other(sit_at):
    desk = sit_at(robot="jby50")
    for level, lamp, told in (("light", "yellow", True), ("eye", "green", False)):
        begin(desk, "first_tool", level)
        desk.does(desk.view("deciding")._record_next)
        row = desk.view("deciding").rows.rows[0]
        assert (row.light, desk.context.log[-1][1] == "warning") == (lamp, told)
        desk.does(lambda: training(desk)._give_up())


def test_task_hint_and_clock_stand_beside_the_work_and_the_hint_goes_last(sit_at):
    desk = sit_at(robot="jby50")
    for level in levels_of(exercise("first_tool")):
        begin(desk, "first_tool", level)
        task = training(desk)._task
        assert desk.context.ui.seen(task.data) and "four touches" in plain(task.content)
        assert "exercise-progress" in task.content and " / 8:00" in plain(task.content)
        assert ("exercise-hint" in task.content) == (level != "eye")
        desk.does(lambda: training(desk)._give_up())


def test_next_leads_through_every_level_of_every_exercise():
    order = list(exercises().values())
    at, seen = (order[0], levels_of(order[0])[0]), []
    while (at[0].key, at[1]) not in seen:
        seen.append((at[0].key, at[1]))
        at = next_up(*at, order)
    assert seen == [(e.key, level) for e in order for level in levels_of(e)]
    assert len(seen) > 2 * len(order)


def test_a_demonstration_pauses_steps_shows_its_button_and_takes_no_point_away(sit_at, brisk, monkeypatch):
    monkeypatch.setattr(showing, "_REST", 0.05)
    monkeypatch.setattr(showing, "_PRESS", 0.05)
    desk = sit_at(robot="jby50")
    desk.does(lambda: desk.context.do(Record("touch1")))
    mine = dict(desk.state.captures)
    demo, tool = desk.view("showing").showing, desk.view("deciding")
    desk.does(lambda: demo.play("touch"))
    desk.does(demo.pause)
    assert demo.playing and demo.at == 0 and desk.drive.how == "standing"
    assert [row.state for row in tool.rows.rows] == ["now", "open", "open", "open"]
    for number in (1, 2):
        with desk.holding():
            desk.does(demo.step)
            until(lambda number=number: demo.at == number, "the step")
            desk.rests()
        assert tool.rows.value == f"touch{number}/record"
        assert [row.state for row in tool.rows.rows].count("done") == number
    desk.does(demo.go_on)
    with desk.holding():
        until(lambda: not demo.playing, "the end")
        desk.rests()
    assert desk.state.result is not None
    desk.does(demo.stop)
    assert desk.state.captures == mine and desk.state.result is None and tool.rows.value is None


@pytest.mark.parametrize("how", ["another language", "an exercise", "the page goes"])
def test_however_a_demonstration_ends_the_own_points_are_there(sit_at, brisk, how):
    desk = sit_at(robot="jby50")
    desk.does(lambda: desk.context.do(Record("touch1")))
    mine = dict(desk.state.captures)
    desk.does(lambda: desk.view("showing").showing.play("touch_zx"))
    assert dict(desk.state.captures) != mine
    if how == "another language":
        desk.live.choose("language", "zh")
        desk.idle()
    elif how == "an exercise":
        training(desk).showing.stop()
    else:
        session = desk.context.session
        desk.live.close()
        assert dict(session.state.captures) == mine
        return
    desk.idle()
    assert dict(desk.state.captures) == mine


def test_when_all_that_is_asked_for_is_there_the_key_that_finishes_stands_out(sit_at):
    """In a lesson of touches alone the wizard asked to calculate, and the task to finish."""
    desk = sit_at(robot="ur10e")
    begin(desk, "touch_the_spike", "guided")
    key, view = training(desk)._finish_button, desk.view("deciding")
    assert key.rank == "plain"
    start = desk.q.copy()
    for number, turn in enumerate((0.0, 0.3, -0.3), 1):
        q = start.copy()
        q[4] += turn
        desk.place(desk.context.world.touch(q, np.random.default_rng(number)).q)
        desk.does(view._record_next)
    assert key.rank == "main" and view._calculate.rank == "plain" and view._calculate.visible
    assert "Finish the exercise" in plain(view._next.content)


def test_what_is_not_done_takes_a_second_press_to_finish(sit_at):
    """A key pressed too early ended the attempt with no points, and no way back."""
    desk = sit_at(robot="ur10e")
    begin(desk, "touch_the_spike", "guided")
    view = training(desk)
    desk.does(view._finish)
    assert desk.state.running is not None and "Press again" in desk.said[-1]
    assert view._finish_button.label == desk.context.t("training.finish_sure")
    desk.does(view._finish)
    assert desk.state.running is None


def test_an_exercise_that_begins_with_a_tool_asks_for_the_work_first(sit_at):
    """Tool 1 was active, and so the key that finishes stood out before anything was done."""
    desk = sit_at(robot="jby50")
    begin(desk, "wrong_tool_active", "guided")
    assert desk.state.tool is not None and training(desk)._finish_button.rank == "plain"
    assert standing_out(desk.context.ui, "tool") == [desk.context.t("tool.propose")]
