"""A base moved far in mid-recording, by centimetres and tens of degrees: nothing else is put down to it."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.geometry import exp_so3
from app.units import DEG_PER_RAD
from tests.diagnosis.kinematic.simulating import NOISE_MM, poses, term, tracker_rows, write_tracker

SHIFT = np.array([0.03, -0.03, 0.025])  # m, 49 mm
TURN = np.array([0.3, 0.2, -0.35])  # rad, 29 degrees


def _moved(arm, folder, seed, row, rows=80, terms=(), spoil=()):
    """A recording in which what stands at the instrument is another from `row` (0-based) on."""
    rng = np.random.default_rng([77, seed])
    q = poses(arm, rng, rows)
    points = tracker_rows(arm, q, terms, rng=rng)
    points[row:] = points[row:] @ exp_so3(TURN).T + SHIFT
    for k in spoil:
        points[k] += 0.02
    return write_tracker(folder / "moved.csv", arm, q, points)


@pytest.mark.parametrize(("seed", "row"), [(1, 12), (2, 40), (3, 66), (4, 25), (5, 53)])
def test_it_is_one_finding_with_its_row_and_its_turn(arm, tmp_path, seed, row):
    found = diagnose(_moved(arm, tmp_path, seed, row), arm, seed=seed)
    assert [f.effect for f in found.findings] == ["base_shift"] and found.verdict == "named"
    finding = found.findings[0]
    assert finding.where["from_row"] == row + 1
    turn = np.linalg.norm([p.value for p in finding.parameters if p.name.startswith("r")])
    assert turn == pytest.approx(np.linalg.norm(TURN) * DEG_PER_RAD, abs=0.1)
    assert found.after.heldout_rms < 1.25 * NOISE_MM


def test_the_arms_own_fault_is_told_beside_it(arm, tmp_path):
    hidden = (term("joint_zero", {"joint": 3}, 6e-3),)
    found = diagnose(_moved(arm, tmp_path, 6, 30, terms=hidden), arm)
    assert {(f.effect, f.where.get("joint")) for f in found.findings} == {
        ("base_shift", None),
        ("joint_zero", 3),
    }


def test_wrong_rows_beside_it_are_set_aside(arm, tmp_path):
    found = diagnose(_moved(arm, tmp_path, 7, 44, spoil=(10, 60)), arm)
    assert [f.effect for f in found.findings] == ["base_shift"]
    assert len(found.outliers) == 2


def test_wrong_rows_alone_are_no_move(arm, tmp_path):
    rng = np.random.default_rng(78)
    q = poses(arm, rng, 80)
    points = tracker_rows(arm, q, rng=rng)
    points[[9, 31, 58, 70]] += rng.normal(0, 0.05, (4, 1, 3))
    found = diagnose(write_tracker(tmp_path / "wrong.csv", arm, q, points), arm)
    assert found.findings == () and len(found.outliers) == 4
