"""From a recording to MuJoCo: what was found in a log is exported and run along that very log."""

from __future__ import annotations

import numpy as np
import pytest

from app.cli import run
from app.diagnosis.dynamic.ready import ready
from app.diagnosis.export import export_model
from app.diagnosis.model import load_model
from app.diagnosis.models.dynamic.saved import predict
from app.recordings.arm import read_with_arm

mujoco = pytest.importorskip("mujoco", reason="the extra teachframe[mujoco] is not installed")

TORQUE = 1e-6  # Nm
#: MuJoCo's dry friction is a constraint: it holds its full value above this speed [rad/s].
SLIDING = 0.02
SMOOTH = ("viscous_friction:joint=1", "viscous_friction:joint=4", "rotor_inertia:joint=2", "payload")
DRY = (*SMOOTH, "coulomb_friction:joint=3")


def needed(exported, state):
    """(M, n) torque MuJoCo's inverse dynamics says, along the log's windows."""
    made = mujoco.MjModel.from_xml_string(exported.text)
    data = mujoco.MjData(made)
    out = np.empty(state.q.shape)
    for i, (q, qd, qdd) in enumerate(zip(state.q, state.qd, state.qdd, strict=True)):
        data.qpos[:], data.qvel[:], data.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(made, data)
        out[i] = data.qfrc_inverse
    return out - made.actuator_biasprm[:, 0]


@pytest.fixture(scope="module", params=[SMOOTH, DRY], ids=["smooth", "dry"])
def learnt(request, tmp_path_factory):
    """The exported model, what Teachframe's own says along the recording, and the windows."""
    folder = tmp_path_factory.mktemp("learnt")
    log, kept = folder / "log.csv", folder / "model.json"
    effects = [word for effect in request.param for word in ("--effect", effect)]
    made = [
        "simulate",
        "--robot",
        "ur10e",
        "--kind",
        "motion",
        "--seed",
        "5",
        "--samples",
        "3000",
        "--noise-share",
        "1e-4",
        *effects,
    ]
    assert run([*made, str(log)]) == 0
    log.write_text("# inertials: exact\n" + log.read_text())
    assert run(["diagnose", str(log), "--save-model", str(kept), "--json"]) == 0
    model = load_model(kept)
    table, robot = read_with_arm(log)
    given, motion, _ = ready(table, robot)
    found = predict(given, robot, motion, model.effects)
    own = found.samples.description + sum(added for _, added in found.parts)  # of the joints, not as recorded
    return export_model(robot, model, "mjcf"), own, found.samples.state, model, request.param


def test_the_recordings_own_trajectory_needs_the_torques_that_the_model_says(learnt):
    exported, own, state, model, hidden = learnt
    assert {effect.effect for effect in model.effects} >= {name.partition(":")[0] for name in hidden}
    # The log tells that dry friction changes its sign within a hundredth of a radian a second; MuJoCo's does at once.
    turns = [] if hidden is SMOOTH else ["the turn of dry friction (joint 3)"]
    assert [entry.what for entry in exported.left] == turns
    slides = np.abs(state.qd) > SLIDING
    if hidden is SMOOTH:
        slides[:] = True
    apart = np.abs(needed(exported, state) - own)
    assert np.mean(slides) > 0.6
    assert apart[slides].max() < TORQUE
