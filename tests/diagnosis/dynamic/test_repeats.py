"""Noise from a repeat of the same trajectory; friction that follows a recorded temperature."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.models.dynamic.repeats import repeat_of
from app.kinematics import load_robot
from app.kinematics.dynamics import inverse_dynamics
from app.recordings import read_table
from tests.diagnosis.dynamic.simulator import Swing, measure, swing, write

ROWS = 1000


def _twice(seed):
    """A swing of ten seconds, run twice."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=ROWS)
    t = np.arange(2 * ROWS) / 100.0
    q, qd, qdd = (np.tile(x, (2, 1)) for x in (run.q, run.qd, run.qdd))
    return Swing(robot, t, q, qd, qdd, inverse_dynamics(robot, q, qd, qdd)), rng


def test_what_differs_between_two_runs_is_the_noise_whatever_both_leave_out(tmp_path):
    run, rng = _twice(41)
    # Nothing in the library is like it, and both runs have it.
    run.torque[:, 2] += 4.0 * np.sin(3 * run.q[:, 1]) * np.cos(2 * run.q[:, 3] + run.qd[:, 4])
    measure(run, rng, 0.02, 0.0)
    found = diagnose(write(run, tmp_path / "log.csv", digits=7), run.robot)
    assert found.noise.source == "repeats"
    assert found.noise.value == pytest.approx(np.sqrt(np.mean(run.noise**2)), rel=0.06)


def test_a_repeat_is_found_at_its_period_and_no_other():
    run, rng = _twice(42)
    noisy = run.q + rng.normal(0, 1e-4, run.q.shape)
    assert repeat_of(noisy, [slice(0, len(noisy))]) == ROWS
    once = swing(load_robot("ur10e"), rng, samples=ROWS).q
    assert repeat_of(once, [slice(0, ROWS)]) == 0


def test_friction_follows_the_recorded_temperature(tmp_path):
    robot, rng = load_robot("ur10e"), np.random.default_rng(43)
    run = swing(robot, rng, samples=3000)
    # Warm, cold again, warm: no function of time that falls.
    warm = 30.0 + 8.0 * np.sin(2 * np.pi * run.t / 60.0) ** 2
    run.torque[:, 2] += 0.6 * (45.0 - warm) * np.sign(run.qd[:, 2])
    measure(run, rng, 0.02, 0.0)
    path = tmp_path / "log.csv"
    write(run, path, digits=7)
    lines = path.read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    lines[head] += "," + ",".join(f"temperature{j}_degC" for j in range(1, 7))
    for i, value in enumerate(warm):
        lines[head + 1 + i] += "".join(f",{value + rng.normal(0, 0.05):.2f}" for _ in range(6))
    path.write_text("\n".join(lines) + "\n")
    found = diagnose(read_table(path), robot)
    (warming,) = [f for f in found.findings if f.effect == "warmup_friction"]
    assert warming.where == {"joint": 3, "driver": "temperature"}
    slope = next(p for p in warming.parameters if p.name == "per_degree")
    assert abs(slope.value - 0.6) < max(4.5 * slope.std, 0.03)
