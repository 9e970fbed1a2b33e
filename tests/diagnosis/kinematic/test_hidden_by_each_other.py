"""Two effects at once that hide each other, and one that makes its own rows look like outliers."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.observations.pose_reading import read_static
from app.units import mm
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_touch, write_tracker

SHIFT = term("base_shift", {"body": "base", "from_row": 31}, [1e-3, -8e-4, 9e-4], turning=0.0)
ECCENTRIC = term("gear_eccentricity", {"joint": 2, "driver": "own_angle", "order": 1}, [2e-3, 2.5e-3])


def _recorded(arm, folder, seed, terms, rows=60, noise=0.05):
    rng = np.random.default_rng(seed)
    q = poses(arm, rng, rows)
    points = tracker_rows(arm, q, terms, rng=rng, noise=noise)
    return write_tracker(folder / "r.csv", arm, q, points, noise=noise)


@pytest.mark.parametrize("seed", range(3))
def test_a_knock_and_a_gear_error_are_both_named_though_neither_stands_alone(arm, tmp_path, seed):
    table = _recorded(arm, tmp_path, [11, seed], (SHIFT, ECCENTRIC))
    found = diagnose(table, arm)
    assert {(f.effect, f.where.get("joint", f.where.get("body"))) for f in found.findings} == {
        ("base_shift", "base"),
        ("gear_eccentricity", 2),
    }
    assert found.verdict == "named"


@pytest.mark.parametrize("seed", range(3))
def test_a_slip_late_in_the_recording_is_named_and_its_rows_are_kept(arm, tmp_path, seed):
    slip = term("joint_slip", {"joint": 5, "from_row": 47}, 9e-3)
    table = _recorded(arm, tmp_path, [12, seed], (slip,), noise=0.15)
    _, rows = plain_state(read_static(table, arm), ())
    assert (rows < 0.5).sum() >= 3  # to a fit without the slip they do not belong
    found = diagnose(table, arm)
    assert [(f.effect, f.where["joint"]) for f in found.findings] == [("joint_slip", 5)]
    assert abs(found.findings[0].where["from_row"] - 47) <= 2
    assert len(found.outliers) == 0


def test_targets_whose_names_were_mixed_up_are_no_base_that_moved_half_a_metre(arm, tmp_path):
    rng = np.random.default_rng(13)
    q = np.repeat(poses(arm, rng, 5), 16, axis=0) + rng.normal(0, 0.2, (80, arm.joint_count))
    table = write_touch(tmp_path / "t.csv", arm, q, rng.permutation(np.repeat(np.arange(5), 16)))
    found = diagnose(table, arm)
    shifts = [p.value for f in found.findings for p in f.parameters if f.effect == "base_shift"]
    assert all(abs(value) <= mm(0.1) for value in shifts)


def test_a_gear_cannot_run_out_by_a_whole_radian(arm, tmp_path):
    rng = np.random.default_rng(14)
    q = poses(arm, rng, 60)
    points = tracker_rows(arm, q, rng=rng)
    found = diagnose(write_tracker(tmp_path / "s.csv", arm, q, points[rng.permutation(60)]), arm)
    assert found.findings == ()


def test_a_stray_row_at_a_step_is_set_aside_and_makes_no_second_step(arm, tmp_path):
    rng = np.random.default_rng(15)
    q = poses(arm, rng, 60)
    points = tracker_rows(arm, q, (SHIFT,), rng=rng, noise=0.05)
    points[31] += 3e-3
    found = diagnose(write_tracker(tmp_path / "s.csv", arm, q, points, noise=0.05), arm)
    assert [f.effect for f in found.findings] == ["base_shift"]
    assert len(found.outliers) == 1
