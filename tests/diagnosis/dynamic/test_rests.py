"""A joint that stands still is held by friction that no motion tells: it is no event, and no load."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from app.kinematics.dynamics import inverse_dynamics
from tests.diagnosis.dynamic.simulator import Swing, add_load, measure, swing, write

HELD = 6.0  # Nm, at rest, of a joint whose dry friction is as large in motion
REST = 250  # rows at either end
DRY = 6.0  # Nm
RAMP = 0.5  # s, up to speed


def _resting(seed: int, mass: float = 0.0) -> Swing:
    """A log that stands still before and after its motion, its joints held by friction at rest as chance left them."""
    robot = load_robot("ur10e")
    rng = np.random.default_rng(seed)
    run = swing(robot, rng, samples=2500)
    t = np.arange(len(run.t) + 2 * REST) * 0.01
    path, pace = CubicSpline(run.t, run.q), _pace(t, float(run.t[-1]))
    q, slope, bend = (path(pace[0], order) for order in range(3))
    qd = slope * pace[1][:, None]
    qdd = bend * pace[1][:, None] ** 2 + slope * pace[2][:, None]
    out = Swing(robot, t, q, qd, qdd, inverse_dynamics(robot, q, qd, qdd))
    if mass:
        add_load(out, mass, (0.03, 0.1, 0.05))
    out.torque += DRY * np.tanh(out.qd / 0.002) + 4.0 * out.qd
    for rest in (slice(0, REST), slice(-REST, None)):
        out.torque[rest] += rng.uniform(-HELD, HELD, robot.joint_count)
    measure(out, rng, 0.05)
    return out


def _pace(t: np.ndarray, length: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """How far along its path the arm is, and the first two rates of that: at rest, up to speed, at rest again."""
    first, last = float(t[REST]), float(t[-REST - 1])
    rate = np.clip(np.minimum(t - first, last - t) / RAMP, 0.0, 1.0)
    change = np.where((rate > 0) & (rate < 1), np.sign(0.5 * (first + last) - t) / RAMP, 0.0)
    far = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(t))])
    scale = length / far[-1]
    return far * scale, rate * scale, change * scale


@pytest.fixture(scope="module")
def arm():
    return load_robot("ur10e")


def test_friction_at_rest_is_no_event_and_has_no_name(tmp_path, arm):
    found = diagnose(write(_resting(5), tmp_path / "log.csv", speed=True), arm)
    named = {f.effect for f in found.findings}
    assert not named & {"contact", "payload", "payload_change", "rest_friction", "joint_spring"}


def test_a_load_against_a_reference_stands_beside_friction_at_rest(tmp_path, arm):
    reference = write(_resting(6), tmp_path / "reference.csv", speed=True)
    found = diagnose(write(_resting(7, 2.0), tmp_path / "log.csv", speed=True), arm, reference=reference)
    (load,) = found.findings
    mass = load.parameters[0]
    assert load.effect == "payload"
    assert mass.value == pytest.approx(2.0, rel=0.03)
    assert abs(mass.value - 2.0) < 3 * mass.std
