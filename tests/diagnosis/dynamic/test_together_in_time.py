"""Several logs together: what changes from one to the next is a law along their common time."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose_together
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import add_load, measure, swing, write

SIGMAS = 4.5
LEVELS = np.array([6.0, 6.0, 4.0, 1.0, 1.0, 1.0])  # Nm
COLD, WARMS = 5.0, 40.0  # Nm of joint 2, s
PAUSE = 5.0  # s
SAMPLES = 1200


@pytest.fixture(scope="module")
def robot():
    return load_robot("ur10e")


def _logs(robot, folder, *, own_clock: bool = False, loaded_from: int = 9):
    """Three logs of 12 s, 5 s apart or one right after the other, in which the dry friction of joint 2 falls."""
    out = []
    for k in range(3):
        rng = np.random.default_rng(90 + k)
        run = swing(robot, rng, samples=SAMPLES)
        since = k * (SAMPLES / 100.0 + (0.0 if own_clock else PAUSE))
        run.torque += LEVELS * np.sign(run.qd)
        run.torque[:, 1] += COLD * np.exp(-(run.t + since) / WARMS) * np.sign(run.qd[:, 1])
        if k >= loaded_from:
            add_load(run, 2.0, [0.02, -0.01, 0.09])
        measure(run, rng, 0.02)
        run.t += 0.0 if own_clock else 700.0 + since
        out.append(write(run, folder / f"{k}.csv", digits=7))
    return out


def _warming(found):
    (finding,) = [f for f in found.findings if f.effect == "warmup_friction"]
    assert finding.where["joint"] == 2
    return {p.name: p for p in finding.parameters}


def test_friction_that_falls_from_log_to_log_is_one_law_along_their_time(tmp_path, robot):
    first, second, third = _logs(robot, tmp_path)
    found = diagnose_together([second, first, third], robot)  # their clocks tell the order
    values = _warming(found)
    assert abs(values["cold"].value - COLD) < SIGMAS * values["cold"].std
    assert abs(values["time_constant"].value - WARMS) < SIGMAS * values["time_constant"].std
    assert found.file == "0.csv + 1.csv + 2.csv" and found.samples == 3 * SAMPLES


def test_logs_whose_clocks_start_anew_stand_in_the_order_given(tmp_path, robot):
    found = diagnose_together(_logs(robot, tmp_path, own_clock=True), robot)
    assert _warming(found)["cold"].value == pytest.approx(COLD, rel=0.15)
    assert found.file == "0.csv + 1.csv + 2.csv"


def test_a_load_that_was_taken_up_between_two_logs_is_found_where_the_second_begins(tmp_path, robot):
    found = diagnose_together(_logs(robot, tmp_path, loaded_from=2), robot)
    (finding,) = [f for f in found.findings if f.effect == "payload_change"]
    mass = finding.parameters[0]
    assert abs(mass.value - 2.0) < SIGMAS * mass.std
    assert 29.0 - 0.2 < finding.where["from_s"] < 34.0 + 0.2
