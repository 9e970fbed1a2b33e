"""What a whole recording's shape must not upset: several sessions, and joints that move one at a time."""

import numpy as np

from app.diagnosis.kinematic.diagnose import diagnose
from app.geometry import Pose, exp_so3
from app.kinematics import load_robot
from app.recordings import read_table

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
