import msgspec
import numpy as np
import pytest

from app import resources
from app.calibration.as_json import solved_json
from app.calibration.solving import solve_file
from app.calibration.text import page
from app.errors import ActionRefusedError, InputError
from app.session import Store, reduce
from app.session.actions import Calculate, LoadPoints
from app.session.points import load_action
from app.session.report import report_json, report_text
from app.session.state import first_state

PAPER = resources.STATIC / "samples" / "xiong2012_table1.csv"


@pytest.fixture
def loaded():
    return reduce(first_state("jby50"), load_action(PAPER, method="pairwise"))


def test_a_loaded_file_gives_the_same_text_and_json_as_solve(loaded):
    state = reduce(loaded, Calculate())
    solved = solve_file(PAPER, method="pairwise", orientation="zx")
    assert report_text(state) == page(solved)
    assert report_json(state) == msgspec.json.encode(solved_json(solved)).decode()


def test_a_session_with_loaded_points_replays_without_the_file(tmp_path):
    file = tmp_path / "points.csv"
    file.write_bytes(PAPER.read_bytes())
    store = Store(tmp_path)
    session = store.create(robot="jby50")
    session.do(load_action(file))
    session.do(Calculate())
    file.unlink()
    state = store.state(session.name)
    assert np.array_equal(state.result.result.tool_point, session.state.result.result.tool_point)
    assert report_text(state) == report_text(session.state)


def test_the_action_survives_json(loaded):
    action = load_action(PAPER)
    assert msgspec.json.decode(msgspec.json.encode(action), type=LoadPoints) == action


def test_points_of_joints_belong_to_their_arm(tmp_path):
    file = tmp_path / "joints.csv"
    rows = "\n".join(
        f"{role},{q}"
        for role, q in (
            ("touch", "0,-60,60,-90,-90,0"),
            ("touch", "10,-60,60,-60,-90,30"),
            ("touch", "-10,-70,60,-90,-60,10"),
        )
    )
    header = "role," + ",".join(f"q{j}_deg" for j in range(1, 7))
    file.write_text(f"# kind: points\n# robot: ur10e\n{header}\n{rows}\n")
    action = load_action(file)
    assert action.robot == "ur10e" and action.mode == "touch"
    state = reduce(first_state("ur10e"), action)
    assert all(c.q is not None for c in state.ordered)
    with pytest.raises(ActionRefusedError, match="another arm"):
        reduce(first_state("jby50"), action)


def test_a_file_no_mode_asks_for_is_said(tmp_path):
    file = tmp_path / "empty.csv"
    file.write_bytes(b"")
    with pytest.raises(InputError):
        load_action(file)


def test_a_session_without_a_result_says_what_is_missing():
    assert "not recorded: Touch 1" in report_text(first_state("ur10e"))
    assert report_json(first_state("ur10e")) is None
