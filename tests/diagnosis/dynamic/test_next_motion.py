"""What to record next where two explanations are close, and where no such log can tell."""

from __future__ import annotations

import numpy as np

from app.diagnosis.dynamic.diagnose import diagnose
from app.kinematics import load_robot
from tests.diagnosis.dynamic.simulator import add_load, measure, swing, write


def _found(tmp_path, change, seed=51):
    robot, rng = load_robot("ur10e"), np.random.default_rng(seed)
    run = swing(robot, rng, samples=2000)
    change(run)
    measure(run, rng, 0.02, 0.0)
    return diagnose(write(run, tmp_path / "log.csv", digits=7), robot), robot


def test_a_faint_law_brings_its_rivals_and_the_poses_that_tell_them_apart(tmp_path):
    def faint(run):
        # Some seven standard deviations: seen, but not its shape.
        sigma = 0.02 * max(float(np.std(run.torque[:, 3])), 0.5)
        run.torque[:, 3] += 7.0 * sigma / np.sqrt(len(run.t)) * np.sign(run.qd[:, 3])

    found, robot = _found(tmp_path, faint)
    (finding,) = found.findings
    assert finding.where["joint"] == 4
    named = {finding.effect, *(a.effect for a in finding.alternatives)}
    assert "coulomb_friction" in named and len(named) > 1
    assert 1 <= len(found.next_poses) <= 3
    assert robot.within_limits(np.array(found.next_poses), 0.0).all()
    assert any(note.startswith(f"to tell {finding.effect} from") for note in found.notes)


def test_what_no_log_of_this_arm_tells_apart_comes_with_the_recording_that_would(tmp_path):
    found, _ = _found(tmp_path, lambda run: add_load(run, 2.0, [0.02, -0.01, 0.09]))
    assert [f.effect for f in found.findings] == ["payload"]
    assert any("--reference" in note for note in found.notes)


def test_a_clean_log_asks_for_nothing(tmp_path):
    found, _ = _found(tmp_path, lambda run: None)
    assert not found.next_poses
