"""What happens once in a log, a short push or a load held for a while, and a clock that was set back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.models.dynamic.noise import without_bursts
from app.diagnosis.observations.clock import going_on
from app.kinematics import load_robot
from app.kinematics.dynamics import gravity_and_wrench_columns
from tests.diagnosis.dynamic.simulator import Swing, add_load, measure, swing, write

EXACT = "# inertials: exact\n"


@pytest.fixture(scope="module")
def arm():
    return load_robot("ur10e")


def test_a_push_of_a_quarter_of_a_second_is_found_with_its_force(tmp_path, arm):
    rng = np.random.default_rng(41)
    run = swing(arm, rng, samples=2500)
    inside = (run.t >= 12.0) & (run.t < 12.25)
    _, levers = gravity_and_wrench_columns(arm, run.q)
    shape = np.sin(np.pi * (run.t - 12.0) / 0.25) * inside
    run.torque += shape[:, None] * (levers[:, :, :3] @ np.array([0.0, 80.0, 20.0]))
    measure(run, rng, 0.01)
    found = diagnose(write(run, tmp_path / "log.csv", speed=True, header=EXACT), arm)
    assert [f.effect for f in found.findings] == ["contact"]
    (contact,) = found.findings
    values = {p.name: p.value for p in contact.parameters}
    assert values["force_y"] == pytest.approx(80.0, rel=0.1)
    assert contact.where["from_s"] == pytest.approx(12.0, abs=0.03)
    assert contact.where["to_s"] == pytest.approx(12.25, abs=0.03)


def test_a_load_that_is_held_twice_for_a_while_is_no_contact(tmp_path, arm):
    rng = np.random.default_rng(42)
    run = swing(arm, rng, samples=3000)
    for mass, since in ((4.0, 6.0), (-4.0, 12.0), (4.0, 18.0), (-4.0, 24.0)):
        add_load(run, mass, (0.0, 0.0, 0.05), since)
    measure(run, rng, 0.01)
    found = diagnose(write(run, tmp_path / "log.csv", speed=True, header=EXACT), arm)
    assert {f.effect for f in found.findings} == {"payload_change"}
    for f in found.findings:
        mass = f.parameters[0]
        assert abs(abs(mass.value) - 4.0) < max(3.0 * mass.std, 0.05)
    times = sorted(f.where[k] for f in found.findings for k in ("from_s", "to_s") if k in f.where)
    assert times == pytest.approx([6.0, 12.0, 18.0, 24.0], abs=0.05)


def _set_back(run: Swing, row: int, seconds: float) -> Swing:
    t = run.t.copy()
    t[row:] -= seconds
    return replace(run, t=t)


def test_a_clock_that_was_set_back_leaves_a_clean_log_clean(tmp_path, arm):
    rng = np.random.default_rng(43)
    run = swing(arm, rng, samples=2400)
    measure(run, rng, 0.02)
    table = write(_set_back(run, 1300, 4.0), tmp_path / "log.csv", speed=True, header=EXACT)
    found = diagnose(table, arm)
    assert found.verdict == "clean" and not found.outliers
    assert any("set back" in str(line) for line in found.notes)


def test_single_wrong_times_are_not_taken_for_a_clock_that_was_set_back():
    t = np.arange(500) * 0.01
    t[[200, 300]] = [0.5, 77.0]
    again, count = going_on(t)
    assert count == 0 and again is t


def test_a_burst_is_no_noise_and_a_loud_half_is():
    rng = np.random.default_rng(44)
    quiet = rng.normal(size=3000)
    burst = quiet.copy()
    burst[1000:1030] += 100.0
    assert np.std(without_bursts(burst)) < 1.1
    half = quiet * np.where(np.arange(3000) < 1500, 100.0, 1.0)
    assert np.array_equal(without_bursts(half), half)


def test_a_curve_that_no_law_is_and_several_imitate_is_never_clean(tmp_path, arm):
    rng = np.random.default_rng(45)
    run = swing(arm, rng, samples=2500)
    x = run.q[:, 3] / (0.5 * np.ptp(run.q[:, 3]))
    run.torque[:, 3] += 1.0 * (0.3 * x + 0.7 * x**3)
    measure(run, rng, 0.02)
    found = diagnose(write(run, tmp_path / "log.csv", speed=True, header=EXACT), arm)
    assert found.verdict != "clean"
    if found.verdict == "unexplained":
        assert found.leftover.where["joint"] == 4
