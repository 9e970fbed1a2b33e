"""The two-robot screen's run by hand, drawn into a scene without a page."""

import numpy as np
import pytest

from app.errors import ActionRefusedError
from app.screens._base.run import Run
from app.simulation.tracker_cell import make_cell
from app.simulation.tracker_meeting import meet

SIGMAS = 4.0
STEP = np.radians(20)


@pytest.fixture
def run_of(sit_at):
    desk, runs = sit_at(), []

    def start(**options):
        while runs:
            runs.pop().drawing.remove()
        run = Run(desk.context, make_cell("irb120", "ur10e", 5), seed=1, **options)
        runs.append(run)
        return run

    return start


def _by_hand(run):
    while (step := run.wizard.step) is not None:
        if step.kind == "nests":
            for _ in run.cell.nests:
                assert run.measure().seen
        elif step.kind == "zero":
            run.pose(step.robot - 1, run.now.arms[step.robot - 1].rest)
            assert run.measure().seen
        else:
            for angle in run.now.visible_angles(step.robot - 1, step.axis, STEP, np.radians(100)):
                assert run.turn_to(float(angle)).seen
                run.measure()
        run.leave()


def test_a_procedure_by_hand_ends_with_both_tools_at_one_point(run_of):
    run = run_of(nests=True, pushed=False)
    _by_hand(run)
    assert run.solve() is not None
    meeting = meet(run.cell, run.relation)
    assert meeting.miss < SIGMAS * meeting.predicted


def test_the_exercise_pushes_the_tracker_and_the_nests_tell(run_of):
    run = run_of(nests=True, pushed=True)
    _by_hand(run)
    run.solve()
    assert [w.code for w in run.relation.warnings] == ["tracker_moved"]
    meeting = meet(run.cell, run.relation)
    assert meeting.miss < SIGMAS * meeting.predicted


def test_the_exercise_without_nests_misses_by_millimetres(run_of):
    run = run_of(nests=False, pushed=True)
    _by_hand(run)
    run.solve()
    assert meet(run.cell, run.relation).miss > 20 * meet(run.cell, run.relation).predicted


def test_a_step_is_not_left_and_nothing_is_solved_before_its_time(run_of):
    run = run_of(nests=False, pushed=False)
    with pytest.raises(ActionRefusedError):
        run.leave()
    with pytest.raises(ActionRefusedError):
        run.solve()


def test_a_reflector_that_is_not_seen_changes_nothing(run_of):
    run = run_of(nests=False, pushed=False)
    run.measure()
    run.leave()
    away = [a for a in np.radians(np.arange(-160, 161, 10)) if not run.turn_to(float(a)).seen]
    assert away, "somewhere the beam must break"
    run.turn_to(float(away[0]))
    before = run.wizard
    assert not run.measure().seen and run.wizard is before


def test_the_cell_can_be_taken_away_and_drawn_again(run_of):
    first = run_of(nests=True, pushed=False)
    _by_hand(first)
    first.solve()
    first.drawing.clear()
    second = run_of(nests=True, pushed=False)
    assert second.drawing.arms and second.measure().seen


def test_what_is_said_at_the_end_is_what_was_found(desk):
    from types import SimpleNamespace as Some

    view, grave = desk.view("run"), Some(severe=True)
    ends = (
        (Some(T_base1_base2=object(), warnings=()), "good", "Both bases are found"),
        (Some(T_base1_base2=object(), warnings=(grave,)), "warning", "serious warning"),
        (Some(T_base1_base2=None, warnings=(grave,)), "warning", "No relation"),
        (None, "warning", "No relation"),
    )
    for relation, level, words in ends:
        run = Some(wizard=Some(done=True), relation=None, solve=lambda relation=relation: relation)
        desk.does(lambda run=run: view._finish(run))
        assert desk.said[0] == level and words in desk.said[1]


def test_the_wizards_points_are_not_shown_beside_another_arm(desk):
    assert desk.live.read().points
    desk.does(lambda: desk.context.show_instead(lambda: (desk.context.model, desk.q)))
    assert desk.live.read().points == ""
