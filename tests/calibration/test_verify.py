"""The turn about the accepted tool point."""

import numpy as np
import pytest

from app.calibration.tool import calibrate
from app.calibration.verify import TOLERANCE, TURNS, _off, turning_path, verify
from app.geometry import Pose, rot_y
from app.kinematics import load_robot
from tests.calibration.drawing import TOOL, captures, touches

EXACT = 1e-9
IK = 1e-5


def result(noise=0.0, seed=0):
    return calibrate(captures(*touches(5, 0.6, noise, seed)))


START = Pose.of(rot_y(2.5), np.array([0.8, 0.1, 0.9]))


def true_tip(flange, _):
    return flange.apply(TOOL)


def test_with_the_true_tool_the_tip_stays_where_it_is():
    found = verify(result(), START, true_tip)
    assert found.wander < EXACT and len(found.trace) > 60 and not found.stopped


def test_the_wander_is_what_the_error_of_the_tool_point_makes_of_it():
    found = result()
    off = np.array([0.0, 0.0, 0.002])
    wrong = verify(found, START, lambda flange, _: flange.apply(TOOL + off))
    assert wrong.wander == pytest.approx(2 * np.sin(TURNS[0] / 2) * 0.002, rel=1e-6)


def test_the_path_turns_about_each_axis_both_ways_and_keeps_the_tool_point():
    tool = result().T_flange_tool
    poses, axes = turning_path(START @ tool, tool)
    for pose in poses:
        np.testing.assert_allclose(pose.apply(tool.position), START.apply(tool.position), atol=EXACT)
    for axis, most in enumerate(TURNS):
        turns = [(START.rotation.T @ p.rotation) for p, a in zip(poses, axes, strict=True) if a == axis]
        reached = [np.arccos(np.clip((np.trace(r) - 1) / 2, -1, 1)) for r in turns]
        assert max(reached) == pytest.approx(most)


def test_the_wander_is_inside_what_was_predicted_in_95_of_100_cases():
    inside = 0
    for seed in range(100):
        found = verify(result(3e-4, seed), START, true_tip)
        inside += found.wander <= found.expected
    assert inside >= 90


@pytest.mark.parametrize(
    "way", [(0, 0, 1), (1, 0, 0), (0.6, 0, 0.8), (0.577350269, 0.577350269, 0.577350269)]
)
def test_how_far_the_tool_point_is_off_is_measured_whatever_the_angle(way):
    off = 0.002 * np.array(way)
    found = verify(result(), START, lambda flange, _: flange.apply(TOOL + off))
    assert found.off == pytest.approx(0.002, rel=1e-6) and not found.good


def test_a_turn_that_ended_early_tells_at_least_how_far_it_is_off():
    """What lies along the only axis turned about is not seen."""
    seen, turns = [], []

    def tip(flange, _):
        seen.append(flange)
        return flange.apply(TOOL + np.array([0.0, 0.001, 0.001]))

    whole = verify(result(), START, tip)
    for axis in range(3):
        kept = whole.axes == axis
        poses = tuple(pose for pose, one in zip(whole.flanges, kept, strict=True) if one)
        away = np.linalg.norm(whole.trace[kept] - whole.trace[0], axis=1)
        turns.append(
            _off((whole.flanges[0], *poses), np.append(axis, whole.axes[kept]), np.append(0.0, away))
        )
    assert max(turns) <= whole.off + EXACT == pytest.approx(np.sqrt(2.0) * 1e-3, rel=1e-6)
    assert min(turns) < 0.95 * whole.off


NOISE, PROPOSED = 2e-4, 0.8  # m of a touch on an axis; rad, about as far as the proposed touches are tilted
#: Tools of which so many may be told to teach again: 1.2 are expected (36 of 12,000 were), more than six come once in
#: 4,000 runs.
GOOD, SENT_BACK = 400, 6
BENT = {1e-3: 0.88, 1.5e-3: 0.98}  # m off: share that must be found of so many; 0.94 and 0.9999 are expected
OF = 200


def drawn(rng, bent=0.0):
    """The turn about a tool taught by four touches in the way they are proposed and then bent by so much, anywhere; and
    how far it is off in truth [m]."""
    found = calibrate(captures(*touches(4, PROPOSED, NOISE, int(rng.integers(2**31)))))
    way = rng.normal(size=3)
    off = bent * way / np.linalg.norm(way)
    truth = float(np.linalg.norm(TOOL + off - found.tool_point))
    return verify(found, START, lambda flange, _: flange.apply(TOOL + off)), truth


def test_a_good_tool_is_hardly_ever_sent_back_and_a_bent_one_is():
    """By the 95% of its own prediction one good tool in twenty was told to teach again."""
    seed = np.random.SeedSequence().entropy  # other cases in every run
    rng = np.random.default_rng(seed)
    sent_back = sum(not drawn(rng)[0].good for _ in range(GOOD))
    assert sent_back <= SENT_BACK, (sent_back, seed)
    for bent, least in BENT.items():
        turns = [drawn(rng, bent) for _ in range(OF)]
        assert np.mean([not found.good for found, _ in turns]) >= least, (bent, seed)
        # Whatever is off by more is found: one in four of those that passed was, the turn saw 82% of it at worst.
        assert all(found.good == (truth <= TOLERANCE) for found, truth in turns), (bent, seed)


def test_an_arm_follows_the_turn_or_says_why_it_stopped():
    robot = load_robot("ur10e")
    flange = robot.forward(robot.home)
    found = verify(result(), flange, true_tip, robot=robot, q_start=robot.home)
    if found.stopped:
        assert "stopped early" in found.sentence()
    assert found.joints is not None and len(found.joints) == len(found.trace) > 10
    assert found.wander < EXACT
    for q, pose in zip(found.joints, found.flanges, strict=True):
        np.testing.assert_allclose(robot.forward(q).position, pose.position, atol=IK)
