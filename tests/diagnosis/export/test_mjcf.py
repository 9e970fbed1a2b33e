"""The exported MJCF, run in MuJoCo, needs the torques that Teachframe's own laws say."""

import numpy as np
import pytest

from app.diagnosis.export import export_model
from app.kinematics import load_robot
from tests.diagnosis.export import models

mujoco = pytest.importorskip("mujoco", reason="the extra teachframe[mujoco] is not installed")

TORQUE = 1e-6  # Nm
#: MuJoCo's dry friction is a constraint: it holds its full value above this speed [rad/s].
SLIDING = 0.02


def run(robot, effects, motion):
    """Torques (m, n) by MuJoCo's inverse dynamics, and its model."""
    exported = export_model(robot, models.model(robot, effects), "mjcf")
    made = mujoco.MjModel.from_xml_string(exported.text)
    data = mujoco.MjData(made)
    out = np.empty(motion[0].shape)
    for i, (q, qd, qdd) in enumerate(zip(*motion, strict=True)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(made, data)
        out[i] = data.qfrc_inverse
    return out, made, exported


@pytest.fixture(scope="module")
def robot():
    return load_robot("ur10e")


@pytest.fixture(scope="module")
def motion(robot):
    return models.trajectory(robot)


@pytest.mark.parametrize("name", ["ur10e", "r2000ic_165f", "irb120", "ur5", "jby50"])
def test_the_bare_description_needs_the_same_torques(name):
    robot = load_robot(name)
    motion = models.trajectory(robot, 100)
    from app.kinematics.dynamics import inverse_dynamics

    got, _, _ = run(robot, (), motion)
    assert np.abs(got - inverse_dynamics(robot, *motion)).max() < TORQUE


def test_everything_mujoco_has_a_law_for_needs_the_same_torques(robot, motion):
    got, made, exported = run(robot, models.laws(), motion)
    # The constant part of a spring stands in the motor's bias.
    offset = -made.actuator_biasprm[:, 0]
    assert np.abs(got + offset - models.full_torque(robot, *motion)).max() < TORQUE
    assert exported.left == ()


def test_dry_friction_is_the_same_wherever_the_joint_slides(robot, motion):
    got, _, exported = run(robot, (*models.rigid_laws(), *models.dry()), motion)
    expected = models.rigid_torque(robot, *motion) + np.array(models.COULOMB) * np.sign(motion[1])
    apart, slides = np.abs(got - expected), np.abs(motion[1]) > SLIDING
    assert apart[slides].max() < TORQUE
    assert (
        apart <= 2 * np.array(models.COULOMB) + TORQUE
    ).all()  # near standstill it is what holds the joint
    assert exported.left == ()


def test_a_joint_zero_moves_the_arm_as_the_effect_does(robot):
    exported = export_model(
        robot, models.model(robot, [models.effect("joint_zero", {"joint": 2}, offset=0.01)]), "mjcf"
    )
    made = mujoco.MjModel.from_xml_string(exported.text)
    data = mujoco.MjData(made)
    for q in np.random.default_rng(0).uniform(-1.0, 1.0, (5, 6)):
        data.qpos[:] = q
        mujoco.mj_kinematics(made, data)
        moved = q + np.array([0, 0.01, 0, 0, 0, 0])
        np.testing.assert_allclose(data.site_xpos[0], robot.flange_matrix(moved)[:3, 3], atol=1e-9)
    assert exported.left == ()


def test_torque_factor_and_delay_stand_in_the_motors(robot):
    effects = (
        models.effect("torque_constant", {"joint": 2}, scale=0.25),
        models.effect("delay", {"driver": "time"}, delay=0.012),
        models.effect("friction_asymmetry", {"joint": 2}, offset=3.0),
    )
    exported = export_model(robot, models.model(robot, effects), "mjcf")
    made = mujoco.MjModel.from_xml_string(exported.text)
    assert made.actuator_gainprm[:, 0] == pytest.approx([1, 0.8, 1, 1, 1, 1])
    assert made.actuator_biasprm[1, 0] == pytest.approx(-3.0)
    assert made.actuator_delay == pytest.approx([0.012] * 6)
    data = mujoco.MjData(made)
    data.ctrl[1] = 100.0  # recorded torque
    for _ in range(40):
        mujoco.mj_step(made, data)
    assert data.qfrc_actuator[1] == pytest.approx(100.0 / 1.25 - 3.0)


def test_what_mujoco_cannot_carry_is_listed_with_its_size_in_the_file_too(robot):
    effects = (
        models.effect(
            "stribeck_friction", {"joint": 3, "driver": "speed"}, stribeck=4.5, stribeck_speed=0.03
        ),
        models.effect("joint_compliance", {"joint": 2, "driver": "gravity_torque"}, compliance=2e-6),
        models.effect("contact", {"from_s": 1.0, "to_s": 2.0}, fx=10.0, fy=0.0, fz=0.0),
    )
    exported = export_model(robot, models.model(robot, effects), "mjcf")
    said = [str(entry) for entry in exported.left]
    assert any("stribeck_friction" in s and "4.5" in s for s in said)
    assert any("joint_compliance" in s and "2e-06" in s for s in said)
    assert any("contact" in s for s in said)
    for line in said:
        assert line in exported.text


def test_masses_that_no_body_can_have_are_told_and_still_load(robot):
    wild = models.effect("link_inertia", {"link": 4}, mass=-50.0, izz=-3.0)
    got, _, exported = run(robot, (wild,), models.trajectory(robot, 5))
    assert np.isfinite(got).all()
    assert any("link_4" in entry.what and "mass" in entry.size for entry in exported.left)


def test_markup_in_a_name_or_a_source_stays_text(robot):
    from dataclasses import replace

    odd = replace(robot, name='<a> & "b" --')
    exported = export_model(odd, models.model(odd, ()), "mjcf")
    assert mujoco.MjModel.from_xml_string(exported.text).njnt == 6
