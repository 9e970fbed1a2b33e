"""A real arm's log to MuJoCo: along it MuJoCo needs what Teachframe's laws say, and what MuJoCo lacks is told.

Five parts of the torque are looked at one by one: the bare description; the laws that MuJoCo has, with masses that a
body can have; the laws that are listed as left out; what the nearest masses of a body are off the fitted ones; and by
how much dry friction that turns over some speed is less than one that turns at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from app.cli import run
from app.diagnosis.dynamic.ready import ready
from app.diagnosis.export import export_model
from app.diagnosis.export.carrying import carried, left_of
from app.diagnosis.model import SavedModel, load_model
from app.diagnosis.models.dynamic.saved import predict
from app.kinematics.dynamics import PER_LINK, inertial_parameters, inverse_dynamics
from app.kinematics.regressor import torque_regressor
from app.recordings.arm import read_with_arm
from tests.data_folder import data_folder
from tests.diagnosis.export.test_mjcf_on_a_recording import SLIDING, TORQUE, needed

RECORDINGS = ["ur10e_motion/run_a.csv", "lwa4p_motion/run_a.csv"]


@dataclass(frozen=True, eq=False)
class Learnt:
    """A real log with the model learnt from it."""

    robot: object
    model: SavedModel
    state: object
    parts: dict[int, np.ndarray]
    description: np.ndarray


@pytest.fixture(scope="module", params=RECORDINGS)
def learnt(request, tmp_path_factory):
    log, kept = data_folder() / request.param, tmp_path_factory.mktemp("real") / "model.json"
    assert run(["diagnose", str(log), "--save-model", str(kept), "--json"]) == 0
    model = load_model(kept)
    table, robot = read_with_arm(log)
    given, motion, _ = ready(table, robot)
    found = predict(given, robot, motion, model.effects)
    return Learnt(robot, model, found.samples.state, dict(found.parts), found.samples.description)


def test_the_bare_description_needs_the_same_torques_along_the_log(learnt):
    state = learnt.state
    bare = export_model(learnt.robot, SavedModel("motion", learnt.robot.name, ()), "mjcf")
    own = inverse_dynamics(learnt.robot, state.q, state.qd, state.qdd)
    assert len(own) > 500 and np.abs(own).max() > 10.0
    assert np.abs(needed(bare, state) - own).max() < TORQUE


def test_the_laws_mujoco_has_are_equal_and_the_rest_is_told_with_its_size(learnt):
    robot, model, state = learnt.robot, learnt.model, learnt.state
    exported, arm = export_model(robot, model, "mjcf"), carried(robot, model)
    told = {entry.what for entry in exported.left}
    left = {k for k, effect in enumerate(model.effects) if left_of(effect).what in told}
    assert len(model.effects) - len(left) > 3, "the laws that both have"

    written = np.concatenate([joint.inertial for joint in arm.joints])
    regressor = torque_regressor(robot, state.q, state.qd, state.qdd)
    fitted = inertial_parameters(robot)
    for effect in model.effects:
        if effect.effect == "link_inertia":
            link = int(effect.where["link"]) - 1
            names = ("mass", "mx", "my", "mz", "ixx", "ixy", "iyy", "ixz", "iyz", "izz")
            fitted[link * PER_LINK :][:PER_LINK] += [effect.parameters.get(name, 0.0) for name in names]
    own = learnt.description + sum(learnt.parts.values())
    lacks = sum((learnt.parts[k] for k in left if k in learnt.parts), np.zeros_like(own))
    nearest = regressor @ (written - fitted)
    turns = np.zeros_like(own)  # dry friction that changes its sign over some speed, as real joints' does
    for k, effect in enumerate(model.effects):
        if effect.effect == "coulomb_friction" and k not in left:
            joint = int(effect.where["joint"]) - 1
            sharp = effect.parameters["coulomb"] * np.sign(state.qd[:, joint])
            turns[:, joint] += sharp - learnt.parts[k][:, joint]
            assert f"the turn of dry friction (joint {joint + 1})" in told
    slides = np.abs(state.qd) > SLIDING
    apart = np.abs(needed(exported, state) - (own - lacks + nearest + turns))
    print(f"{np.mean(slides):.2f} slide; apart {apart[slides].max():.1e} Nm; ", end="")
    print(
        f"left out {np.abs(lacks).max():.3g} Nm, masses {np.abs(nearest).max():.3g} Nm of {np.abs(own).max():.3g}"
    )
    assert np.mean(slides) > 0.5
    assert apart[slides].max() < TORQUE
    for k in left:  # each law that is left out, with its values
        assert str(left_of(model.effects[k]).size) in exported.text
    for k, joint in enumerate(arm.joints):  # each body whose masses were moved, by how much
        if np.abs((written - fitted)[PER_LINK * k :][:PER_LINK]).max() > 0:
            assert any(entry.what.startswith(f"masses of {joint.body}") for entry in exported.left)
