"""What a whole recording's shape must not upset: several sessions, and joints that move one at a time."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.geometry import Pose, exp_so3
from app.kinematics import load_robot
from app.recordings import read_table
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_tracker

NOISE = 5e-5  # m
TOOL = np.array([0.02, -0.03, 0.11])


def diagnosed(path, q_true, q_shown, session):
    """A tracker recording of a UR10e: where it truly was, written down with what was shown."""
    robot = load_robot("ur10e")
    rng = np.random.default_rng(11)
    frames = robot.chain.frames(q_true)
    points = frames.flange_positions + frames.flange_rotations @ TOOL
    for number in np.unique(session):
        stand = Pose.of(exp_so3(rng.normal(0, 0.5, 3)), rng.normal(0, 1.0, 3))
        mine = session == number
        points[mine] = stand.apply(points[mine])
    points = points + rng.normal(0, NOISE, points.shape)
    lines = ["# kind: tracker", "# robot: ur10e", "# noise_mm: 0.05"]
    lines.append(",".join([f"q{j}_rad" for j in range(1, 7)] + ["x_m", "y_m", "z_m", "session"]))
    for q, p, s in zip(q_shown, points, session, strict=True):
        lines.append(",".join([*(f"{v:.9f}" for v in (*q, *p)), f"s{s}"]))
    path.write_text("\n".join(lines) + "\n")
    return diagnose(read_table(path), robot)


def test_next_poses_are_offered_for_a_recording_of_two_sessions(tmp_path):
    rng = np.random.default_rng(5)
    q = rng.uniform(-1.5, 1.5, (60, 6))
    true = q.copy()
    true[:, 3] += np.radians(0.25)
    found = diagnosed(tmp_path / "two.csv", true, q, np.repeat([0, 1], 30))
    assert found.findings[0].effect == "joint_zero"
    assert found.findings[0].alternatives
    assert found.next_poses
    assert load_robot("ur10e").within_limits(np.array(found.next_poses)).all()


def test_a_joint_that_counts_the_other_way_is_said_so_and_not_its_neighbours_zero(tmp_path):
    rng = np.random.default_rng(6)
    true = rng.uniform(-1.5, 1.5, (60, 6))
    shown = true.copy()
    shown[:, 4] = -true[:, 4]
    found = diagnosed(tmp_path / "turned.csv", true, shown, np.zeros(60, int))
    assert (found.findings[0].effect, found.findings[0].where["joint"]) == ("wrong_convention", 5)
    assert "the other way round" in found.findings[0].sentence


def test_a_forearm_shown_against_the_horizon_is_found_where_joints_move_one_at_a_time(tmp_path):
    q = np.zeros((48, 6)) + np.array([0.2, -1.2, 1.1, -0.4, 0.9, 0.3])
    for joint in range(6):
        q[8 * joint : 8 * joint + 8, joint] += np.linspace(-0.6, 0.6, 8)
    true = q.copy()
    true[:, 2] += q[:, 1]
    found = diagnosed(tmp_path / "single.csv", true, q, np.zeros(48, int))
    said = {(f.effect, f.where.get("joint"), f.where.get("source_joint")) for f in found.findings}
    assert ("wrong_convention", 3, 2) in said
    assert not any(effect == "joint_coupling" for effect, _, _ in said)


@pytest.mark.parametrize(("rows", "said"), [(1, "1 row(s) below"), (-2, "2 row(s) above")])
def test_measurements_that_stand_beside_other_joints_are_found_and_cost_those_rows_alone(
    tmp_path, rows, said
):
    q = np.random.default_rng(7).uniform(-1.5, 1.5, (150, 6))  # more rows than are tried at a time
    true = q[np.clip(np.arange(150) - rows, 0, 149)]
    true[:rows] += 0.3 * (
        rows > 0
    )  # what was measured before the first joints were written, or after the last
    true[rows:] += 0.3 * (rows < 0)
    found = diagnosed(tmp_path / "late.csv", true, q, np.zeros(150, int))
    assert [f.effect for f in found.findings] == ["wrong_convention"] and said in found.findings[0].sentence
    assert found.verdict == "named" and found.after.fit_rms < 1.2e3 * NOISE
    assert sorted(found.outliers) == ([5] if rows == 1 else [153, 154])  # lines of the file


def test_an_instrument_whose_frame_is_left_handed_is_said_so(tmp_path):
    q = np.random.default_rng(8).uniform(-1.5, 1.5, (60, 6))
    path = tmp_path / "left.csv"
    diagnosed(path, q, q, np.zeros(60, int))
    head, rows = path.read_text().split("session\n")
    turned = [line.split(",") for line in rows.splitlines()]
    mirrored = "\n".join(",".join([*r[:6], r[6], str(-float(r[7])), *r[8:]]) for r in turned)
    path.write_text(f"{head}session\n{mirrored}\n")
    found = diagnose(read_table(path), load_robot("ur10e"))
    assert [f.effect for f in found.findings] == ["wrong_convention"]
    assert "left-handed" in found.findings[0].sentence and found.after.fit_rms < 1.2e3 * NOISE


def test_a_change_in_one_of_two_sessions_is_told_with_its_row(arm, tmp_path):
    """Each session has a set-up of its own; what changes within one is in none of them."""
    rng = np.random.default_rng(311)
    q = poses(arm, rng, 90)
    moved = term("base_shift", {"body": "base", "from_row": 27}, [1e-3, 0.0, -8e-4], turning=0.0)
    points = tracker_rows(arm, q, (moved,), rng=rng)
    points[45:] = points[45:] @ exp_so3(np.array([0.1, -0.2, 0.3])).T + np.array([0.2, -0.1, 0.05])
    path = tmp_path / "two.csv"
    session = np.repeat([1.0, 2.0], 45)
    found = diagnose(write_tracker(path, arm, q, points, extra={"session": session}), arm)
    assert [(f.effect, f.where["from_row"]) for f in found.findings] == [("base_shift", 27)]
    assert found.verdict == "named"
