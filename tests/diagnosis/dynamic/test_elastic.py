"""A joint that twists is named with stiffness and damping; nothing else that moves torques about is taken for one."""

from __future__ import annotations

import re
from dataclasses import replace

import msgspec
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.judging import judged
from app.diagnosis.dynamic.shapes import STEP, Tangent
from app.diagnosis.effects.effect import Place
from app.diagnosis.export.carrying import carried
from app.diagnosis.model import SavedModel
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.samples import take
from app.diagnosis.models.dynamic.smoothing import motion_of
from app.diagnosis.models.dynamic.two_mass import Behind, twist
from app.diagnosis.observations.joint_log import read_log
from app.kinematics import load_robot
from app.proof.generator.effects.motion.elastic_joint import own_inertia
from app.proof.generator.effects.term import Request
from app.proof.generator.motion.making import make_motion
from app.proof.generator.motion.writing import write_motion
from app.proof.generator.urdf_writing import write_arm
from app.recordings import read_table
from tests.diagnosis.dynamic.elastic import PLAN, elastic, made, pendulum, thinned, told
from tests.diagnosis.dynamic.simulator import measure, swing, write

NEAR = 0.1  # relative
SIGMAS = 4.5


@pytest.mark.parametrize(
    ("name", "joint", "seed"),
    [("pendulum", 1, 501), ("ur10e", 2, 502), ("ur10e", 3, 503), ("iiwa14", 2, 504), ("panda", 4, 505)],
)
def test_stiffness_and_damping_are_found(name, joint, seed, tmp_path):
    log = made(name, tmp_path, seed, Request("elastic_joint", {"joint": joint}))
    found = told(name, tmp_path, log)
    assert [f.where["joint"] for f in elastic(found)] == [joint]
    assert found.findings[0].effect == "elastic_joint"
    values = {p.name: p for p in elastic(found)[0].parameters}
    true = log.terms[0].parameters
    assert values["stiffness"].value == pytest.approx(true["stiffness"], rel=NEAR)
    assert abs(values["damping"].value - true["damping"]) < max(
        NEAR * true["damping"], SIGMAS * values["damping"].std
    )
    assert 0.0 < values["stiffness"].std < NEAR * true["stiffness"]
    (rings,) = re.findall(r"rings at ([0-9.]+) ", elastic(found)[0].sentence)
    turn = np.sqrt(true["stiffness"] / values["inertia"].value)
    assert float(rings) == pytest.approx(turn / (2.0 * np.pi), rel=0.5 * NEAR)
    noise = float(np.sqrt(np.mean(log.sigma**2)))
    excess = [quality.heldout_rms**2 - noise**2 for quality in (found.before, found.after)]
    assert excess[1] < 0.02 * excess[0]


def test_the_saved_model_gives_what_was_said_and_an_exporter_says_what_is_lost(tmp_path):
    log = made("ur10e", tmp_path, 511, Request("elastic_joint", {"joint": 2}))
    found = told("ur10e", tmp_path, log)
    model = msgspec.convert(dict(found.model), SavedModel)
    assert "elastic_joint" in [e.effect for e in model.effects]
    robot = load_robot("ur10e")
    _, after = judged(read_table(tmp_path / "log.csv"), robot, model).qualities
    assert after.fit_rms == pytest.approx(found.after.fit_rms, rel=1e-9)
    assert after.heldout_rms == pytest.approx(found.after.heldout_rms, rel=1e-9)
    (lost,) = [left for left in carried(robot, model).left if left.what.startswith("elastic_joint")]
    assert "stiffness" in lost.size and "rigid" in lost.why


def test_it_is_told_from_a_late_torque(tmp_path):
    found = told("ur10e", tmp_path, made("ur10e", tmp_path, 521, Request("delay", sizes={"delay": 0.02})))
    assert not elastic(found) and "delay" in [f.effect for f in found.findings]


@pytest.mark.parametrize("ratio", [0.7, 1.0])
def test_it_is_told_from_a_torque_column_that_was_filtered(ratio, tmp_path):
    """A second-order low-pass, as drives filter: the same in every joint, and with no more than one swing."""
    from scipy.signal import lfilter

    log = made("ur10e", tmp_path, 522)
    step, turn = 1.0 / PLAN.rate, 2.0 * np.pi * 9.0
    pole = np.exp((-ratio + np.sqrt(complex(ratio**2 - 1.0))) * turn * step)
    other = np.exp((-ratio - np.sqrt(complex(ratio**2 - 1.0))) * turn * step)
    poles = np.real(np.poly([pole, other]))
    start = log.torque[0]
    smooth = lfilter([poles.sum()], poles, log.torque - start, axis=0) + start
    assert not elastic(told("ur10e", tmp_path, replace(log, torque=smooth)))


