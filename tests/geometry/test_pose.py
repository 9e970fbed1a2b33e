"""The axioms of rigid transforms, and that a pose cannot be written."""

import numpy as np
import pytest
from hypothesis import given

from app.errors import DegenerateGeometryError
from app.geometry import Pose, exp_so3, fit_rigid
from tests.geometry.strategies import poses

ROUNDING = 1e-12


@given(poses())
def test_a_pose_times_its_inverse_is_nothing(a):
    assert np.abs((a @ a.inverse()).matrix - np.eye(4)).max() < ROUNDING
    assert np.abs((a.inverse() @ a).matrix - np.eye(4)).max() < ROUNDING


@given(poses(), poses(), poses())
def test_poses_associate(a, b, c):
    assert np.abs(((a @ b) @ c).matrix - (a @ (b @ c)).matrix).max() < ROUNDING


@given(poses(), poses())
def test_names_cancel_from_inside_for_points_too(T_a_b, T_b_c):
    points_c = np.array([[0.1, 0.2, 0.3], [1.0, -2.0, 0.5]])
    assert np.abs((T_a_b @ T_b_c).apply(points_c) - T_a_b.apply(T_b_c.apply(points_c))).max() < ROUNDING


@given(poses())
def test_quaternion_and_position_rebuild_the_pose(a):
    assert np.abs(Pose.from_quaternion(a.quaternion, a.position).matrix - a.matrix).max() < ROUNDING


@given(poses())
def test_the_rotation_vector_rebuilds_the_rotation(a):
    assert np.abs(exp_so3(a.rotvec) - a.rotation).max() < ROUNDING


def test_the_identity_leaves_points_where_they_are():
    points = np.arange(12.0).reshape(4, 3)
    assert np.array_equal(Pose.identity().apply(points), points)


def test_a_pose_keeps_a_copy_that_cannot_be_written():
    matrix = np.eye(4)
    pose = Pose(matrix)
    matrix[0, 3] = 7.0
    assert pose.position[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        pose.matrix[0, 0] = 2.0
    with pytest.raises(AttributeError):
        pose.matrix = matrix  # type: ignore[misc]


def test_equal_poses_are_equal_and_share_their_hash():
    a, b = Pose.of(None, np.array([1.0, 2.0, 3.0])), Pose.of(np.eye(3), np.array([1.0, 2.0, 3.0]))
    assert a == b and hash(a) == hash(b) and a != Pose.identity() and a != "pose"
    assert "1." in repr(a)


def test_a_wrong_shape_is_refused():
    with pytest.raises(ValueError, match="4, 4"):
        Pose(np.eye(3))


@given(poses())
def test_fitting_moved_points_gives_the_motion(T_a_b):
    points_b = np.array([[0.0, 0, 0], [1, 0, 0], [0, 0.5, 0], [0.2, 0.1, 0.8]])
    assert np.abs(fit_rigid(points_b, T_a_b.apply(points_b)).matrix - T_a_b.matrix).max() < 1e-10


@given(poses())
def test_three_points_in_a_plane_are_enough(T_a_b):
    points_b = np.array([[0.0, 0, 0], [1, 0, 0], [0, 0.5, 0]])
    assert np.abs(fit_rigid(points_b, T_a_b.apply(points_b)).matrix - T_a_b.matrix).max() < 1e-10


@pytest.mark.parametrize(
    "points", [np.eye(3)[:2], np.outer(np.arange(5.0), [1.0, 2.0, 3.0]), np.zeros((4, 3))]
)
def test_points_on_a_line_or_too_few_are_refused(points):
    with pytest.raises(DegenerateGeometryError):
        fit_rigid(points, points)
