"""An exercise in the session: what begins it, what it may not be mixed with, and that it survives undo and replay."""

import numpy as np
import pytest

from app.errors import ActionRefusedError
from app.geometry import Pose
from app.session import Session, Store
from app.session.actions import (
    Begin,
    ChooseRobot,
    Delete,
    Finish,
    Move,
    Record,
    ReRecord,
    Tracked,
    TrackerNext,
    TrackerUndo,
    Undo,
)

TOOL = ("gun", tuple(Pose.of(position=np.array([0.0, 0.0, 0.3])).matrix.ravel()))
BEGIN = Begin("first_tool", 5, 1.0, "ur10e", "touch", 5, (TOOL,))


@pytest.fixture
def session():
    session = Session(robot="iiwa7")
    session.do(BEGIN)
    return session


def test_an_exercise_begins_with_its_own_arm_wizard_and_tools(session):
    state = session.state
    assert (state.robot, state.mode, state.touches, len(state.q)) == ("ur10e", "touch", 5, 6)
    assert state.tool.name == "gun" and state.tool.T_flange_tool.position[2] == 0.3
    assert state.running.begun == BEGIN and not state.captures


def test_what_was_recorded_stays_counted_however_often_it_is_taken_back(session):
    session.do(Record("touch1"))
    session.do(ReRecord("touch1"))
    session.do(Undo())
    session.do(Delete("touch1"))
    assert session.state.running.records == 2 and not session.state.captures


def test_undo_does_not_lead_out_of_an_exercise(session):
    with pytest.raises(ActionRefusedError):
        session.do(Undo())
    assert session.state.running is not None


@pytest.mark.parametrize("action", [BEGIN, ChooseRobot("ur5"), Tracked((0.0, 0.0, 0.0)), TrackerNext()])
def test_what_does_not_belong_into_an_exercise_is_refused(session, action):
    with pytest.raises(ActionRefusedError):
        session.do(action)


def test_finish_ends_it_once(session):
    assert session.do(Finish("nothing")).running is None
    with pytest.raises(ActionRefusedError):
        session.do(Finish("nothing"))


def test_a_tracker_exercise_keeps_its_procedure_in_the_journal(tmp_path):
    store = Store(tmp_path)
    session = store.create()
    session.do(Begin("first_tool", 5, 1.0, "ur10e", "touch", tracker="bare"))
    session.do(Tracked((1.0, 2.0, 3.0), sigma=1e-5))
    session.do(TrackerNext())
    session.do(Tracked((1.0, 2.0, 3.5), angle=0.2))
    session.do(Tracked((1.0, 2.0, 3.6), angle=0.3))
    session.do(TrackerUndo())
    session.do(Move(session.state.q, path=(session.state.q,)))
    wizard = store.state(session.name).running.wizard
    assert wizard.step.key == "1.axis1" and [r.angle for r in wizard.of("1.axis1")] == [0.2]
    with pytest.raises(ActionRefusedError, match="at least"):
        session.do(TrackerNext())
