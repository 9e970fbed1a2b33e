"""How dry friction turns over: at once, over a speed, or over a way on which the gear gives before it slides."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from app.diagnosis.dynamic.diagnose import diagnose
from app.diagnosis.dynamic.judging import judged
from app.diagnosis.dynamic.ready import ready
from app.diagnosis.dynamic.sharpness import learnt_turns
from app.diagnosis.model import SavedModel
from app.diagnosis.models.dynamic.hypothesis import as_given
from app.diagnosis.models.dynamic.samples import take
from app.diagnosis.models.dynamic.state import turned
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import Swing, measure, swing, write

DRY = np.array([20.0, 30.0, 15.0, 4.0, 3.0, 2.0])  # Nm
WAY = 0.02  # rad
FINER = 10  # steps between two samples over which the way is followed


@pytest.fixture(scope="module")
def arm():
    return load_robot("ur10e")


def _creeping(run: Swing, way: float) -> np.ndarray:
    """(M, n) dry friction that turns over a way, step by step, z' = qd (1 - z sign(qd)) / way."""
    out, z = np.zeros_like(run.q), np.sign(run.qd[0])
    out[0] = z
    for k, moved in enumerate(np.diff(run.q, axis=0) / FINER, start=1):
        for _ in range(FINER):
            z = z + moved / way * (1.0 - z * np.sign(moved))
        out[k] = z
    return out


def test_friction_that_turns_over_a_way_has_no_other_name_and_carries_to_another_log(tmp_path, arm):
    logs = []
    for seed in (21, 22):
        rng = np.random.default_rng(seed)
        run = swing(arm, rng, samples=2500)
        run.torque += DRY * _creeping(run, WAY)
        measure(run, rng, 0.02)
        logs.append((run, write(run, tmp_path / f"log{seed}.csv", speed=True, header="# inertials: exact\n")))
    found = diagnose(logs[0][1], arm)
    assert {f.effect for f in found.findings} == {"coulomb_friction"}
    level = {f.where["joint"]: f.parameters[0].value for f in found.findings}
    assert all(abs(level[j + 1] / DRY[j] - 1.0) < 0.05 for j in range(6))
    model = msgspec.convert(dict(found.model), SavedModel)
    carried = judged(logs[1][1], arm, model).qualities[1].fit_rms
    assert carried < 1.1 * float(np.sqrt(np.mean(logs[1][0].noise ** 2)))


@pytest.mark.parametrize(("width", "memory"), [(0.03, 0.0), (0.03, 0.9)])
def test_the_speed_over_which_friction_turns_is_learnt_under_noise_that_remembers(
    tmp_path, arm, width, memory
):
    rng = np.random.default_rng(31)
    run = swing(arm, rng, samples=3000)
    run.torque += DRY * np.tanh(run.qd / width)
    measure(run, rng, 0.02, memory)
    log, motion, _ = ready(write(run, tmp_path / "log.csv", speed=True), arm)
    widths, slips = learnt_turns(take(log, arm, motion, as_given(6)), {})
    assert not slips[:3].any()
    assert np.all(np.abs(np.log(widths[:3] / width)) < 0.7)


def test_at_rest_friction_keeps_what_the_motion_before_has_left():
    q = np.concatenate([np.linspace(0.0, 1.0, 200), np.ones(50), np.linspace(1.0, 0.0, 2000)])
    z = turned(np.gradient(q)[:, None], q, 1e-3, WAY)
    assert z[199] == pytest.approx(1.0)
    assert z[249] == pytest.approx(1.0)
    back = 250 + int(WAY * 2000)  # a way after the turn: 1 - 2 (1 - 1/e)
    assert z[back] == pytest.approx(2.0 / np.e - 1.0, abs=0.03)
    assert z[-1] == pytest.approx(-1.0)
