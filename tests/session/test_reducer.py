import math

import numpy as np
import pytest

from app.errors import ActionRefusedError
from app.session import reduce
from app.session.actions import (
    Accept,
    Calculate,
    Cancel,
    ChooseMethod,
    ChooseMode,
    ChooseRobot,
    Comment,
    Delete,
    Move,
    Record,
    Redo,
    ReRecord,
    SetUserFrame,
    Undo,
)
from app.session.report import report_text
from app.session.state import accepted, first_state
from tests.session.wizard import wizard_actions

TOOL_TOLERANCE = 1e-3  # m, for four touches of 0.15 mm


@pytest.fixture(scope="module")
def done():
    """The state after a whole wizard, and its world."""
    actions, world = wizard_actions()
    state = first_state()
    for action in actions:
        state = reduce(state, action)
    return state, world


def test_the_whole_wizard_runs_from_actions_alone_and_finds_the_tool(done):
    state, world = done
    found = state.result.result.tool_point
    assert np.linalg.norm(found - world.T_flange_tool_true.position) < TOOL_TOLERANCE
    assert len(state.captures) == 6 and not state.missing


def test_a_capture_is_the_flange_the_controller_shows(done):
    state, world = done
    for capture in state.ordered:
        assert np.array_equal(capture.T_base_flange.matrix, world.shown_flange(capture.q).matrix)


@pytest.mark.parametrize(
    "action, words",
    [
        (Record("touch9"), "no point called"),
        (Record("touch1"), "recorded already"),
        (Record("touch1", (0.0,)), "recorded already"),
        (Move((0.0, 0.0)), "6 joints, 2 were given"),
        (Move((math.nan, 0, 0, 0, 0, 0)), "joint 1 is not a number"),
        (Move((0, 0, 99.0, 0, 0, 0)), "joint 3 would be beyond its limit"),
        (ChooseMode("no_such"), "unknown wizard mode"),
        (ChooseMode("touch_zx", 2), "takes 3 to 7 touches, not 2"),
        (ChooseMethod("magic"), "unknown estimator"),
        (ChooseRobot("r2d2"), "unknown robot"),
        (Comment("nowhere", "hm"), "no point called"),
        (Accept("  "), "needs a name"),
        (Redo(), "nothing to redo"),
    ],
)
def test_what_the_state_does_not_allow_is_refused_in_words(done, action, words):
    state, _ = done
    before = (state.q, dict(state.captures), state.result, state.count)
    with pytest.raises(ActionRefusedError, match=words):
        reduce(state, action)
    assert (state.q, dict(state.captures), state.result, state.count) == before


def test_an_empty_list_refuses_what_needs_points():
    state = first_state("ur10e")
    for action, words in (
        (Calculate(), "not recorded yet: Touch 1"),
        (ReRecord("touch1"), "not recorded yet"),
        (Delete("touch1"), "not recorded yet"),
        (Accept("a"), "no result yet"),
        (Cancel(), "nothing is recorded"),
        (Undo(), "nothing to undo"),
    ):
        with pytest.raises(ActionRefusedError, match=words):
            reduce(state, action)


def test_touches_all_alike_are_refused_by_the_solver_in_its_own_words(done):
    state = first_state("ur10e")
    for step in state.steps:
        state = reduce(state, Record(step.key))
    with pytest.raises(ActionRefusedError):
        reduce(state, Calculate())
    assert state.result is None


def test_a_changed_point_takes_the_result_away_and_undo_brings_it_back(done):
    state, _ = done
    changed = reduce(state, Delete("touch2"))
    assert changed.result is None and "touch2" not in changed.captures
    back = reduce(changed, Undo())
    assert back.result is state.result and "touch2" in back.captures
    assert "touch2" not in reduce(back, Redo()).captures


def test_moving_does_not_disturb_undo_and_undo_does_not_move(done):
    state, _ = done
    moved = reduce(reduce(state, Delete("touch2")), Move((0.1, -1.2, 1.2, -1.2, -1.2, 0.3)))
    assert reduce(moved, Undo()).q == moved.q


def test_re_recording_replaces_one_point_only(done):
    state, _ = done
    again = reduce(state, ReRecord("touch2"))
    assert not np.array_equal(again.captures["touch2"].q, state.captures["touch2"].q)
    assert again.captures["touch1"] is state.captures["touch1"]


def test_accepting_keeps_the_tool_and_cancel_only_the_points(done):
    state, _ = done
    taken = reduce(state, Accept("torch"))
    assert accepted(taken) and taken.tool.name == "torch"
    empty = reduce(taken, Cancel())
    assert not empty.captures and empty.result is None and empty.tool.name == "torch"


def test_another_arm_begins_anew(done):
    state, _ = done
    other = reduce(state, ChooseRobot("jby50"))
    assert not other.captures and other.result is None and other.robot == "jby50"
    with pytest.raises(ActionRefusedError, match="nothing to undo"):
        reduce(other, Undo())


def test_another_mode_keeps_the_points_that_mean_the_same(done):
    state, _ = done
    fewer = reduce(state, ChooseMode("touch_zx", 3))
    assert set(fewer.captures) == {"touch1", "touch2", "x", "z"}  # touch 3 became the origin too


def test_undo_leaves_the_user_frame_and_another_arm_has_none_yet():
    state = reduce(first_state("ur10e"), Record("touch1"))
    state = reduce(reduce(state, SetUserFrame((0.1, 0.2, 0.3))), Undo())
    assert not state.captures and np.allclose(state.user_frame.position, [0.1, 0.2, 0.3])
    assert "user frame: 100.00, 200.00, 300.00 mm" in report_text(state)
    assert reduce(state, SetUserFrame()).user_frame is None
    assert reduce(state, ChooseRobot("iiwa7")).user_frame is None
    with pytest.raises(ActionRefusedError):
        reduce(state, SetUserFrame((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)))


def test_a_tool_active_while_points_are_recorded_is_named_and_the_light_stays_what_it_was(done):
    state, world = done
    first = state.result
    assert "tool_active" not in {w.code for w in first.result.warnings}
    state = reduce(reduce(state, Accept("torch 7")), Cancel())
    for action in wizard_actions(world=world)[0][1:]:
        state = reduce(state, action)
    (told,) = [w for w in state.result.result.warnings if w.code == "tool_active"]
    assert "torch 7" in told.message and told.note and not told.severe
    assert state.result.light.colour == first.light.colour and state.result.light.reason == first.light.reason
    assert np.array_equal(state.result.result.tool_point, first.result.tool_point)


def test_a_state_takes_no_field_that_it_has_not_and_its_points_cannot_be_written():
    state = first_state()
    with pytest.raises(TypeError, match="points"):
        state.but(points={})
    for name in ("captures", "comments"):
        with pytest.raises(TypeError):
            getattr(state.but(**{name: {}}), name)["touch1"] = ""
