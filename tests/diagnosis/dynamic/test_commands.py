"""The lag between command and answer."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from app.recordings import read_table
from tests.diagnosis.dynamic.simulator import measure, swing, write


def _with_commands(tmp_path, lag, *, noise=2e-5, seed=31):
    """A clean log, every joint `lag` (n,) [s] behind the commands beside it."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=2000)
    measure(run, rng, 0.02, 0.0)
    t, q = run.t.copy(), run.q.copy()
    path = tmp_path / "log.csv"
    write(run, path, digits=7)
    commanded = np.stack([np.interp(t + s, t, column) for s, column in zip(lag, q.T, strict=True)], axis=1)
    commanded += rng.normal(0, noise, commanded.shape)
    lines = path.read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    lines[head] += "," + ",".join(f"qc{j}_rad" for j in range(1, 7))
    for i, row in enumerate(commanded):
        lines[head + 1 + i] += "," + ",".join(f"{v:.7f}" for v in row)
    path.write_text("\n".join(lines) + "\n")
    return diagnose(read_table(path), robot)


def test_each_joints_lag_behind_its_command_is_told_with_its_uncertainty(tmp_path):
    true = np.array([0.02, 0.02, 0.013, 0.0, 0.05, 0.008])
    found = _with_commands(tmp_path, true)
    said = {f.where["joint"]: f.parameters[0] for f in found.findings}
    assert sorted(said) == [1, 2, 3, 5, 6] and {f.effect for f in found.findings} == {"delay"}
    for joint, parameter in said.items():
        assert abs(parameter.value - true[joint - 1]) < max(4.5 * parameter.std, 2e-4)
    assert found.verdict == "named"


def test_angles_ahead_of_their_command_are_told_as_that_and_not_as_a_lateness_below_zero(tmp_path):
    found = _with_commands(tmp_path, np.array([0.0, 0.0, -0.03, 0.0, 0.0, 0.0]))
    (only,) = found.findings
    assert only.parameters[0].value == pytest.approx(-0.03, abs=1e-3)
    assert "0.03 s ahead of its command" in only.sentence and "-0.0" not in only.sentence


@pytest.mark.parametrize("noise", [0.0, 1e-4])
def test_commands_that_are_followed_at_once_are_no_delay(tmp_path, noise):
    assert not _with_commands(tmp_path, np.zeros(6), noise=noise).findings
