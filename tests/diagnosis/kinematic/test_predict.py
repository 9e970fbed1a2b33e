"""A saved model moves the arm as its effects say."""

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.diagnosis.models.kinematic.predict import model_flange_matrix, tool_points

EXACT = 1e-12


def test_without_effects_the_flange_is_where_the_description_says(arm):
    q = arm.home + 0.3
    assert (
        np.abs(model_flange_matrix(arm, SavedModel("static", "arm"), q) - arm.flange_matrix(q)).max() < EXACT
    )


def test_a_zero_offset_is_a_turn_of_that_joint(arm):
    model = SavedModel("static", "arm", (ModelEffect("joint_zero", {"joint": 2}, {"offset": 0.01}),))
    q = arm.home + 0.3
    turned = q.copy()
    turned[1] += 0.01
    assert np.abs(model_flange_matrix(arm, model, q) - arm.flange_matrix(turned)).max() < EXACT
    tool = np.array([0.0, 0.02, 0.1])
    expected = arm.flange_matrix(turned)
    point = tool_points(arm, model, q[None], tool)[0]
    assert np.abs(point - (expected[:3, :3] @ tool + expected[:3, 3])).max() < EXACT


def test_a_slip_of_another_recording_has_happened_before(arm):
    model = SavedModel(
        "static", "arm", (ModelEffect("joint_slip", {"joint": 3, "from_row": 40}, {"step": 0.02}),)
    )
    q = arm.home + 0.3
    slipped = q.copy()
    slipped[2] += 0.02
    assert np.abs(model_flange_matrix(arm, model, q) - arm.flange_matrix(slipped)).max() < EXACT
