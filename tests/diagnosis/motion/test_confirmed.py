"""The saved model is what the figures after the diagnosis were reached with, and nothing of what was withheld."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from app.diagnosis.judging import WITH, judge
from app.diagnosis.model import SavedModel
from app.diagnosis.motion import diagnose
from app.kinematics import load_robot
from tests.diagnosis.motion.simulator import add_load, measure, swing, write


def _unknown(run):
    """Friction on one joint; on another something that no library holds and some of its laws imitate in part."""
    run.torque[:, 4] += 1.5 * np.sign(run.qd[:, 4])
    run.torque[:, 1] += 30.0 * np.tanh(2.0 * run.q[:, 1]) * np.tanh(run.qd[:, 1])


def _load(run):
    add_load(run, 2.0, (0.02, 0.05, 0.08))
    run.torque[:, 2] += 4.0 * run.qd[:, 2]


def _late(run):
    run.torque[:, 2] += 8.0 * run.qd[:, 2]
    run.torque[:] = np.stack([np.interp(run.t - 0.02, run.t, c) for c in run.torque.T], axis=1)


def _factor(run):
    run.torque[:, 3] += 0.9 * np.sign(run.qd[:, 3])
    run.torque[:, 1] *= 1.25


@pytest.mark.parametrize("change", [_unknown, _load, _late, _factor])
def test_the_saved_model_leaves_what_the_diagnosis_left(tmp_path, change):
    robot, rng = load_robot("ur10e"), np.random.default_rng(21)
    run = swing(robot, rng, samples=1500)
    change(run)
    measure(run, rng, 0.02)
    table = write(run, tmp_path / "log.csv", digits=7)
    found = diagnose(table, robot)
    assert found.findings
    if change is _unknown:
        assert any("withheld" in note for note in found.notes)
    model = msgspec.convert(dict(found.model), SavedModel)
    assert [e.effect for e in model.effects] == [f.effect for f in found.findings]
    again = judge(table, robot, model).steps[WITH].fit_rms
    assert again == pytest.approx(found.after.fit_rms, rel=1e-3)
