"""The load-data lesson as it is done at the pendant: four poses by the wrist, a run, mass and centre."""

import numpy as np
import pytest

from app.screens.load import CENTRE, MASS
from app.training.weighing import hidden_load, off, proposed
from tests.desk import plain, until

#: Half a 95% interval is 1.96 standard deviations; beyond 4.5 of them the interval is not true.
FAR = 4.5 / 1.96


def lesson(desk):
    return desk.view("found")


def test_four_poses_and_a_run_give_the_load(sit_at, brisk):
    desk = sit_at(robot="ur10e")
    view = lesson(desk)
    assert "Run and weigh" not in desk.shown()
    for number in range(4):
        desk.moves(view._propose)
        desk.does(view._take)
        assert view._rows.rows[number].state == "done", desk.said
    with desk.holding():
        desk.does(view._move)
        desk.rests()
        until(lambda: view.found is not None, f"the load; {desk.context.log[-3:]}")
    true = hidden_load(desk.context.model, desk.state.load.seed)
    share, apart = off(view.found, true)
    assert share < MASS and apart < CENTRE  # as good as makers ask for: what the lesson promises
    assert abs(view.found.mass - true.mass) < FAR * view.found.mass_half
    assert view.found.mass_half < 2.0 * MASS * true.mass  # a light load beside a gain that may be 3% off
    assert f"{view.found.mass:.3f} kg" in plain(view._result.content)
    assert not view._truth.visible  # what hangs there is told when it is asked for
    desk.press("Show the true load")
    assert f"{view.true.mass:.3f} kg" in plain(view._truth.content)
    assert 'data-colour="green"' in view._truth.content


def test_the_ghost_stands_at_the_pose_that_is_proposed_while_the_screen_is_open(sit_at):
    """It stood at the next touch of the tool wizard, whatever was open."""
    desk = sit_at(robot="ur10e")
    ghost = desk.context.stage.next_arm
    desk.live.choose("screen", "load")
    desk.idle()
    for number in range(4):
        assert np.allclose(ghost._q, proposed(desk.context.model)[number])
        assert lesson(desk)._go.rank == ("main" if number else "plain")  # a pose like the last is none
        desk.place(proposed(desk.context.model)[number])
        desk.does(desk.context.numbers)
        assert lesson(desk)._record.rank == "main"
        desk.does(lesson(desk)._take)
    assert ghost._q is None and not ghost.visible
    desk.live.choose("language", "zh")  # everything is made anew, the screen stays open
    desk.idle()
    assert desk.context.stage.next_arm._screen == "load"


def test_a_pose_like_another_is_refused_with_how_far_it_is_turned(sit_at):
    desk = sit_at(robot="ur10e")
    view = lesson(desk)
    desk.does(view._take)
    nearly = desk.q.copy()
    nearly[4] += np.radians(12.0)
    desk.place(nearly)
    desk.does(view._take)
    assert desk.said[0] == "warning" and "only 12°" in desk.said[1]
    assert [row.state for row in view._rows.rows] == ["done", "now", "open", "open"]
    desk.does(lambda: view._in_row("pose0/delete"))
    desk.does(view._take)
    assert view._rows.rows[0].state == "done"


def test_a_restart_brings_the_lesson_back_as_it_was(sit_at):
    desk = sit_at(robot="ur10e")
    desk.does(lesson(desk)._take)
    before = desk.state.load
    desk.live.close()
    again = sit_at(robot="ur10e")
    assert again.state.load.seed == before.seed and again.state.load.poses == before.poses
    assert [row.state for row in lesson(again)._rows.rows] == ["done", "now", "open", "open"]


@pytest.mark.parametrize("language, word", [("en", "Load data"), ("zh", "负载数据")])
def test_it_is_a_tab_in_both_languages(sit_at, language, word):
    desk = sit_at(robot="ur10e")
    desk.live.choose("language", language)
    desk.idle()
    assert word in {w.label for w in desk.context.ui.widgets() if w.kind == "screen"}
