"""A corrected description moves the arm exactly as the effect does."""

import numpy as np
import pytest

from app.diagnosis.corrected import save_corrected_urdf
from app.diagnosis.model import ModelEffect, SavedModel
from app.errors import InputError
from app.geometry import exp_so3
from app.kinematics import load_robot, robot_names

#: Twelve digits are written.
POSITION_TOLERANCE = 1e-9  # m


@pytest.fixture(scope="module")
def robot():
    return load_robot(next(name for name in robot_names() if load_robot(name).joint_count == 6))


def corrected(robot, tmp_path, *effects):
    path = tmp_path / "corrected.urdf"
    left = save_corrected_urdf(robot, SavedModel("static", robot.name, effects), path)
    return load_robot(path), left


def poses(robot):
    return np.random.default_rng(1).uniform(-1.2, 1.2, (20, robot.joint_count))


def test_a_joint_zero_becomes_part_of_the_description(robot, tmp_path):
    new, left = corrected(robot, tmp_path, ModelEffect("joint_zero", {"joint": 3}, {"offset": 0.01}))
    q = poses(robot)
    moved = q.copy()
    moved[:, 2] += 0.01
    assert left == ()
    for a, b in zip(q, moved, strict=True):
        assert np.allclose(new.flange_matrix(a), robot.flange_matrix(b), atol=POSITION_TOLERANCE)


@pytest.mark.parametrize("link", [1, 2, 4, 6])
@pytest.mark.parametrize("axis", ["a", "d", "alpha", "beta"])
def test_a_link_becomes_as_long_and_as_twisted_as_found(robot, tmp_path, link, axis):
    from app.diagnosis.models.kinematic.geometry import AXES, link_axes

    key, amount = ("link_length", 0.002) if axis in ("a", "d") else ("link_twist", 0.003)
    new, _ = corrected(robot, tmp_path, ModelEffect(key, {"link": link, "axis": axis}, {"value": amount}))
    n = robot.joint_count
    vector = link_axes(robot.chain).vectors[link - 1, AXES.index(axis)] * amount
    shifts, turns = np.zeros((n + 1, 3)), np.tile(np.eye(3), (n + 1, 1, 1))
    if key == "link_length":
        shifts[link] = vector
    else:
        turns[link] = exp_so3(vector)
    q = poses(robot)
    frames = robot.chain.frames(q, shifts, turns)
    again = new.chain.frames(q)
    assert np.allclose(again.flange_positions, frames.flange_positions, atol=POSITION_TOLERANCE)
    assert np.allclose(again.flange_rotations, frames.flange_rotations, atol=POSITION_TOLERANCE)


def test_a_payload_loads_the_joints_as_its_weight_does(robot, tmp_path):
    if not robot.has_inertials:
        robot = load_robot(next(n for n in robot_names() if load_robot(n).has_inertials))
    com = np.array([0.02, -0.01, 0.1])
    effect = ModelEffect(
        "payload", {"body": "tool"}, {"mass": 3.0, **{f"com_{c}": v for c, v in zip("xyz", com, strict=True)}}
    )
    new, _ = corrected(robot, tmp_path, effect)
    for q in poses(robot)[:5]:
        flange = robot.flange_matrix(q)
        arm = flange[:3, :3] @ com
        jacobian = robot.jacobian(q)
        linear = jacobian[:3] + np.cross(jacobian[3:].T, arm).T
        added = linear.T @ np.array([0, 0, 3.0 * 9.81])
        assert np.allclose(new.gravity_torques(q) - robot.gravity_torques(q), added, atol=1e-6)


def test_a_payload_found_in_poses_hangs_at_its_centre(robot, tmp_path):
    mass, com = 3.0, np.array([0.02, -0.01, 0.1])
    moments = {f"moment_{c}": mass * v for c, v in zip("xyz", com, strict=True)}
    told = {f"com_{c}": float(v) for c, v in zip("xyz", com, strict=True)}
    said = [ModelEffect("payload", {"body": "tool"}, {"mass": mass, **more}) for more in (moments, told)]
    found, described = (corrected(robot, tmp_path, effect)[0] for effect in said)
    q = poses(robot)[0]
    assert np.allclose(found.gravity_torques(q), described.gravity_torques(q), atol=1e-9)
    assert not np.allclose(found.gravity_torques(q), robot.gravity_torques(q), atol=1e-3)


def test_what_a_urdf_cannot_say_is_named(robot, tmp_path):
    soft = ModelEffect("joint_compliance", {"joint": 2}, {"compliance": 1e-5})
    zero = ModelEffect("joint_zero", {"joint": 2}, {"offset": 0.01})
    _, left = corrected(robot, tmp_path, zero, soft)
    assert len(left) == 1 and "joint_compliance" in left[0]
    with pytest.raises(InputError, match="joint_compliance"):
        corrected(robot, tmp_path, soft)


@pytest.mark.parametrize("kind", ["table", "prefix", "calibrated"])
def test_what_is_no_plain_urdf_is_corrected_too(tmp_path, kind):
    if kind == "table":
        path = tmp_path / "arm.csv"
        path.write_text("a_mm,alpha_deg,d_mm,theta_deg\n0,90,300,0\n400,0,0,0\n")
    elif kind == "calibrated":
        calibration = tmp_path / "c.conf"
        rows = "\n".join(f"delta_{k} = [0.001, 0, 0, 0, 0, 0]" for k in ("theta", "a", "d", "alpha"))
        calibration.write_text("[mounting]\n" + rows)
        path = f"ur10e#calibration={calibration}"
    else:
        path = tmp_path / "arm.urdf"
        path.write_text(
            load_robot("ur5").path.read_text().replace("</robot>", "<gazebo><a:b/></gazebo></robot>")
        )
    robot = load_robot(path)
    effect = ModelEffect("joint_zero", {"joint": 2}, {"offset": np.radians(1.0)})
    save_corrected_urdf(robot, SavedModel("static", robot.name, (effect,), {}, ""), tmp_path / "out.urdf")
    corrected = load_robot(f"{tmp_path / 'out.urdf'}#flange={robot.flange}")
    q = np.linspace(0.1, 0.6, robot.joint_count)
    moved = q + np.radians(1.0) * (np.arange(robot.joint_count) == 1)
    assert np.allclose(corrected.forward(q).matrix, robot.forward(moved).matrix, atol=1e-6)