@pytest.mark.parametrize("effect", ["torque_ripple", "rotor_inertia", "coulomb_friction", "joint_spring"])
def test_other_laws_keep_their_name_on_motions_that_would_make_a_spring_ring(effect, tmp_path):
    found = told("panda", tmp_path, made("panda", tmp_path, 531, Request(effect, {"joint": 2})))
    assert (effect, 2) in [(f.effect, f.where.get("joint")) for f in found.findings] and not elastic(found)


def test_nothing_is_said_below_six_samples_in_a_period(tmp_path):
    log = made("ur10e", tmp_path, 502, Request("elastic_joint", {"joint": 2}))
    assert elastic(told("ur10e", tmp_path, log))
    assert not elastic(told("ur10e", tmp_path, thinned(log, 5)))


def test_nothing_is_said_where_the_motion_lets_nothing_ring(tmp_path):
    robot, rng = load_robot("ur10e"), np.random.default_rng(541)
    run = swing(robot, rng, samples=2000)
    t, rigid = run.t, run.torque[:, 1].copy()
    behind = Behind(rigid, np.full(len(t), 5.0), np.zeros(len(t)))
    run.torque[:, 1] -= 5.0 * twist(t, behind, 5.0 * (2 * np.pi * 9.0) ** 2, 20.0, [slice(0, len(t))])[1]
    measure(run, rng, 0.01)
    write(run, tmp_path / "log.csv", digits=7)

    assert not elastic(diagnose(read_table(tmp_path / "log.csv"), robot))


def test_the_twist_is_the_solution_of_its_equation():
    t = np.arange(0.0, 6.0, 0.01)
    rigid = 3.0 * np.sin(2.0 * t) + 2.0 * np.clip((t - 2.0) / 0.05, 0.0, 1.0)
    inertia, weight = 0.8 + 0.3 * np.sin(t), 20.0 * np.cos(t)
    stiffness, damping = 800.0, 3.0

    def rate(at, x):
        load, mass, more = (np.interp(at, t, v) for v in (rigid, inertia, weight))
        return [x[1], (load - damping * x[1] - (stiffness + more) * x[0]) / mass]

    x, push = twist(t, Behind(rigid, inertia, weight), stiffness, damping, [slice(0, 300), slice(300, 600)])
    again = twist(
        t[300:], Behind(rigid[300:], inertia[300:], weight[300:]), stiffness, damping, [slice(0, 300)]
    )
    np.testing.assert_allclose([x[300:], push[300:]], again)  # a gap: it begins anew
    slope = (rigid[1] - rigid[0]) / 0.01
    start = [(rigid[0] - slope * damping / 810.0) / 820.0, slope / 820.0]
    exact = solve_ivp(rate, (0.0, 2.99), start, t_eval=t[:300], rtol=1e-9, atol=1e-12, max_step=2e-3).y[0]
    assert np.abs(x[:300] - exact)[20:].max() < 1e-3 * np.abs(exact).max()
    with pytest.raises(ValueError, match="stiffness"):
        twist(t, Behind(rigid, inertia, weight), 10.0, damping, [slice(0, 600)])


@pytest.mark.parametrize("damping", [0.0, 2.0 * np.sqrt(800.0 * 0.5), 600.0])
def test_a_long_gap_is_no_matter_however_heavily_it_is_damped(damping):
    t = np.concatenate([np.arange(300), np.arange(300) + 60_000]) * 0.01
    behind = Behind(np.sin(t), np.full(600, 0.5), np.zeros(600))
    x, push = twist(t, behind, 800.0, damping, [slice(0, 300), slice(300, 600)])
    assert np.isfinite(push).all() and np.abs(x).max() < 2.0 / 800.0


