"""Measured joint torques are brought to one sign before anything is searched with them."""

import numpy as np
import pytest

from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.observations.pose_reading import read_static
from app.kinematics import load_robot
from app.recordings import read_table
from tests.diagnosis.kinematic.simulating import poses, tracker_rows, write_tracker

TURNED = 1e-9


def recording(folder, sign):
    robot = load_robot("ur10e")
    rng = np.random.default_rng(3)
    q = rng.uniform(-1.0, 1.0, (12, 6))
    held = robot.gravity_torques(q)
    points = robot.chain.frames(q).flange_positions
    names = [f"q{j}_rad" for j in range(1, 7)] + ["x_m", "y_m", "z_m"] + [f"tau{j}_Nm" for j in range(1, 7)]
    rows = np.hstack([q, points, sign * held])
    path = folder / "run.csv"
    body = "\n".join(",".join(f"{v:.12g}" for v in row) for row in rows)
    path.write_text("# kind: tracker\n# robot: ur10e\n" + ",".join(names) + "\n" + body + "\n")
    return read_static(read_table(path), robot), held


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_torques_counted_either_way_become_holding_torques(tmp_path, sign):
    read, held = recording(tmp_path, sign)
    np.testing.assert_allclose(read.situation.torque, held, atol=TURNED)
    assert any("turned over" in note for note in read.notes) == (sign < 0)


def test_a_known_load_is_still_carried_when_a_convention_is_undone(arm, tmp_path):
    rng = np.random.default_rng(9)
    q = poses(arm, rng, 20)
    load = np.where(np.arange(20) % 2, 5.0, 0.0)
    table = write_tracker(
        tmp_path / "r.csv", arm, q, tracker_rows(arm, q, rng=rng), extra={"payload_kg": load}
    )
    recording = read_static(table, arm)
    again = recording.with_joints(arm, recording.q)
    assert np.allclose(again.situation.torque, recording.situation.torque)
    assert np.ptp(recording.situation.torque[:, 1] - situation_for(arm, q).torque[:, 1]) > 1.0
