"""Friction laws that draw much the same curve of speed are chosen together."""

from __future__ import annotations

import numpy as np

from app.diagnosis.motion import diagnose
from app.kinematics import load_robot
from tests.diagnosis.motion.simulator import measure, swing, write

SIGMAS = 4.5
TRUE = {
    "coulomb_friction": {"coulomb": 3.0},
    "viscous_friction": {"viscous": 2.0},
    "stribeck_friction": {"stribeck": 6.0, "stribeck_speed": 0.25},
}


def test_a_bump_near_standstill_is_not_bent_to_mend_quadratic_friction(tmp_path):
    """Taken one by one, quadratic friction comes in before viscous and the bump's speed makes up for it."""
    robot, rng, joint = load_robot("ur10e"), np.random.default_rng(5), 3
    run = swing(robot, rng, samples=2500)
    v = run.qd[:, joint - 1]
    run.torque[:, joint - 1] += 2.0 * v + np.sign(v) * (3.0 + 6.0 * np.exp(-((v / 0.25) ** 2)))
    measure(run, rng, 0.03)
    found = diagnose(write(run, tmp_path / "log.csv", digits=7), robot)
    assert {f.effect: f.where["joint"] for f in found.findings} == dict.fromkeys(TRUE, joint)
    for finding in found.findings:
        for p in finding.parameters:
            assert abs(p.value - TRUE[finding.effect][p.name]) < SIGMAS * p.std, p
