"""Every law: its columns are what it does, and the torque it adds is linear where it says so."""

from __future__ import annotations

import numpy as np
import pytest

from app.diagnosis.effects.motion._load import Load
from app.diagnosis.motion import diagnose
from app.diagnosis.motion.library import laws
from app.diagnosis.motion.log import read_log
from app.diagnosis.motion.sampling import motion_of, take_samples
from app.kinematics import load_robot
from tests.diagnosis.motion.simulator import measure, swing, write

SAME = 1e-9  # of the largest torque
CONTRACT = {
    "viscous_friction", "coulomb_friction", "stribeck_friction", "friction_asymmetry", "quadratic_friction",
    "load_friction", "warmup_friction", "rotor_inertia", "payload", "payload_change", "gravity_direction",
    "torque_constant", "delay", "torque_ripple", "joint_spring", "joint_coupling", "contact",
}  # fmt: skip


@pytest.fixture(scope="module")
def samples(tmp_path_factory):
    robot = load_robot("ur10e")
    rng = np.random.default_rng(3)
    run = swing(robot, rng, samples=600)
    measure(run, rng, 0.01)
    log = read_log(write(run, tmp_path_factory.mktemp("laws") / "log.csv", speed=True), robot)
    return take_samples(log, robot, motion_of(log), log.y, lambda share, what: None)


def test_every_effect_of_the_contract_is_there():
    assert set(laws()) >= CONTRACT


@pytest.mark.parametrize("key", sorted(CONTRACT))
def test_columns_times_coefficients_are_the_torque_of_the_law(key, samples):
    law, state = laws()[key], samples.state
    place = law.places(state)[0]
    where = {**place.where, "from_s": 1.0, "to_s": 4.0} if law.windowed else place.where
    columns = law.columns(state, where, place.shape)
    small = 1e-5 if key == "delay" else 1e-2
    coefficients = small * np.arange(1.0, columns.shape[-1] + 1)
    if isinstance(law, Load):  # a point mass: its inertia follows from mass and centre
        values = {"mass": 0.7, "com_x": 0.02, "com_y": -0.01, "com_z": 0.08}
        coefficients = law.body(values)
    else:
        values = law.values(coefficients, place.shape)
    exact, linear = law.apply(state, where, values), columns @ coefficients
    largest = np.abs(exact).max()
    assert largest > 0
    if key == "delay":  # the slope is a central difference, the shift an interpolation
        assert np.corrcoef(exact[5:-5].ravel(), linear[5:-5].ravel())[0, 1] > 0.99
    else:
        assert np.abs(exact - linear).max() <= SAME * largest


@pytest.mark.parametrize("key", sorted(CONTRACT))
def test_every_law_explains_itself_in_one_sentence(key, samples):
    law = laws()[key]
    place = law.places(samples.state)[0]
    where = {**place.where, "from_s": 1.0, "to_s": 4.0} if law.windowed else place.where
    size = law.columns(samples.state, where, place.shape).shape[-1]
    sentence = law.explain(where, law.values(np.full(size, 0.1), place.shape))
    assert sentence.endswith(".") and "\n" not in sentence
    assert set(law.values(np.full(size, 0.1), place.shape)) <= set(law.units)


def test_a_joint_that_its_friction_pushes_along_is_given_no_name(tmp_path):
    robot, rng = load_robot("ur10e"), np.random.default_rng(71)
    run = swing(robot, rng, samples=2000)
    run.torque[:, 2] -= 5.0 * run.qd[:, 2]
    measure(run, rng, 0.02, 0.0)
    found = diagnose(write(run, tmp_path / "log.csv", digits=7), robot)
    assert not found.findings and found.verdict == "unexplained"
    assert found.leftover.where["joint"] == 3


def test_gravity_may_point_elsewhere_but_is_not_half_as_strong_again():
    law = laws()["gravity_direction"]
    assert law.lawful({"gx": 0.5, "gy": 0.0, "gz": -9.8}) and law.lawful({"gx": 9.81, "gy": 0.0, "gz": 0.0})
    assert not law.lawful({"gx": 0.0, "gy": 0.0, "gz": -13.96})
