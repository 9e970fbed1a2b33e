"""The generator's own arm against pin: the one check from outside that its forward model is right."""

import numpy as np
import pinocchio as pin
import pytest

from app.kinematics import load_robot
from app.proof.generator.arm import stance
from app.proof.generator.dynamics import holding_torques, moved_inertia, moving_torques
from app.proof.generator.urdf import read_arm
from tests.proof.arms import TOPOLOGIES, random_arm

SAME_PLACE = 1e-12  # m
SAME_TORQUE = 1e-10  # Nm
AS_WRITTEN = 1e-9  # m; the file keeps 12 digits


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_the_generator_and_pin_agree_on_random_arms(topology, seed, tmp_path):
    drawn, path = random_arm(topology, tmp_path, seed)
    arm, robot = read_arm(path), load_robot(path)
    rng = np.random.default_rng(seed)
    q = rng.uniform(arm.lower, arm.upper, (10, arm.n))
    qd, qdd = rng.normal(size=(2, 10, arm.n))
    there = stance(arm, q)
    for i in range(len(q)):
        flange = robot.flange_matrix(q[i])
        assert np.abs(there.flange_places[i] - flange[:3, 3]).max() < SAME_PLACE
        assert np.abs(there.flange_rotations[i] - flange[:3, :3]).max() < SAME_PLACE
        torque = pin.rnea(robot.model, robot.data, q[i], qd[i], qdd[i])
        assert np.abs(moving_torques(arm, q, qd, qdd)[i] - torque).max() < SAME_TORQUE
    assert np.abs(holding_torques(arm, q) - robot.gravity_torques(q)).max() < SAME_TORQUE
    assert np.abs(stance(drawn, q).flange_places - there.flange_places).max() < AS_WRITTEN


@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_a_load_weighs_what_pin_says_a_heavier_last_link_weighs(topology, tmp_path):
    arm, path = random_arm(topology, tmp_path, 9)
    arm, robot = read_arm(path), load_robot(path)
    rng = np.random.default_rng(9)
    q = rng.uniform(arm.lower, arm.upper, (5, arm.n))
    qd, qdd = rng.normal(size=(2, 5, arm.n))
    mass, at, shape = 2.5, np.array([0.02, -0.03, 0.1]), np.diag([0.01, 0.02, 0.015])
    frame = robot.model.frames[robot.flange_id]
    load = frame.placement.act(pin.Inertia(mass, at, shape))
    loaded = robot.model.copy()
    loaded.inertias[frame.parentJoint] = loaded.inertias[frame.parentJoint] + load
    data = loaded.createData()
    ours = moving_torques(arm, q, qd, qdd, load_kg=mass, load_at=at, load_inertia=shape)
    still = holding_torques(arm, q, load_kg=mass, load_at=at)
    for i in range(len(q)):
        assert np.abs(ours[i] - pin.rnea(loaded, data, q[i], qd[i], qdd[i])).max() < SAME_TORQUE
        assert np.abs(still[i] - pin.computeGeneralizedGravity(loaded, data, q[i])).max() < SAME_TORQUE


@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_what_a_joint_moves_is_the_torque_of_an_acceleration_of_one_from_rest(topology, tmp_path):
    arm, _ = random_arm(topology, tmp_path, seed=5)
    q = np.random.default_rng(6).uniform(-1.5, 1.5, (20, arm.n))
    for j in range(arm.n):
        push = np.zeros_like(q)
        push[:, j] = 1.0
        torque = moving_torques(arm, q, np.zeros_like(q), push, gravity=np.zeros(3))
        assert np.array_equal(moved_inertia(arm, stance(arm, q), j), torque[:, j])
        asked = moving_torques(arm, q, push, push, since=j)
        assert (
            np.array_equal(asked[:, j:], moving_torques(arm, q, push, push)[:, j:]) and not asked[:, :j].any()
        )


def test_a_description_without_a_chain_is_refused_in_one_line(tmp_path):
    from app.errors import FileFormatError

    path = tmp_path / "none.urdf"
    path.write_text("<robot name='x'><link name='a'/></robot>")
    with pytest.raises(FileFormatError, match="0 moving joints"):
        read_arm(path)
