"""Single effects are found at their place with honest uncertainty, clean logs stay clean."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import add_load, measure, swing, write

SIGMAS = 4.5  # an estimate lies within so many of its own standard deviations


def _robot():
    return load_robot("ur10e")


def _case(tmp_path, seed, change, *, noise=0.02, memory=0.0, samples=2000, speed=False, header=""):
    robot, rng = _robot(), np.random.default_rng(seed)
    run = swing(robot, rng, samples=samples)
    change(run)
    measure(run, rng, noise, memory)
    return diagnose(write(run, tmp_path / "log.csv", speed=speed, digits=7, header=header), robot)


def _on(joint, law):
    def change(run):
        j = joint - 1
        run.torque[:, j] += law(run.q[:, j], run.qd[:, j], run.qdd[:, j], run.t)

    return change


@pytest.mark.parametrize("seed", [11, 12, 13])
def test_a_clean_log_is_called_clean(tmp_path, seed):
    found = _case(tmp_path, seed, lambda run: None)
    assert found.verdict == "clean" and not found.findings


def test_noise_that_remembers_is_no_physics(tmp_path):
    found = _case(tmp_path, 14, lambda run: None, memory=0.9)
    assert not found.findings


LAWS = {
    "viscous_friction": (2, {"viscous": 4.0}, lambda q, v, a, t: 4.0 * v),
    "coulomb_friction": (4, {"coulomb": 0.9}, lambda q, v, a, t: 0.9 * np.sign(v)),
    "quadratic_friction": (3, {"quadratic": 3.0}, lambda q, v, a, t: 3.0 * v * np.abs(v)),
    "rotor_inertia": (6, {"inertia": 0.3}, lambda q, v, a, t: 0.3 * a),
    "friction_asymmetry": (5, {"offset": 0.4}, lambda q, v, a, t: 0.4 + 0.0 * v),
    "torque_ripple": (3, {"order": 9.0}, lambda q, v, a, t: 2.0 * np.sin(9.0 * q + 0.4)),
    "warmup_friction": (
        1,
        {"cold": 6.0, "time_constant": 7.0},
        lambda q, v, a, t: 6 * np.exp(-t / 7) * np.sign(v),
    ),
}


@pytest.mark.parametrize("effect", sorted(LAWS))
def test_a_law_on_one_joint_is_named_with_its_value(tmp_path, effect):
    joint, true, law = LAWS[effect]
    found = _case(tmp_path, 21, _on(joint, law))
    assert found.verdict == "named"
    assert [(f.effect, f.where["joint"]) for f in found.findings] == [(effect, joint)]
    values = {p.name: p for p in found.findings[0].parameters}
    for name, value in true.items():
        assert abs(values[name].value - value) < SIGMAS * values[name].std
    assert found.after.heldout_rms < found.before.heldout_rms
    finding = found.findings[0]
    assert finding.p_value <= 0.01 and finding.heldout_rms_with < finding.heldout_rms_without


def test_a_load_on_the_flange_is_weighed_and_its_alias_is_told(tmp_path):
    found = _case(tmp_path, 22, lambda run: add_load(run, 2.0, [0.02, -0.01, 0.09]))
    (finding,) = found.findings
    assert finding.effect == "payload"
    mass = next(p for p in finding.parameters if p.name == "mass")
    assert abs(mass.value - 2.0) < SIGMAS * mass.std
    assert any(a.effect == "link_inertia" for a in finding.alternatives)


def test_a_hand_that_the_arm_has_not_is_a_negative_load(tmp_path):
    found = _case(tmp_path, 61, lambda run: add_load(run, -0.8, [0.05, 0.03, 0.05]), samples=1500)
    (finding,) = found.findings
    assert finding.effect == "payload"
    mass = finding.parameters[0]
    assert abs(mass.value + 0.8) < SIGMAS * mass.std and "has not" in finding.sentence


def test_the_moment_a_load_is_taken_up_is_found(tmp_path):
    found = _case(tmp_path, 23, lambda run: add_load(run, 1.5, [0.0, 0.02, 0.08], since=8.2))
    (finding,) = found.findings
    assert finding.effect == "payload_change"
    assert abs(finding.where["from_s"] - 8.2) < 0.1


def test_late_torques_are_a_delay(tmp_path):
    def late(run):
        run.torque[:] = np.stack([np.interp(run.t - 0.02, run.t, c) for c in run.torque.T], axis=1)

    found = _case(tmp_path, 24, late)
    (finding,) = found.findings
    assert finding.effect == "delay"
    assert abs(finding.parameters[0].value - 0.02) < 1e-3


@pytest.mark.parametrize(
    "law",
    [
        lambda q, v, a, t: 4.0 * np.sin(2.3 * t),
        lambda q, v, a, t: 8.0 * np.exp(-(((q - np.median(q)) / (0.1 * np.ptp(q))) ** 2)),
    ],
    ids=["a swing in time", "a bump at one angle"],
)
def test_physics_outside_the_library_gets_no_name(tmp_path, law):
    found = _case(tmp_path, 25, _on(2, law), header="")
    assert not [f for f in found.findings if f.where.get("joint") == 2]
    assert found.verdict in ("unexplained", "partly")
    assert found.leftover.where.get("joint") == 2


def test_torques_in_shuffled_order_give_no_name(tmp_path):
    def shuffled(run):
        run.torque[:] = run.torque[np.random.default_rng(1).permutation(len(run.torque))]

    robot, rng = _robot(), np.random.default_rng(26)
    run = swing(robot, rng, samples=1200)
    shuffled(run)
    try:
        found = diagnose(write(run, tmp_path / "log.csv"), robot)
    except Exception as error:  # refused in one line is as good
        assert "\n" not in str(error)
    else:
        assert not found.findings


def test_the_evidence_is_there_to_be_drawn(tmp_path):
    found = _case(tmp_path, 27, _on(1, lambda q, v, a, t: 8.0 * v), samples=1200, speed=True)
    seen = found.evidence
    assert seen is not None
    assert seen.measured.shape == seen.before.shape == seen.after.shape == (1200, 6)
    assert seen.unit == "Nm" and len(seen.rows) == len(seen.kept) == 1200
    assert {"time [s]", "q1 [rad]", "qd1 [rad/s]"} <= set(seen.drivers)
    assert np.sqrt(np.mean(seen.after[:, 0] ** 2)) < 0.8 * np.sqrt(np.mean(seen.before[:, 0] ** 2))
    assert found.to_json()["format"] == "teachframe.diagnosis/1"


def test_only_what_changed_since_the_reference_is_named(tmp_path):
    robot, rng = _robot(), np.random.default_rng(28)
    tables = []
    for name, extra in (("good", 0.0), ("worn", 1.0)):
        run = swing(robot, rng, samples=2000)
        for j in range(6):
            run.torque[:, j] += (6, 6, 4, 1, 1, 1)[j] * np.sign(run.qd[:, j])
        run.torque[:, 3] += extra * run.qd[:, 3]
        measure(run, rng, 0.02)
        tables.append(write(run, tmp_path / f"{name}.csv", digits=7))
    found = diagnose(tables[1], robot, reference=tables[0])
    assert [(f.effect, f.where["joint"]) for f in found.findings] == [("viscous_friction", 4)]
    value = found.findings[0].parameters[0]
    assert abs(value.value - 1.0) < SIGMAS * value.std


def test_a_torque_recorded_by_a_wrong_factor_is_named_whatever_else_would_imitate_its_remainder(tmp_path):
    def change(run):
        run.torque[:, 3] *= 0.7

    found = _case(tmp_path, 31, change)
    (finding,) = found.findings
    assert (finding.effect, finding.where["joint"]) == ("torque_constant", 4)
    (scale,) = finding.parameters
    assert abs(scale.value + 0.3) < SIGMAS * scale.std
    assert found.verdict == "named"
