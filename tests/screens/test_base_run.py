"""The two-robot screen's run by hand, drawn into a scene without a page."""

import numpy as np
import pytest

from app.errors import ActionRefusedError
from app.scene.instead import Instead
from app.screens._base.run import Run
from app.simulation.tracker_cell import make_cell
from app.simulation.tracker_meeting import meet
from tests.desk import until

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


def _turned(run, angle):
    """The axis of the step at hand stands at `angle` [rad], without a way."""
    step = run.wizard.step
    run.pose(step.robot - 1, run.now.posture(step.robot - 1, step.axis, angle))
    return run.aim(step.robot - 1)


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
                assert _turned(run, float(angle)).seen
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
    away = [a for a in np.radians(np.arange(-160, 161, 10)) if not _turned(run, float(a)).seen]
    assert away, "somewhere the beam must break"
    _turned(run, float(away[0]))
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
        desk.does(lambda run=run: view.finish(run))
        assert desk.said[0] == level and words in desk.said[1]


def test_the_wizards_points_are_not_shown_beside_another_arm(desk):
    assert desk.live.read().points
    place = Instead(np.eye(3), np.zeros(3), np.ones(3))
    desk.does(lambda: desk.context.show_instead(lambda: (desk.context.model, desk.q), lambda: place))
    assert desk.live.read().points == ""


def test_a_step_in_which_nothing_moves_gives_its_keys_back(in_the_cell):
    """'Run this step' on the nests ended and left 'Stop the procedure' alone on the page."""
    desk, view = in_the_cell
    desk.press("Run this step")
    desk.rests()
    assert view.run.wizard.index == 1
    assert {"Run this step", "By hand"} <= desk.shown() and "Stop the procedure" not in desk.shown()


def test_the_message_says_what_is_waited_for_and_then_what_is_done(in_the_cell):
    """'The tracker is ready' stood beside a procedure that waited for the switch, and while it ran."""
    desk, view = in_the_cell
    desk.press("Run this step")
    desk.rests()
    assert "fixed points: measured. Next: Robot 1 · zero position" in desk.said[1]
    view._every.value = 45.0
    desk.does(lambda: view._start(whole=True))
    until(lambda: view.run.moves(), "the arc")
    until(lambda: desk.said[1].startswith("Waits for the switch"), "what is waited for")
    with desk.holding():
        until(lambda: "axis 1 alone: it is being measured" in desk.said[1], "what is done")
    desk.live.cancel()
    desk.idle()
    assert "was stopped" in desk.said[1] and desk.drive.how == "standing"
    desk.does(lambda: view._start(whole=True))
    with desk.holding():
        desk.rests()
    desk.press("Send both tools to one point")
    assert desk.said[1].startswith("Waits for the switch") and "both tools go to one point" in desk.said[1]


def test_by_hand_too_nothing_moves_unless_the_switch_is_held(in_the_cell):
    desk, view = in_the_cell
    for _ in range(2):  # nests, zero position
        desk.press("Run this step")
        with desk.holding():
            desk.rests()
    stood = view.run.postures[0].copy()
    desk.press("Axis angle", 40.0)
    for _ in range(5):
        desk.does(lambda: None)
    assert np.array_equal(view.run.postures[0], stood) and desk.drive.how == "waiting"
    assert desk.drive.errand == "axis 1 of robot 1" and desk.said[1].startswith("Waits for the switch")
    with desk.holding():
        desk.rests()
    assert view.run.postures[0][0] == pytest.approx(np.radians(40.0))
    desk.press("Axis angle", -40.0)
    desk.drive.stop()
    desk.live.beat(True, None, 0, 0)
    for degrees in (-40.0, -20.0):
        desk.press("Axis angle", degrees)
    assert view.run.postures[0][0] == pytest.approx(np.radians(40.0)) and desk.said[0] == "warning"


