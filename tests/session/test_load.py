"""The lesson of load data in the session: poses and what the run found are in the journal, and bad ones are refused."""

import pytest

from app.errors import ActionRefusedError
from app.session import Store, reduce, replay
from app.session.actions import Begin, ChooseRobot, Finish, HangLoad, Undo, WeighAt, Weighed
from app.session.report import report_text
from app.session.state import as_tuple, first_state
from app.session.steps.load import POSES
from app.session.store import find_recorded

FOUND = Weighed(1.5, (0.01, 0.02, 0.05), 0.03, (0.001, 0.002, 0.003))


def poses(state):
    return [as_tuple(state.model.home + 0.1 * number) for number in range(POSES)]


def weighed(state):
    state = reduce(state, HangLoad(7))
    for number, q in enumerate(poses(state)):
        state = reduce(state, WeighAt(number, q))
    return reduce(state, FOUND)


def test_a_restart_brings_back_the_load_the_poses_and_what_was_found(tmp_path):
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    session.do(HangLoad(7))
    for number, q in enumerate(poses(session.state)):
        session.do(WeighAt(number, q))
    session.close()
    session = store.open(session.name)
    assert session.state.load.seed == 7
    assert dict(session.state.load.poses) == dict(enumerate(poses(session.state)))
    session.do(FOUND)
    session.close()
    again = replay(find_recorded(session.name, tmp_path, None))
    assert again.load.found == FOUND
    assert "1.500 ± 0.030 kg, centre 10.0, 20.0, 50.0 mm ± 1.0, 2.0, 3.0 mm" in report_text(again)


def test_another_pose_makes_what_was_found_void_and_another_load_all_of_it():
    state = weighed(first_state("ur10e"))
    assert reduce(state, WeighAt(2)).load.found is None and 2 not in reduce(state, WeighAt(2)).load.poses
    assert reduce(state, WeighAt(2, as_tuple(state.model.home))).load.found is None
    other = reduce(state, HangLoad(8)).load
    assert other.seed == 8 and not other.poses and other.found is None


def test_undo_leaves_the_load_alone_and_another_arm_has_none():
    state = weighed(first_state("ur10e"))
    with pytest.raises(ActionRefusedError):
        reduce(state, Undo())
    assert reduce(state, ChooseRobot("irb120")).load is None


@pytest.mark.parametrize(
    "action",
    [
        WeighAt(POSES, (0.0,) * 6),
        WeighAt(-1, (0.0,) * 6),
        WeighAt(0, (0.0,) * 5),
        WeighAt(0, (float("nan"),) * 6),
        WeighAt(0, (100.0,) * 6),
        FOUND,
        Weighed(float("inf"), (0.0, 0.0, 0.0), 0.0, (0.0, 0.0, 0.0)),
        HangLoad(-1),
    ],
    ids=str,
)
def test_what_cannot_be_is_refused_and_changes_nothing(action):
    state = reduce(first_state("ur10e"), HangLoad(7))
    with pytest.raises(ActionRefusedError):
        reduce(state, action)


def test_nothing_is_weighed_where_nothing_hangs_and_no_load_is_hung_in_an_exercise():
    state = first_state("ur10e")
    for action in (WeighAt(0, as_tuple(state.model.home)), FOUND):
        with pytest.raises(ActionRefusedError):
            reduce(state, action)
    running = reduce(state, Begin("first_tool", 1, 0.0, "ur10e", "touch"))
    with pytest.raises(ActionRefusedError):
        reduce(running, HangLoad(1))
    assert reduce(reduce(running, Finish(given_up=True)), HangLoad(1)).load is not None
