"""A saved model in the practice cell: the arm really stands where it says, the controller shows what it always does."""

from dataclasses import replace

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.session.state import robot_named
from app.simulation.faults import faults_of
from app.simulation.world import default_world

OFFSET = 0.004  # rad
EXACT = 1e-9
TOUCHED = 3e-5  # m: how far a hand may stop from where it aims


def wrong_world(*effects):
    world = default_world(robot_named("ur10e"))
    return replace(world, faults=faults_of(SavedModel("static", "ur10e", effects)), touch_sigma=0.0)


ZERO = ModelEffect("joint_zero", {"joint": 3}, {"offset": OFFSET})


def test_the_arm_stands_where_the_model_says_and_the_controller_does_not_know():
    world = wrong_world(ZERO)
    q = np.array(world.robot.home)
    turned = q + OFFSET * np.eye(6)[2]
    assert np.abs(world.true_flange(q).matrix - world.robot.forward(turned).matrix).max() < EXACT
    assert np.abs(world.shown_flange(q).matrix - world.robot.forward(q).matrix).max() < EXACT


def test_a_hand_still_brings_the_true_tip_to_the_spike():
    world = wrong_world(
        ZERO, ModelEffect("joint_compliance", {"joint": 2, "driver": "gravity_torque"}, {"compliance": 4e-5})
    )
    found = world.touch(np.array(world.robot.home), np.random.default_rng(0))
    assert found.reached and world.distance(found.q) < TOUCHED
    shown = world.shown_flange(found.q) @ world.T_flange_tool_true
    assert np.linalg.norm(shown.position - world.p_base_spike) > 1e-3  # which the controller takes for a miss


def test_without_a_model_nothing_is_different():
    world = default_world(robot_named("ur10e"))
    q = np.array(world.robot.home)
    assert np.array_equal(world.true_flange(q).matrix, world.shown_flange(q).matrix)