def test_columns_are_the_torque_of_the_saved_law_and_its_slopes_are_those_of_the_torque(tmp_path):
    robot = load_robot("ur10e")
    rng = np.random.default_rng(551)
    run = swing(robot, rng, samples=600)
    measure(run, rng, 0.01)
    log = read_log(write(run, tmp_path / "log.csv", speed=True), robot)
    state = take(log, robot, motion_of(log, robot), as_given(6)).state
    law = laws()["elastic_joint"]
    place = Place({"joint": 2}, {"stiffness": 9000.0, "damping": 30.0, "inertia": 5.0})
    values = np.array([0.9])
    columns, exact = law.columns(state, place), law.torque(state, place.where, law.saved(place, values))
    assert set(exact) == set(range(6)) and np.abs(exact[1]).max() > 0.1
    for joint, torque in exact.items():
        np.testing.assert_allclose(torque, columns[joint] @ values)
    for name in ("stiffness", "damping"):
        slope = Tangent(law, place, name, values).columns(state, place)[1][:, 0]
        ends = [
            law.torque(
                state, place.where, {**place.fixed, "share": 0.9, name: place.fixed[name] * (1.0 + step)}
            )[1]
            for step in (-0.5 * STEP, 0.5 * STEP)
        ]
        assert np.abs(slope - (ends[1] - ends[0]) / STEP).max() < 1e-3 * np.abs(slope).max()


def _both_sides(tmp_path, seed, stiffness, damping, *, noise):
    """A log with the link's angles, and the motor's of joint 3 beside them; the load twists what is between."""
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=1500)
    load = run.torque[:, 2]
    apart = np.full(len(load), load[0] / stiffness)
    for k in range(1, len(load)):  # stiffness x + damping x' = load, backward differences
        apart[k] = (load[k] + damping / 0.01 * apart[k - 1]) / (stiffness + damping / 0.01)
    measure(run, rng, 0.01)
    motor = run.q[:, 2] + apart + 2e-3 + noise * rng.normal(size=len(load))
    table = write(run, tmp_path / "log.csv", digits=7)
    lines = (tmp_path / "log.csv").read_text().splitlines()
    head = next(k for k, line in enumerate(lines) if line.startswith("t_s"))
    lines[head] += ",theta3_rad"
    lines[head + 1 :] = [f"{a},{b:.7f}" for a, b in zip(lines[head + 1 :], motor, strict=True)]
    (tmp_path / "log.csv").write_text("\n".join(lines) + "\n")
    return robot, read_table(table.path)


@pytest.mark.parametrize("seed", [561, 562])
def test_where_motor_and_link_are_both_recorded_their_difference_tells_the_spring(seed, tmp_path):
    robot, table = _both_sides(tmp_path, seed, 6000.0, 60.0, noise=2e-4)
    found = diagnose(table, robot)
    (one,) = elastic(found)
    assert one.where == {"joint": 3, "driver": "gravity_torque"} and one.heldout_unit == "rad"
    values = {p.name: p for p in one.parameters}
    for name, true in (("stiffness", 6000.0), ("damping", 60.0)):
        assert abs(values[name].value - true) < SIGMAS * values[name].std + 0.02 * true
    assert values["stiffness"].std < NEAR * 6000.0
    assert one.heldout_rms_with == pytest.approx(2e-4, rel=0.1) and one.heldout_rms_without > 5e-4
    model = msgspec.convert(dict(found.model), SavedModel)
    assert "elastic_joint" in [e.effect for e in model.effects]
    _, after = judged(table, robot, model).qualities
    assert after.fit_rms == pytest.approx(found.after.fit_rms, rel=1e-9)


def test_a_motor_that_only_reads_otherwise_is_no_spring(tmp_path):
    robot, table = _both_sides(tmp_path, 563, 1e7, 0.0, noise=2e-4)
    assert not elastic(diagnose(table, robot))


def test_without_masses_the_resonance_and_its_damping_are_what_is_told(tmp_path):
    arm = pendulum()
    bare = arm.changed(masses=np.zeros(1))
    write_arm(bare, tmp_path / "bare.urdf")
    log = make_motion(PLAN, arm, bare, [Request("elastic_joint", {"joint": 1})], np.random.default_rng(571))
    write_motion(log, tmp_path / "log.csv", "bare.urdf")
    found = diagnose(read_table(tmp_path / "log.csv"), load_robot(str(tmp_path / "bare.urdf")))
    (one,) = elastic(found)
    values, true = {p.name: p.value for p in one.parameters}, log.terms[0].parameters
    inertia = float(np.mean(own_inertia(arm, log.cell.q, 0)))
    assert values["resonance"] == pytest.approx(
        np.sqrt(true["stiffness"] / inertia) / (2.0 * np.pi), rel=0.5 * NEAR
    )
    ratio = 0.5 * true["damping"] / np.sqrt(true["stiffness"] * inertia)
    assert values["damping_ratio"] == pytest.approx(ratio, rel=2.0 * NEAR)
    assert "stiffness" not in values and "no masses" in one.sentence
