"""Where structure is left, what predicts a log decides: never worse than all masses and friction by least squares."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import measure, swing, write


def _peer(run, rows: int) -> float:
    """Held-out error [Nm] of each joint's own least squares on what any arm has, five stretches left out in turn."""
    from app.kinematics.regressor import torque_regressor

    regressor = torque_regressor(run.robot, run.q, run.qd, run.qdd)
    fold, left = (np.arange(rows) * 20 // rows) % 5, np.zeros_like(run.torque)
    for j in range(run.q.shape[1]):
        own = [np.sign(run.qd[:, j]), run.qd[:, j], run.qdd[:, j], np.ones(rows)]
        X = np.column_stack([regressor[:, j, 10 * j :], *own])
        for k in range(5):
            out = fold == k
            left[out, j] = (
                run.torque[out, j] - X[out] @ np.linalg.lstsq(X[~out], run.torque[~out, j], rcond=1e-9)[0]
            )
    return float(np.sqrt(np.mean(left**2)))


@pytest.mark.parametrize("seed", [41, 42])
def test_a_log_of_a_law_nobody_knows_is_predicted_no_worse_than_by_least_squares(seed, tmp_path):
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=1500)
    run.torque *= 1.0 + rng.uniform(-0.15, 0.15, 6)
    for j in range(6):
        run.torque[:, j] += 5.0 * np.tanh(run.qd[:, j] / 0.005) + 3.0 * run.qd[:, j]
        run.torque[:, j] += 2.0 * np.sin(3.0 * run.q[:, j] * np.roll(run.q[:, j - 1], 9))  # in no library
    measure(run, rng, 0.005)
    found = diagnose(write(run, tmp_path / "log.csv", speed=True, digits=7), robot)
    assert found.verdict in ("partly", "unexplained")
    assert found.after.heldout_rms < 1.01 * _peer(run, 1500)
    assert found.families[-1].heldout_rms_after == pytest.approx(found.after.heldout_rms, rel=1e-12)
