"""Arcs out of a tracker recording, all axes of a made arm, bases from poses: against a known truth."""

import numpy as np
import pytest

from app.calibration.base.poses import base_from_poses
from app.calibration.base.run import ArcResult, PoseResult, run_base
from app.calibration.base.sequence import axis_of_rows, rest_posture
from app.errors import DegenerateGeometryError, InputError, TooFewPointsError
from app.geometry import Pose, exp_so3
from app.kinematics import load_robot
from tests.calibration.base.files import codes, write

NOISE = 20e-6
CLOSE = 6.0  # sigmas
URDF = """<robot name="arm"><link name="base"/>{links}<link name="flange"/>{joints}
<joint name="f" type="fixed"><parent link="l6"/><child link="flange"/><origin xyz="0 0 0.1"/></joint></robot>"""
JOINTS = [  # origin xyz, rpy, axis
    ((0, 0, 0.4), (0, 0, 0), (0, 0, 1)),
    ((0.15, 0, 0.1), (0, 0, 0), (0, 1, 0)),
    ((0, 0, 0.7), (0, 0, 0), (0, 1, 0)),
    ((0.3, 0, 0.12), (0, 0, 0), (1, 0, 0)),
    ((0.4, 0, 0), (0, 0, 0), (0, 1, 0)),
    ((0.1, 0, 0), (0, 0, 0), (1, 0, 0)),
]


def _urdf(path, joints=JOINTS):
    links = "".join(f'<link name="l{k}"/>' for k in range(1, 7))
    parts = []
    for k, (xyz, rpy, axis) in enumerate(joints, 1):
        parent = "base" if k == 1 else f"l{k - 1}"
        x, r, a = (" ".join(map(str, v)) for v in (xyz, rpy, axis))
        parts.append(
            f'<joint name="j{k}" type="revolute"><parent link="{parent}"/><child link="l{k}"/>'
            f'<origin xyz="{x}" rpy="{r}"/><axis xyz="{a}"/>'
            '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
        )
    path.write_text(URDF.format(links=links, joints="".join(parts)))
    return load_robot(path)


def _record(path, robot, q, reflector, T, seed=0, keys=()):
    rng = np.random.default_rng(seed)
    frames = robot.chain.frames(q)
    points = T.apply(frames.flange_positions + frames.flange_rotations @ reflector)
    points = (points + rng.normal(0, NOISE, points.shape)) * 1e3
    names = [f"q{k}_rad" for k in range(1, q.shape[1] + 1)]
    lines = ["# kind: tracker", f"# robot: {robot.path}", *keys, ",".join([*names, "x_mm", "y_mm", "z_mm"])]
    lines += [
        ",".join([*(f"{v:.7f}" for v in a), *(f"{v:.4f}" for v in p)]) for a, p in zip(q, points, strict=True)
    ]
    path.write_text("\n".join(lines) + "\n")
    return path


def _one_axis_at_a_time(rest, count=15, span=1.4):
    rows = []
    for axis in range(len(rest)):
        for angle in np.linspace(-span, span, count):
            q = np.array(rest, float)
            q[axis] += angle
            rows.append(q)
    return np.array(rows)


T_TRUE = Pose.of(exp_so3(np.array([0.1, -0.2, 2.0])), np.array([3.0, -1.0, 0.5]))


def test_rows_belong_to_the_axis_that_left_its_rest():
    q = _one_axis_at_a_time([0.3, -0.2, 0.1, 0.0, 0.4, 0.0])
    np.testing.assert_allclose(rest_posture(q), [0.3, -0.2, 0.1, 0.0, 0.4, 0.0], atol=1e-3)
    np.testing.assert_array_equal(axis_of_rows(q), np.repeat(np.arange(1, 7), 15))


def test_poses_drawn_at_random_are_no_arcs():
    assert axis_of_rows(np.random.default_rng(0).uniform(-1, 1, (30, 6))) is None


def test_a_coupled_joint_still_counts_as_one_axis():
    q = _one_axis_at_a_time(np.zeros(6))
    q[15:30, 2] = -q[15:30, 1]
    np.testing.assert_array_equal(axis_of_rows(q), np.repeat(np.arange(1, 7), 15))


def test_a_bent_arm_gives_its_true_lengths_and_twists_within_their_uncertainty(tmp_path):
    described = _urdf(tmp_path / "described.urdf")
    bent = [list(map(list, j)) for j in JOINTS]
    bent[1][0][0] += 0.0008  # a1 longer
    bent[2][0][2] += 0.0010  # a2 longer
    bent[4][0][0] -= 0.0006  # d4 shorter
    bent[3][1][2] += np.radians(0.05)  # axis 4 twisted
    real = _urdf(tmp_path / "real.urdf", bent)
    q = _one_axis_at_a_time(np.zeros(6))
    path = _record(tmp_path / "all.csv", real, q, np.array([0.05, 0.12, 0.08]), T_TRUE)
    result = run_base([path], robot=str(described.path))
    assert isinstance(result, ArcResult)
    found = {f"{x.name}{x.axis}": x for x in result.arms[0].quantities}
    wanted = {"a1": 0.0008, "a2": 0.0010, "d4": -0.0006, "a4": 0.0}
    for name, error in wanted.items():
        assert abs(found[name].error - error) < CLOSE * found[name].sigma, name
        assert found[name].sigma < 2e-4
    assert abs(abs(found["twist3"].error) - np.radians(0.05)) < CLOSE * found["twist3"].sigma
    assert all(abs(t.slope - 1) < 1e-3 for t in result.arms[0].turning)


