"""Every way makers write an orientation: there and back, at the gimbal lock too, and known examples."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.errors import UnknownNameError
from app.geometry import CONVENTIONS, convention
from tests.geometry.strategies import PI, rotations

ROUND_TRIP = 1e-12
AT_THE_LOCK = 3e-9  # closer than this the two locked angles are written as one
KEYS = sorted(CONVENTIONS)


@pytest.mark.parametrize("key", KEYS)
@given(r=rotations())
def test_rotation_to_numbers_and_back_is_the_same_rotation(key, r):
    form = convention(key)
    numbers = form.from_rotation(r)
    assert numbers.shape == (len(form.columns),)
    assert np.abs(form.to_rotation(numbers) - r).max() < AT_THE_LOCK


@pytest.mark.parametrize("key", ["ZYX", "XYZ", "ZYZ"])
@pytest.mark.parametrize("off", [0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-5])
@given(a=st.floats(-PI, PI), c=st.floats(-PI, PI), side=st.sampled_from([-1.0, 1.0]))
def test_near_the_gimbal_lock_the_rotation_survives(key, off, a, c, side):
    form = convention(key)
    middle = side * (PI / 2 - off) if key != "ZYZ" else (off if side > 0 else PI - off)
    r = form.to_rotation(np.array([a, middle, c]))
    tolerance = AT_THE_LOCK if off < 1e-8 else ROUND_TRIP
    assert np.abs(form.to_rotation(form.from_rotation(r)) - r).max() < tolerance


@pytest.mark.parametrize("key", ["ZYX", "XYZ"])
@given(a=st.floats(-3.1, 3.1), b=st.floats(-1.5, 1.5), c=st.floats(-3.1, 3.1))
def test_angles_away_from_the_lock_come_back_as_written(key, a, b, c):
    form = convention(key)
    numbers = np.array([a, b, c])
    assert np.abs(form.from_rotation(form.to_rotation(numbers)) - numbers).max() < 1e-11


@given(a=st.floats(-3.1, 3.1), b=st.floats(0.05, 3.09), c=st.floats(-3.1, 3.1))
def test_zyz_angles_come_back_as_written(a, b, c):
    form = convention("ZYZ")
    numbers = np.array([a, b, c])
    assert np.abs(form.from_rotation(form.to_rotation(numbers)) - numbers).max() < 1e-11


def test_zyx_is_the_matrix_that_the_paper_prints():
    a, b, c = np.radians([-156.2, 44.8, -126.6])
    sa, ca, sb, cb, sc, cc = np.sin(a), np.cos(a), np.sin(b), np.cos(b), np.sin(c), np.cos(c)
    printed = np.array(  # Xiong 2012, eq. (19), its second entry of row 2 read as sA sB sC + cA cC
        [
            [ca * cb, ca * sb * sc - sa * cc, ca * sb * cc + sa * sc],
            [sa * cb, sa * sb * sc + ca * cc, sa * sb * cc - ca * sc],
            [-sb, cb * sc, cb * cc],
        ]
    )
    assert np.abs(convention("ZYX").to_rotation(np.array([a, b, c])) - printed).max() < 1e-15


def test_fanuc_and_kuka_write_the_same_three_angles_in_opposite_order():
    numbers = np.array([0.3, -0.7, 1.1])
    kuka, fanuc = convention("ZYX"), convention("XYZ")
    assert np.allclose(kuka.to_rotation(numbers), fanuc.to_rotation(numbers[::-1]))


def test_a_quarter_turn_about_x_in_every_convention():
    quarter = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    known = {
        "ZYX": [0, 0, PI / 2],
        "XYZ": [PI / 2, 0, 0],
        "ZYZ": [-PI / 2, PI / 2, PI / 2],
        "rotvec": [PI / 2, 0, 0],
        "quaternion": [np.sqrt(0.5), np.sqrt(0.5), 0, 0],
    }
    for key, numbers in known.items():
        assert np.abs(convention(key).to_rotation(np.array(numbers)) - quarter).max() < 1e-15
        assert np.abs(convention(key).from_rotation(quarter) - numbers).max() < 1e-15


@pytest.mark.parametrize("key", KEYS)
def test_batches_are_taken(key):
    form = convention(key)
    numbers = np.random.default_rng(0).uniform(0.1, 1.0, (4, 5, len(form.columns)))
    r = form.to_rotation(numbers)
    assert r.shape == (4, 5, 3, 3)
    assert form.from_rotation(r).shape == numbers.shape


def test_an_unknown_convention_lists_the_known():
    with pytest.raises(UnknownNameError, match="ZYX"):
        convention("ZXZ")
