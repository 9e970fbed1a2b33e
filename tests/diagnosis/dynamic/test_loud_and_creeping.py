"""What is no event though it stands out: a loud stretch, friction of joints that creep; and two hits in an arm that is
off everywhere, which are."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from app.kinematics.dynamics import gravity_and_wrench_columns, inertial_parameters, inverse_dynamics
from app.kinematics.regressor import torque_regressor
from tests.diagnosis.dynamic.simulator import Swing, measure, swing, write

EVENTS = {"contact", "payload_change"}


def _off_everywhere(arm: str, seed: int, pace: np.ndarray | None = None) -> tuple[Swing, np.random.Generator]:
    """An arm whose masses are off by a tenth, with friction in every joint.

    Args:
        pace: (2500,) of the usual speed, of each row.
    """
    robot, rng = load_robot(arm), np.random.default_rng(seed)
    run = swing(robot, rng, samples=2500)
    if pace is not None:
        passed = np.cumsum(pace) * 0.01
        q, qd, qdd = (
            np.stack([np.interp(passed, run.t, v[:, j]) for j in range(v.shape[1])], axis=1)
            for v in (run.q, run.qd, run.qdd)
        )
        qdd = qdd * pace[:, None] ** 2 + qd * np.gradient(pace, 0.01)[:, None]
        qd = qd * pace[:, None]
        run = Swing(robot, run.t, q, qd, qdd, inverse_dynamics(robot, q, qd, qdd))
    nominal = inertial_parameters(robot).reshape(-1, 10)
    off = nominal * rng.normal(0.0, 0.1, (len(nominal), 1))
    run.torque += torque_regressor(robot, run.q, run.qd, run.qdd) @ off.ravel()
    level = 0.15 * np.std(run.torque, axis=0) + 0.3
    run.torque += np.tanh(run.qd / 0.005) * level + 0.5 * run.qd * level
    return run, rng


def _events(run: Swing, tmp_path) -> list:
    found = diagnose(write(run, tmp_path / "log.csv"), run.robot)
    return [f for f in found.findings if f.effect in EVENTS]


@pytest.mark.parametrize(("arm", "seed"), [("ur10e", 1), ("iiwa7", 2), ("ur10e", 5)])
def test_a_loud_stretch_is_no_event(tmp_path, arm, seed):
    run, rng = _off_everywhere(arm, seed)
    run.torque[1000:1150] += rng.normal(0.0, 6.0, (150, run.robot.joint_count))
    measure(run, rng, 0.01)
    assert not _events(run, tmp_path)


@pytest.mark.parametrize(("arm", "seed"), [("ur10e", 1), ("iiwa7", 2)])
def test_two_hits_are_two_contacts_with_their_times(tmp_path, arm, seed):
    run, rng = _off_everywhere(arm, seed)
    _, levers = gravity_and_wrench_columns(run.robot, run.q)
    for since, force in ((7.0, [40.0, 20.0, 0.0]), (18.0, [0.0, -50.0, 30.0])):
        inside = (run.t >= since) & (run.t < since + 0.3)
        shape = np.sin(np.pi * (run.t - since) / 0.3) * inside
        run.torque += shape[:, None] * (levers[:, :, :3] @ np.array(force))
    measure(run, rng, 0.01)
    found = _events(run, tmp_path)
    assert [f.effect for f in found] == ["contact", "contact"]
    times = sorted((f.where["from_s"], f.where["to_s"]) for f in found)
    assert np.array(times) == pytest.approx(np.array([[7.0, 7.3], [18.0, 18.3]]), abs=0.02)


@pytest.mark.parametrize("seed", [3, 4])
def test_friction_that_grows_where_joints_creep_is_no_contact(tmp_path, seed):
    """A log that ends as programs end: all joints slow down together, creep, and friction is not what it was."""
    t = np.arange(2500) * 0.01
    run, rng = _off_everywhere("ur10e", seed, np.clip((24.0 - t) / 3.0, 0.02, 1.0))
    more = rng.uniform(-1.0, 1.0, 6) * np.std(run.torque, axis=0) * 0.15
    shape = (t > 23.7) * np.sin(np.pi * (t - 23.7) / 1.3)  # by then at a tenth of its speed
    run.torque += shape[:, None] * more
    measure(run, rng, 0.02)
    assert not _events(run, tmp_path)
