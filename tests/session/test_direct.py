"""A tool frame typed in, and files that hold joints and poses, as actions."""

import numpy as np
import pytest

from app.errors import ActionRefusedError
from app.geometry import CONVENTIONS, rot_y
from app.kinematics import load_robot
from app.session import Session, Store
from app.session.actions import Accept, Calculate, Cancel, ChooseMode, Enter, LoadPoints, Record, Undo
from app.session.points import load_action
from app.session.state import as_tuple
from app.units import deg, mm

PLACE = (0.1195, 0.0, 0.352)
TURN = rot_y(0.9477)
EXACT = 1e-12


@pytest.mark.parametrize("key", CONVENTIONS)
def test_a_tool_typed_in_any_convention_becomes_the_active_tool(key):
    session = Session()
    angles = as_tuple(CONVENTIONS[key].from_rotation(TURN))
    session.do(ChooseMode("direct"))
    session.do(Enter(PLACE, angles, key))
    state = session.do(Calculate())
    np.testing.assert_allclose(state.result.result.T_flange_tool.rotation, TURN, atol=1e-9)
    np.testing.assert_allclose(state.result.result.tool_point, PLACE, atol=EXACT)
    assert state.result.light.colour == "yellow" and "nothing was measured" in state.result.light.reason
    assert session.do(Accept("drawn")).tool.name == "drawn"
    assert session.do(Cancel()).entered is None


def test_typed_numbers_survive_a_replay_and_an_undo(tmp_path):
    store = Store(tmp_path)
    session = store.create(robot="ur10e")
    session.do(ChooseMode("direct"))
    session.do(Enter(PLACE, (0.0, 0.1, 0.0)))
    session.do(Enter((0.0, 0.0, 0.2), (0.0, 0.0, 0.0)))
    session.do(Calculate())
    state = store.state(session.name)
    assert state.entered.position == (0.0, 0.0, 0.2)
    session.do(Undo())
    assert session.do(Undo()).entered.position == PLACE


@pytest.mark.parametrize(
    "mode, action, words",
    [
        ("touch", Enter(PLACE, (0.0, 0.0, 0.0)), "choose it first"),
        ("direct", Enter((float("nan"), 0.0, 0.0), (0.0, 0.0, 0.0)), "3 finite numbers"),
        ("direct", Enter(PLACE, (0.0, 0.0), "quaternion"), "4 finite numbers"),
        ("direct", Enter(PLACE, (0.0, 0.0, 0.0), "ABC"), "unknown"),
        ("direct", Calculate(), "no numbers are typed in yet"),
    ],
)
def test_what_cannot_be_entered_is_refused_with_its_reason(mode, action, words):
    session = Session()
    session.do(ChooseMode(mode))
    with pytest.raises(ActionRefusedError, match=words):
        session.do(action)


def test_two_touches_are_too_few_by_name_and_say_what_to_do():
    session = Session()
    session.do(Record("touch1"))
    with pytest.raises(ActionRefusedError, match="at least 3 are needed") as caught:
        session.do(Calculate())
    assert caught.value.why == "too_few"


def test_a_reference_without_an_accepted_tool_says_so():
    session = Session()
    session.do(ChooseMode("reference", 1))
    for step in session.state.steps:
        session.do(Record(step.key))
    with pytest.raises(ActionRefusedError, match="teach and accept it first"):
        session.do(Calculate())


def file_with_both(tmp_path, wrong_row=None):
    robot, rng = load_robot("ur10e"), np.random.default_rng(3)
    lines = ["# robot: ur10e", "# angles: ZYX"]
    lines.append("role,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg," + ",".join(f"q{j}_deg" for j in range(1, 7)))
    for i in range(4):
        q = robot.home + rng.normal(0, 0.4, 6)
        pose = robot.forward(q)
        off = 50.0 if i == wrong_row else 0.0
        place = mm(pose.position) + np.array([off, 0.0, 0.0])
        angles = deg(CONVENTIONS["ZYX"].from_rotation(pose.rotation))
        lines.append("touch," + ",".join(f"{v:.6f}" for v in (*place, *angles, *deg(q))))
    path = tmp_path / "both.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_joints_beside_the_poses_of_a_file_come_along_and_are_compared(tmp_path):
    action = load_action(file_with_both(tmp_path, wrong_row=2))
    assert isinstance(action, LoadPoints) and action.robot == "ur10e" and len(action.joints) == 4
    session = Session(robot="ur10e")
    state = session.do(action)
    assert all(capture.q is not None for capture in state.captures.values())
    codes = [w.code for w in session.do(Calculate()).result.result.warnings]
    assert "joints_disagree" in codes
