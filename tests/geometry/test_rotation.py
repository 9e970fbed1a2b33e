"""The axioms of rotations, near the identity and near half a turn too."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.geometry import (
    angle_between,
    exp_so3,
    log_so3,
    nearest_rotation,
    quaternion_from_rotation,
    rot_x,
    rot_y,
    rot_z,
    rotation_from_quaternion,
    skew,
)
from tests.geometry.strategies import PI, directions, rotation_vectors, rotations

ROUNDING = 1e-14
LOG_TOLERANCE = 1e-12


@given(rotation_vectors())
def test_exp_gives_a_rotation(w):
    r = exp_so3(w)
    assert np.abs(r @ r.T - np.eye(3)).max() < ROUNDING
    assert np.linalg.det(r) == pytest.approx(1.0, abs=ROUNDING)


@given(rotation_vectors())
def test_log_undoes_exp_and_half_a_turn_has_two_names(w):
    back = log_so3(exp_so3(w))
    same = np.abs(back - w).max()
    other = np.abs(back + w).max() if np.linalg.norm(w) > PI - 1e-6 else np.inf
    assert min(same, other) < LOG_TOLERANCE
    assert np.abs(exp_so3(back) - exp_so3(w)).max() < LOG_TOLERANCE


@given(st.floats(1e-14, 1e-5), directions())
def test_a_tiny_turn_keeps_its_relative_accuracy(angle, axis):
    back = log_so3(exp_so3(angle * axis))
    assert np.abs(back - angle * axis).max() < 1e-15 + 1e-10 * angle


@given(st.floats(1e-12, 1e-3), directions())
def test_the_angle_near_half_a_turn_is_exact(short_of, axis):
    assert np.linalg.norm(log_so3(exp_so3((PI - short_of) * axis))) == pytest.approx(PI - short_of, abs=1e-14)


@given(rotations())
def test_quaternions_go_there_and_back_with_w_not_negative(r):
    q = quaternion_from_rotation(r)
    assert q[0] >= 0
    assert np.linalg.norm(q) == pytest.approx(1.0, abs=ROUNDING)
    assert np.abs(rotation_from_quaternion(q) - r).max() < LOG_TOLERANCE
    assert np.abs(rotation_from_quaternion(-3.0 * q) - r).max() < LOG_TOLERANCE


@given(rotations(), rotations())
def test_the_angle_between_is_symmetric_and_zero_with_itself(a, b):
    assert angle_between(a, b) == pytest.approx(angle_between(b, a), abs=LOG_TOLERANCE)
    assert angle_between(a, a) < 1e-7  # a cosine of 1 - 1e-16 is an angle of 1e-8
    assert 0 <= angle_between(a, b) <= PI + ROUNDING


@given(rotations(), rotations(), rotations())
def test_the_angle_between_does_not_depend_on_the_frame(a, b, frame):
    assert angle_between(frame @ a, frame @ b) == pytest.approx(angle_between(a, b), abs=1e-7)


@given(rotations(), st.integers(0, 2**31))
def test_the_nearest_rotation_of_a_spoilt_one_is_near_and_of_a_rotation_itself(r, seed):
    assert np.abs(nearest_rotation(r) - r).max() < 1e-13
    spoilt = r + np.random.default_rng(seed).normal(0, 1e-4, (3, 3))
    found = nearest_rotation(spoilt)
    assert np.abs(found @ found.T - np.eye(3)).max() < ROUNDING * 10
    assert np.linalg.norm(found - spoilt) <= np.linalg.norm(r - spoilt) * (1 + 1e-9)


def test_the_nearest_rotation_is_never_a_mirror():
    found = nearest_rotation(np.diag([1.0, 1.0, -1.0]))
    assert np.linalg.det(found) == pytest.approx(1.0)


@given(st.floats(-10, 10))
def test_turns_about_the_axes_go_from_each_axis_to_the_next(angle):
    c, s = np.cos(angle), np.sin(angle)
    assert np.abs(rot_z(angle) @ [1, 0, 0] - [c, s, 0]).max() < ROUNDING
    assert np.abs(rot_x(angle) @ [0, 1, 0] - [0, c, s]).max() < ROUNDING
    assert np.abs(rot_y(angle) @ [0, 0, 1] - [s, 0, c]).max() < ROUNDING


@given(directions(), directions())
def test_skew_is_the_cross_product(a, b):
    assert np.abs(skew(a) @ b - np.cross(a, b)).max() < ROUNDING


@pytest.mark.parametrize("shape", [(), (1,), (5,), (2, 3)])
def test_batches_give_what_single_calls_give(shape):
    w = np.random.default_rng(0).normal(0, 1.5, (*shape, 3))
    r = exp_so3(w)
    assert r.shape == (*shape, 3, 3)
    for index in np.ndindex(shape):
        single = exp_so3(w[index])
        assert np.array_equal(single, r[index])
        assert np.array_equal(log_so3(single), log_so3(r)[index])
        assert np.array_equal(quaternion_from_rotation(single), quaternion_from_rotation(r)[index])
        assert np.allclose(nearest_rotation(single), nearest_rotation(r)[index], atol=ROUNDING)
