"""From the command line: the flange is named and chosen, in every command that takes a robot."""

import json

import numpy as np
import pytest

from app.kinematics import load_robot
from tests.cli.running import assert_one_line, teachframe
from tests.kinematics.description.making import fixed, joint, line, written

TIP = np.array([0.01, 0.02, 0.1])
TOOL_TOLERANCE = 1e-3  # mm: joints are written with five decimals


@pytest.fixture
def arm(tmp_path):
    """Six joints, a tool point fixed beside a moving jaw."""
    jaw = joint("grip", "l6", "moving_jaw", xyz="0.02 0 0.03")
    return written(tmp_path, [*line(6), fixed("t", "l6", "tcp_link", "0 0 0.1"), jaw])


def points(arm, tmp_path, head="", columns=6, choice=""):
    """Touches of one point with TIP in the flange that `choice` names, found by turning about it."""
    robot, rng, rows = load_robot(f"{arm}{choice}"), np.random.default_rng(4), []
    start = rng.uniform(-1, 1, robot.joint_count)
    goal = robot.forward(start).apply(TIP[None])
    while len(rows) < 6:
        q = start + rng.uniform(-1, 1, robot.joint_count)
        for _ in range(30):
            frames, tip = robot.chain.frames(q), robot.forward(q).apply(TIP[None])
            q = q + np.linalg.pinv(robot.chain.jacobian_columns(frames, tip)[0], rcond=1e-2) @ (goal - tip)[0]
        if np.linalg.norm(robot.forward(q).apply(TIP[None]) - goal) < 1e-9:
            rows.append(np.degrees(q))
    path = tmp_path / "points.csv"
    names = ",".join(f"q{j}_deg" for j in range(1, columns + 1))
    body = "\n".join("touch," + ",".join(f"{v:.7f}" for v in row) for row in rows)
    path.write_text(f"# kind: points\n# robot: {arm.name}\n{head}role,{names}\n{body}\n")
    return path


def solved(path, *more):
    said = teachframe("solve", path, *more, "--json")
    assert said.code == 0, said.err
    return json.loads(said.out)


def test_the_jaw_is_left_out_and_the_flange_is_named(arm, tmp_path):
    path = points(arm, tmp_path)
    found = solved(path)
    assert found["flange"] == "tcp_link" and found["tool_mm"] == pytest.approx(1e3 * TIP, abs=TOOL_TOLERANCE)
    assert "arm: arm, 6 joints from base to its flange tcp_link" in teachframe("solve", path).out
    assert "法兰 tcp_link" in teachframe("solve", path, "--language", "zh").out


@pytest.mark.parametrize("by_header", [True, False])
def test_another_flange_is_chosen_by_an_option_or_by_the_header(arm, tmp_path, by_header):
    path = points(arm, tmp_path, "# flange: l6\n" if by_header else "", choice="#flange=l6")
    found = solved(path, *(() if by_header else ("--flange", "l6")))
    assert found["flange"] == "l6" and found["tool_mm"] == pytest.approx(1e3 * TIP, abs=TOOL_TOLERANCE)


def test_an_option_goes_before_the_header(arm, tmp_path):
    path = points(arm, tmp_path, "# flange: l6\n")
    assert solved(path, "--flange", "tcp_link")["tool_mm"] == pytest.approx(1e3 * TIP, abs=TOOL_TOLERANCE)
    assert_one_line(teachframe("solve", path, "--flange", "tool9"), "unknown link 'tool9'", "tcp_link")


def test_a_column_of_the_jaw_is_refused_with_the_arm_that_was_taken(arm, tmp_path):
    path = points(arm, tmp_path, choice="#flange=moving_jaw", columns=7)
    assert_one_line(
        teachframe("solve", path), "7 joint columns", "6 for arm from base to its flange tcp_link"
    )
    assert solved(path, "--flange", "moving_jaw")["flange"] == "moving_jaw"


def test_of_two_arms_a_chain_is_asked_for_and_simulated_and_read_back(tmp_path):
    arms = written(
        tmp_path, [*line(6, prefix="left_"), *line(6, prefix="right_"), fixed("t", "left_l6", "left_tool0")]
    )
    out = tmp_path / "log.csv"
    command = ("simulate", "--robot", arms, "--kind", "tracker", "--samples", "30")
    assert_one_line(teachframe(*command, out), "2 arms", "base..left_tool0", "base..right_l6", "--chain")
    said = teachframe(*command, "--chain", "base..left_tool0", out)
    assert said.code == 0 and "6 joints from base to its flange left_tool0" in said.err
    assert "# chain: base..left_tool0" in out.read_text()
    said = teachframe("diagnose", out, "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["flange"] == "left_tool0"


def test_a_base_from_poses_names_the_flange(tmp_path):
    out = tmp_path / "poses.csv"
    assert teachframe("simulate", "--robot", "ur5", "--kind", "tracker", "--samples", "30", out).code == 0
    text = teachframe("base", out)
    assert text.code == 0 and "6 joints from base to its flange flange" in text.out
    assert json.loads(teachframe("base", out, "--json").out)["robots"][0]["flange"] == "flange"


@pytest.mark.parametrize(
    "more, words",
    [
        (("--chain", "base"), ("BASE..TIP",)),
        (("--robot", "nothing.urdf"), ("unknown robot", "nothing.urdf")),
        (("--robot", "ur10e", "--calibration", "gone.conf"), ("gone.conf", "no such file")),
        (("--effort", "A", "--drive-gain", "0"), ("--drive-gain",)),
        (("--map", "q"), ("QUANTITY=NAME",)),
        (("--joints", "gone.csv"), ("gone.csv", "no such file")),
    ],
)
def test_a_choice_that_cannot_be_is_one_line(arm, tmp_path, more, words):
    path = points(arm, tmp_path)
    path.write_text(path.read_text().replace("kind: points", "kind: motion").replace("role,", "target,"))
    assert_one_line(teachframe("diagnose", path, *more), *words)