def test_the_makers_frame_of_a_made_arm_is_where_it_was_put(tmp_path):
    robot = _urdf(tmp_path / "arm.urdf")
    path = _record(
        tmp_path / "all.csv", robot, _one_axis_at_a_time(np.zeros(6)), np.array([0.05, 0.1, 0.1]), T_TRUE
    )
    base = run_base([path]).bases[0]
    gap = T_TRUE.inverse() @ base.maker.T_tracker_maker
    assert np.linalg.norm(gap.position) < 3e-4 and np.linalg.norm(gap.rotvec) < 3e-4


def test_the_wrong_robots_description_is_named(tmp_path):
    other = [list(map(list, j)) for j in JOINTS]
    other[1][0][0] += 0.05
    robot, wrong = _urdf(tmp_path / "arm.urdf"), _urdf(tmp_path / "other.urdf", other)
    path = _record(
        tmp_path / "all.csv", robot, _one_axis_at_a_time(np.zeros(6)), np.array([0.05, 0.1, 0.1]), T_TRUE
    )
    assert "description" in codes(run_base([path], robot=str(wrong.path)))
    assert "description" not in codes(run_base([path]))


def test_a_base_from_poses_holds_its_uncertainty_and_predicts_what_it_has_not_seen(tmp_path):
    robot = _urdf(tmp_path / "arm.urdf")
    rng = np.random.default_rng(4)
    path = _record(
        tmp_path / "p.csv", robot, rng.uniform(-1.5, 1.5, (60, 6)), np.array([0.05, 0.1, 0.1]), T_TRUE
    )
    result = run_base([path])
    assert isinstance(result, PoseResult) and not codes(result)
    base = result.bases[0]
    gap = base.T_tracker_base.inverse() @ T_TRUE
    error = np.concatenate([gap.position, gap.rotvec])
    assert error @ np.linalg.solve(base.covariance, error) < 22.46  # chi-squared, 6, 99.9%
    assert base.heldout_rms < 2 * np.sqrt(3) * NOISE


def test_too_few_poses_and_poses_that_do_not_turn_are_refused():
    rng = np.random.default_rng(5)
    rotations, positions = exp_so3(rng.normal(size=(8, 3))), rng.normal(size=(8, 3))
    with pytest.raises(TooFewPointsError):
        base_from_poses(rotations[:4], positions[:4], positions[:4])
    with pytest.raises(DegenerateGeometryError):
        base_from_poses(np.tile(np.eye(3), (8, 1, 1)), positions, positions)


def test_poses_without_a_description_say_that_one_is_needed(tmp_path):
    robot = _urdf(tmp_path / "arm.urdf")
    q = np.random.default_rng(6).uniform(-1, 1, (20, 6))
    path = _record(tmp_path / "p.csv", robot, q, np.zeros(3), T_TRUE)
    path.write_text("\n".join(line for line in path.read_text().splitlines() if "robot" not in line))
    with pytest.raises(InputError, match="--robot"):
        run_base([path])


def test_arcs_of_all_axes_in_an_arcs_file_give_the_arm_too(tmp_path):
    robot = _urdf(tmp_path / "arm.urdf")
    q = _one_axis_at_a_time(np.zeros(6))
    frames = robot.chain.frames(q)
    points = T_TRUE.apply(frames.flange_positions + frames.flange_rotations @ [0.05, 0.12, 0.08]) * 1e3
    points += np.random.default_rng(0).normal(0, 0.02, points.shape)
    degrees = np.degrees(q[np.arange(90), np.repeat(np.arange(6), 15)])
    extra = [
        f"{k // 15 + 1},{x:.4f},{y:.4f},{z:.4f},{degrees[k]:.4f}"
        for k, (x, y, z) in enumerate(points)
        if k >= 30
    ]
    keys = [f"robot: {robot.path}"]
    path = write(
        tmp_path / "a.csv",
        points[:15],
        points[15:30],
        angles=(degrees[:15], degrees[15:30]),
        keys=keys,
        extra=extra,
    )
    arm = run_base([path]).arms[0]
    assert {"a2", "d4", "a5"} <= {f"{x.name}{x.axis}" for x in arm.quantities}
    assert all(abs(x.error) < CLOSE * x.sigma for x in arm.quantities if x.error is not None)
