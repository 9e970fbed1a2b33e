"""The next touch: useful, allowed, reachable."""

import numpy as np
import pytest

from app.calibration.next_touch import (
    TouchLimits,
    plan_touches,
    predicted_covariance,
    predicted_error,
    propose,
)
from app.calibration.next_touch.candidates import candidates, tilted
from app.calibration.solvers.joint import fit_joint, solve_joint
from app.errors import DegenerateGeometryError
from app.geometry import angle_between
from app.kinematics import load_robot
from app.units import from_deg
from tests.calibration.drawing import SPIKE, TOOL, touches

NOISE = 3e-4
LIMITS = TouchLimits()
AXIS = TOOL / np.linalg.norm(TOOL)
ROUNDING = 1e-9
POSITION = 1e-5
#: What following the proposals must reach against random touches at four touches.
SHARE_OF_RANDOM = 0.55


def follow(count, **options):
    made = np.eye(3)[None]
    while len(made) < count:
        found = propose(made, tool=TOOL, spike=SPIKE, touches=count, **options)
        made = np.concatenate([made, found.T_base_flange.rotation[None]])
    return made


def median_error(sets, rng):
    positions = -sets @ TOOL + rng.normal(0.0, NOISE, sets.shape[:-1])
    return np.median(np.linalg.norm(solve_joint(sets, positions)[0] - TOOL, axis=1))


def test_the_prediction_is_the_covariance_that_the_fit_will_report():
    rotations, positions = touches(5, 0.5)
    predicted = predicted_covariance(rotations, NOISE)
    np.testing.assert_allclose(
        predicted, fit_joint(rotations, positions).unit_covariance * NOISE**2, rtol=1e-6
    )


def test_two_touches_or_one_axis_predict_nothing():
    rotations, _ = touches(5, 0.5)
    assert predicted_error(rotations[:2]) == np.inf
    assert predicted_error(np.tile(np.eye(3), (4, 1, 1))) == np.inf


def test_following_the_proposals_beats_random_touches_by_the_promised_share():
    rng = np.random.default_rng(0)
    shape = 3 * 4000
    tilt, turn = (
        LIMITS.tilt * np.sqrt(rng.uniform(0, 1, shape)),
        rng.uniform(-LIMITS.turn, LIMITS.turn, shape),
    )
    drawn = tilted(np.eye(3), AXIS, tilt, rng.uniform(0, 2 * np.pi, shape), turn).reshape(4000, 3, 3, 3)
    random = np.concatenate([np.broadcast_to(np.eye(3), (4000, 1, 3, 3)), drawn], axis=1)
    ours = np.broadcast_to(follow(4), (4000, 4, 3, 3))
    assert median_error(ours, rng) <= SHARE_OF_RANDOM * median_error(random, rng)


def test_no_proposal_leaves_the_limits():
    limits = TouchLimits(from_deg(20.0), from_deg(30.0))
    for rotation in follow(7, limits=limits)[1:]:
        assert np.arccos(np.clip((rotation @ AXIS) @ AXIS, -1, 1)) <= limits.tilt + ROUNDING
        assert angle_between(np.eye(3), rotation) <= limits.tilt + limits.turn + ROUNDING


def test_planning_the_whole_set_is_no_worse_than_choosing_greedily():
    choice = candidates(np.eye(3), AXIS, LIMITS)
    made = np.eye(3)[None]
    for _ in range(3):
        made = np.concatenate([made, choice[plan_touches(made, choice, 1)]])
    planned = np.concatenate([np.eye(3)[None], choice[plan_touches(np.eye(3)[None], choice, 3)]])
    assert predicted_error(planned) <= predicted_error(made) * (1 + ROUNDING)


def test_the_proposal_says_what_it_will_bring():
    made = follow(3)
    found = propose(made, tool=TOOL, spike=SPIKE, touches=4, noise=NOISE)
    assert found.after < found.now and found.after == pytest.approx(found.at_end)
    assert f"{1e3 * found.after:.2f} mm" in found.sentence()
    np.testing.assert_allclose(found.T_base_flange.apply(TOOL), SPIKE, atol=ROUNDING)


def test_after_the_last_touch_a_further_one_still_helps():
    made = follow(4)
    found = propose(made, tool=TOOL, spike=SPIKE, touches=4)
    assert found.after < found.now


@pytest.fixture(scope="module")
def arm():
    robot = load_robot("ur10e")
    return robot, robot.forward(robot.home)


def test_the_ghost_arm_reaches_the_spike_within_its_limits(arm):
    robot, flange = arm
    spike = flange.apply(TOOL)
    found = propose(flange.rotation[None], tool=TOOL, spike=spike, robot=robot)
    assert found.q is not None and robot.within_limits(found.q)
    np.testing.assert_allclose(robot.forward(found.q).apply(TOOL), spike, atol=POSITION)


def test_what_collides_is_never_proposed(arm):
    robot, flange = arm
    spike = flange.apply(TOOL)
    free = propose(flange.rotation[None], tool=TOOL, spike=spike, robot=robot)
    forbidden = free.q[5]
    side = np.sign(free.q[5] - robot.home[5]) or 1.0

    def collides(q):
        return side * (q[5] - robot.home[5]) > 0.3 * abs(forbidden - robot.home[5])

    found = propose(flange.rotation[None], tool=TOOL, spike=spike, robot=robot, collides=collides)
    assert not collides(found.q) and found.refused > 0


def test_a_spike_out_of_reach_is_said_so(arm):
    robot, flange = arm
    with pytest.raises(DegenerateGeometryError, match="reaches none"):
        propose(flange.rotation[None], tool=TOOL, spike=np.array([5.0, 0, 0]), robot=robot,
                limits=TouchLimits(0.1, 0.1), collides=lambda q: True)  # fmt: skip


def test_without_any_touch_a_reference_is_needed():
    with pytest.raises(DegenerateGeometryError, match="first touch"):
        propose(np.zeros((0, 3, 3)), tool=TOOL, spike=SPIKE)
    assert propose(np.zeros((0, 3, 3)), tool=TOOL, spike=SPIKE, reference=np.eye(3)).now == np.inf
