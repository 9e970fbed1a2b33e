"""A long log is averaged over short windows: nothing that is said of it may depend on that."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import measure, swing, write


@pytest.mark.parametrize(
    ("samples", "rate", "window"), [(3000, 100.0, 1), (6500, 200.0, 2), (12_000, 400.0, 4)]
)
def test_error_and_values_are_those_of_single_samples(tmp_path, samples, rate, window):
    robot, rng = load_robot("ur10e"), np.random.default_rng(61)
    run = swing(robot, rng, samples=samples, rate=rate)
    run.torque[:, 1] += 6.0 * np.sign(run.qd[:, 1])
    run.torque[:, 2] += 2.0 * np.sin(9.0 * run.q[:, 2] + 0.4)
    measure(run, rng, 0.02, 0.0)
    found = diagnose(write(run, tmp_path / "log.csv", digits=7), robot)
    assert {(f.effect, f.where["joint"]) for f in found.findings} == {
        ("coulomb_friction", 2),
        ("torque_ripple", 3),
    }
    averaged = [note for note in found.notes if "averaged over windows" in note]
    assert averaged == (
        [] if window == 1 else [f"torques and columns were averaged over windows of {window} samples"]
    )
    noise = float(np.sqrt(np.mean(run.noise**2)))
    assert found.after.fit_rms == pytest.approx(noise, rel=0.04)
    assert found.after.heldout_rms == pytest.approx(noise, rel=0.05)
    coulomb = next(f for f in found.findings if f.effect == "coulomb_friction").parameters[0]
    assert abs(coulomb.value - 6.0) < 4.5 * coulomb.std
