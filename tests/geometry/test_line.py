"""Common perpendiculars."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from app.geometry.line import common_perpendicular, cross, distance_to_line

EXACT = 1e-9
numbers = st.floats(-5, 5, allow_nan=False)
vectors = st.tuples(numbers, numbers, numbers).map(np.array)


def _unit(v):
    return v / np.linalg.norm(v)


@given(vectors, vectors, vectors, vectors)
def test_feet_lie_on_their_lines_and_their_connection_is_square_to_both(p1, d1, p2, d2):
    if np.linalg.norm(d1) < 0.1 or np.linalg.norm(d2) < 0.1:
        return
    d1, d2 = _unit(d1), _unit(d2)
    if np.linalg.norm(np.cross(d1, d2)) < 0.05:
        return
    found = common_perpendicular(p1, d1, p2, d2)
    between = found.foot_2 - found.foot_1
    assert distance_to_line(found.foot_1, p1, d1) < EXACT * 100
    assert distance_to_line(found.foot_2, p2, d2) < EXACT * 100
    assert abs(between @ d1) < EXACT * 1000 and abs(between @ d2) < EXACT * 1000
    assert abs(np.linalg.norm(between) - found.distance) < EXACT * 1000


def test_lines_that_meet_have_distance_zero_and_still_a_normal():
    found = common_perpendicular(
        np.zeros(3), np.array([0.0, 0, 1]), np.array([0.0, -1, 2]), np.array([0.0, 1, 0])
    )
    assert found.distance < EXACT
    np.testing.assert_allclose(found.foot_1, [0, 0, 2], atol=EXACT)
    np.testing.assert_allclose(found.normal, [-1, 0, 0], atol=EXACT)


def test_parallel_lines_have_no_perpendicular_of_their_own():
    d = np.array([0.0, 0, 1])
    found = common_perpendicular(np.zeros(3), d, np.ones(3), d)
    assert np.isnan(found.foot_1).all() and np.isnan(found.normal).all()


def test_a_batch_gives_what_single_lines_give():
    rng = np.random.default_rng(3)
    p1, d1, p2, d2 = (rng.normal(size=(7, 3)) for _ in range(4))
    d1, d2 = (d / np.linalg.norm(d, axis=1, keepdims=True) for d in (d1, d2))
    together = common_perpendicular(p1, d1, p2, d2)
    for k in range(7):
        alone = common_perpendicular(p1[k], d1[k], p2[k], d2[k])
        np.testing.assert_allclose(together.foot_1[k], alone.foot_1, atol=EXACT)
        np.testing.assert_allclose(together.distance[k], alone.distance, atol=EXACT)


def test_cross_is_the_cross_product():
    rng = np.random.default_rng(4)
    a, b = rng.normal(size=(5, 3)), rng.normal(size=(5, 3))
    np.testing.assert_allclose(cross(a, b), np.cross(a, b), atol=EXACT)
