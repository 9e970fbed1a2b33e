"""The saved model is the whole fit: on its own rows it gives what was said, on others what lasts."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose, diagnose_together
from app.diagnosis.dynamic.judging import judged
from app.diagnosis.model import SavedModel
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import add_load, measure, swing, write

LEVELS = np.array([6.0, 6.0, 4.0, 1.0, 1.0, 1.0])  # Nm


@pytest.fixture(scope="module")
def robot():
    return load_robot("ur10e")


def _log(robot, path, seed, *, event=False):
    rng = np.random.default_rng(seed)
    run = swing(robot, rng, samples=1500)
    run.torque += LEVELS * (np.sign(run.qd) + run.qd)
    if event:
        add_load(run, 1.5, [0.0, 0.02, 0.08], since=8.2)
    measure(run, rng, 0.02)
    return write(run, path, digits=7)


def _model(found) -> SavedModel:
    return msgspec.convert(dict(found.model), SavedModel)


def test_a_model_reproduces_what_was_said_of_its_own_rows_events_included(tmp_path, robot):
    table = _log(robot, tmp_path / "a.csv", 81, event=True)
    found = diagnose(table, robot)
    assert "payload_change" in [f.effect for f in found.findings]
    _, after = judged(table, robot, _model(found)).qualities
    assert after.fit_rms == pytest.approx(found.after.fit_rms, rel=1e-9)
    assert after.heldout_rms == pytest.approx(found.after.heldout_rms, rel=1e-9)


def test_what_happened_in_one_log_is_left_out_of_another(tmp_path, robot):
    model = _model(diagnose(_log(robot, tmp_path / "a.csv", 81, event=True), robot))
    other = _log(robot, tmp_path / "b.csv", 82)
    before, after = judged(other, robot, model).qualities
    clean = diagnose(other, robot).after.fit_rms
    assert after.fit_rms < 1.05 * clean < 0.2 * before.fit_rms


def test_the_budget_ends_where_the_model_does(tmp_path, robot):
    found = diagnose(_log(robot, tmp_path / "a.csv", 83), robot)
    (friction,) = found.families
    assert friction.family == "friction" and friction.share > 0.95
    assert friction.heldout_rms_after == pytest.approx(found.after.heldout_rms, rel=0.05)
    assert set(friction.members) == set(range(len(found.findings)))


def test_what_two_logs_teach_together_carries_to_a_third_as_well_as_the_better_of_them(tmp_path, robot):
    first, second, third = (_log(robot, tmp_path / f"{seed}.csv", seed) for seed in (84, 85, 86))
    single = [
        judged(third, robot, _model(diagnose(table, robot))).qualities[1].fit_rms for table in (first, second)
    ]
    both = judged(third, robot, _model(diagnose_together([first, second], robot))).qualities[1].fit_rms
    assert both < 1.01 * min(single)
