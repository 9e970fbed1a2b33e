"""Logs without torque: a servo's error, times its stiffness, stands for it."""

from __future__ import annotations

import re

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.ready import ready
from app.diagnosis.observations.joint_log import read_log
from app.errors import InputError
from app.kinematics import load_robot
from app.recordings import read_table
from tests.diagnosis.dynamic.simulator import Swing, measure, swing

STIFFNESS = np.array([900.0, 1500.0, 800.0, 200.0, 150.0, 120.0])  # Nm/rad


@pytest.fixture(scope="module")
def robot():
    return load_robot("ur10e")


def _log(path, run: Swing, header: str = "", commands: bool = True):
    names = [
        "t_s",
        *[f"q{j + 1}_rad" for j in range(6)],
        *[f"qc{j + 1}_rad" for j in range(6 if commands else 5)],
    ]
    values = np.concatenate([run.t[:, None], run.q, run.q + run.torque / STIFFNESS], axis=1)[:, : len(names)]
    with path.open("w") as file:
        file.write(f"# kind: motion\n{header}" + ",".join(names) + "\n")
        np.savetxt(file, values, fmt="%.8f", delimiter=",")
    return read_table(path)


def _run(robot) -> Swing:
    rng = np.random.default_rng(31)
    run = swing(robot, rng, samples=2000)
    run.torque += 2.0 * run.qd
    measure(run, rng, 0.02)
    return run


def test_the_stiffness_of_a_servo_follows_from_the_weight_it_carries(tmp_path, robot):
    run = _run(robot)
    log, _, without = ready(_log(tmp_path / "log.csv", run), robot)
    (said,) = [note for note in log.notes if "ESTIMATED" in note]
    found = np.array([float(v) for v in re.findall(r"([\d.e+]+) ± ", said)])
    np.testing.assert_allclose(found[1:4], STIFFNESS[1:4], rtol=0.05)
    np.testing.assert_allclose(log.y[:, 1:4], run.torque[:, 1:4], rtol=0.05, atol=0.5)
    assert "torque_constant" in without


def test_a_stated_stiffness_makes_torques_of_errors(tmp_path, robot):
    run = _run(robot)
    header = f"# servo_stiffness_Nm_per_rad: {STIFFNESS.tolist()}\n"
    log = read_log(_log(tmp_path / "log.csv", run, header), robot)
    assert not log.lacking
    np.testing.assert_allclose(log.y, run.torque, atol=1e-3)


def test_a_log_without_torque_and_with_commands_of_some_joints_only_is_refused(tmp_path, robot):
    with pytest.raises(InputError, match="nor commanded positions"):
        read_log(_log(tmp_path / "log.csv", _run(robot), commands=False), robot)


DAMPING = 0.02 * STIFFNESS  # Nm s/rad


def _servo(path, robot, header: str, late: float = 0.0):
    """A servo with damping; dry friction in joint 4, an armature in joint 6, commands that it hears `late` [s]."""
    rng = np.random.default_rng(33)
    run = swing(robot, rng, samples=2000)
    run.torque[:, 3] += 1.5 * np.sign(run.qd[:, 3])
    run.torque[:, 5] += 0.4 * run.qdd[:, 5]
    measure(run, rng, 0.02)
    run.torque += DAMPING * run.qd
    commanded = run.q + run.torque / STIFFNESS
    heard = np.stack([np.interp(run.t + late, run.t, c) for c in commanded.T], axis=1)
    run.torque = (heard - run.q) * STIFFNESS
    return _log(path, run, header)


def test_of_a_servo_friction_damping_and_armature_are_told_and_what_no_such_log_tells_is_a_set(
    tmp_path, robot
):
    header = f"# servo_stiffness_Nm_per_rad: {STIFFNESS.tolist()}\n# inertials: exact\n"
    found = diagnose(_servo(tmp_path / "log.csv", robot, header), robot)
    said = {(f.effect, f.where["joint"]): f for f in found.findings}
    for j in range(1, 7):
        viscous = said["viscous_friction", j]
        assert abs(viscous.parameters[0].value - DAMPING[j - 1]) < 4.5 * viscous.parameters[0].std
        assert [(a.effect, dict(a.where)) for a in viscous.alternatives] == [("delay", {"joint": j})]
    dry, armature = said["coulomb_friction", 4].parameters[0], said["rotor_inertia", 6].parameters[0]
    assert abs(dry.value - 1.5) < 4.5 * dry.std and abs(armature.value - 0.4) < 4.5 * armature.std
    assert not [f for f in found.findings if f.effect == "delay"]  # damping over stiffness is the lag
    (sag,) = [note for note in found.notes if "stand this far" in note]
    assert re.search(r"2: [\d.]+°", sag)


def test_commands_that_a_servo_hears_late_are_in_the_same_set_as_its_damping(tmp_path, robot):
    header = f"# servo_stiffness_Nm_per_rad: {STIFFNESS.tolist()}\n# inertials: exact\n"
    found = diagnose(_servo(tmp_path / "log.csv", robot, header, late=0.01), robot)
    for f in found.findings:
        if f.effect in ("viscous_friction", "delay") and "joint" in f.where:
            one_of = {f.effect, *(a.effect for a in f.alternatives)}
            assert {"viscous_friction", "delay"} <= one_of
    (second,) = [f for f in found.findings if f.effect == "viscous_friction" and f.where["joint"] == 2]
    assert second.parameters[0].value == pytest.approx(DAMPING[1] + 0.01 * STIFFNESS[1], rel=0.05)


def test_a_stiffness_told_by_the_weight_is_as_sure_as_the_weight_is(tmp_path, robot):
    for header, least, most in (("", 0.2, 0.3), ("# inertials: exact\n", 0.0, 0.06)):
        log, _, _ = ready(_log(tmp_path / "log.csv", _run(robot), header), robot)
        (said,) = [note for note in log.notes if "ESTIMATED" in note]
        found = [(float(v), float(s)) for v, s in re.findall(r"([\d.e+]+) ± ([\d.e+]+)", said)]
        # 95% of it, both written to the second digit of the half width
        assert all(1.96 * least < (half + 5) / (v - 5) and half / v < 1.96 * most for v, half in found[1:4])