def test_the_zero_position_by_hand_is_measured_at_zero(in_the_cell):
    """After an arc by hand the arm stood where the arc ended, and that was taken for zero."""
    desk, view = in_the_cell
    for _ in range(2):
        desk.press("Run this step")
        with desk.holding():
            desk.rests()
    for degrees in (-30.0, -15.0, 0.0, 15.0, 30.0):
        desk.press("Axis angle", degrees)
        with desk.holding():
            desk.rests()
        desk.press("Point", "Measure")
    desk.press("Point", "Next step")
    assert view.run.wizard.step.kind == "zero" and "Axis angle" not in desk.shown()
    desk.press("Point", "Measure")
    assert desk.drive.how == "waiting" and not view.run.wizard.of(view.run.wizard.step.key)
    with desk.holding():
        desk.rests()
    assert np.array_equal(view.run.postures[0], view.run.now.arms[0].rest)
    assert len(view.run.wizard.of(view.run.wizard.step.key)) == 1


#: Width over height of a desk's scene and of a phone's.
SHAPES = (0.93, 2.4)


def outside(view, points, shape, field=0.75):
    """Points (n, 3) that an eye with this field of view [rad] does not see in a window of this shape."""
    eye, centre = view
    ahead = (centre - eye) / np.linalg.norm(centre - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    rel = points - eye
    deep = np.tan(field / 2.0) * (rel @ ahead)
    off = np.maximum(np.abs(rel @ right) / (shape * deep), np.abs(rel @ np.cross(right, ahead)) / deep)
    return points[off > 1.0]


@pytest.mark.parametrize("shape", SHAPES)
def test_every_named_view_but_the_tips_keeps_both_robots_and_the_tracker_in_sight(run_of, shape):
    """They looked at the tool's cell, which is not there: at the inside of a robot, or at nothing."""
    run = run_of(nests=True, pushed=False)
    arms = [arm.T_world_base.apply(arm.robot.chain.frames(q[None]).joint_positions[0])
            for arm, q in zip(run.cell.arms, run.postures, strict=True)]  # fmt: skip
    seen = np.vstack([*arms, run.cell.tracker.T_world_tracker.position[None], run.cell.nests])
    for name in ("whole", "side", "front"):
        assert not len(outside(run.instead().view(name, shape), seen, shape)), name
    eye, centre = run.instead().view("close", shape)
    assert np.allclose(centre, run.drawn_tips()[0]) and np.linalg.norm(eye - centre) < 2.0


def test_where_both_tools_have_met_both_arms_are_in_sight(in_the_cell):
    desk, view = in_the_cell
    desk.does(lambda: view.begin(view._measuring(view.run, True), ""))
    with desk.holding():
        desk.rests()
    desk.press("Send both tools to one point")
    with desk.holding():
        desk.rests()
    run, looks = view.run, desk.context.stage._server.initial_camera
    assert run.meeting is not None
    arms = [arm.T_world_base.apply(arm.robot.chain.frames(q[None]).joint_positions[0])
            for arm, q in zip(run.cell.arms, run.postures, strict=True)]  # fmt: skip
    eye = np.array(looks.position), np.array(looks.look_at)
    assert not len(outside(eye, np.vstack([*arms, run.drawn_tips()]), desk.context.stage.eyes.aspect))


def test_an_arm_that_is_not_shown_does_not_move(in_the_cell):
    """The tool's tab stayed open to who looked at two robots, and its keys sent an arm about that nobody saw."""
    desk, _ = in_the_cell
    tool, load = desk.view("deciding"), desk.view("_weigh")
    until(lambda: tool._next_touch.proposal is not None, "the proposal")
    stood = desk.q.copy()
    play = desk.view("showing").showing.play
    for job in (tool._next_touch.go, tool._help, load._propose, lambda: play("touch")):
        desk.does(job)
        assert desk.drive.how == "standing" and "another arm is shown" in desk.said[1], job
    assert np.array_equal(desk.q, stood)
    step = desk.state.missing[0]
    desk.does(lambda: tool.recording.record(step))
    assert not desk.state.captures and "Nothing is recorded" in desk.said[1]
    desk.press("Close the cell")
    desk.moves(tool._next_touch.go)
    assert not np.array_equal(desk.q, stood)
