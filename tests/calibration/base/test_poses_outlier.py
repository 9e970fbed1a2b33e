"""A base from poses: rows that the others exclude are named and set aside; good rows never are."""

import json

import numpy as np
import pytest

from app.calibration.base.poses import base_from_poses
from app.calibration.base.run import run_base
from app.cli import run
from app.geometry import Pose, exp_so3
from app.kinematics import load_robot
from tests.calibration.base.files import codes

TRUTH = Pose.of(exp_so3(np.array([0.02, -0.01, 2.5])), np.array([-6.1, -4.5, -0.6]))
REFLECTOR = np.array([0.015, -0.005, 0.37])
NOISE = 1e-4  # m, one coordinate
HEADER = "# kind: tracker\n# robot: ur5\nq1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,x_mm,y_mm,z_mm\n"
FIRST_ROW = 4


def recording(count, seed):
    """q (n, 6) and points (n, 3) [m] of an arm as described, in a tracker's frame."""
    rng = np.random.default_rng(seed)
    robot = load_robot("ur5")
    middle = np.array([0.0, -1.4, 1.3, -0.9, -1.5, 0.0])
    q = middle + rng.uniform(-1.0, 1.0, (count, 6)) * np.array([1.5, 0.7, 0.8, 1.0, 1.0, 1.5])
    frames = robot.chain.frames(q)
    points = TRUTH.apply(frames.flange_positions + frames.flange_rotations @ REFLECTOR)
    return frames, q, points + rng.normal(0.0, NOISE, points.shape)


def written(tmp_path, q, points):
    path = tmp_path / "tracker.csv"
    rows = [
        ",".join([*(f"{v:.6f}" for v in a), *(f"{1e3 * v:.3f}" for v in p)])
        for a, p in zip(q, points, strict=True)
    ]
    path.write_text(HEADER + "\n".join(rows) + "\n")
    return path


@pytest.mark.parametrize("off_mm", [3.0, 40.0, 400.0, 4000.0])
def test_one_wrong_row_is_named_set_aside_and_moves_nothing(off_mm, tmp_path):
    _, q, points = recording(20, 1)
    points[11] += 1e-3 * off_mm * np.array([0.6, -0.64, 0.48])
    result = run_base([written(tmp_path, q, points)])
    assert codes(result) == {"outlier"}
    (warning,) = result.to_json()["warnings"]
    assert f"row {FIRST_ROW + 11} " in warning["message"]
    (robot,) = result.to_json()["robots"]
    (outlier,) = robot["outliers"]
    assert outlier["row"] == FIRST_ROW + 11 and outlier["off_mm"] == pytest.approx(off_mm, abs=1.0)
    assert np.linalg.norm(result.bases[0].T_tracker_base.position - TRUTH.position) < 5e-4
    assert robot["heldout_rms_mm"] < 0.5


def test_several_wrong_rows_that_hide_each_other_are_all_named():
    frames, _, points = recording(24, 2)
    wrong = [3, 4, 5, 17]
    points[wrong[:3]] += np.array([0.2, 0.0, 0.1])  # a reflector that sat elsewhere for three poses
    points[17] += np.array([0.0, 1.5, 0.0])
    found = base_from_poses(frames.flange_rotations, frames.flange_positions, points)
    assert list(found.aside) == wrong
    assert np.linalg.norm(found.T_tracker_base.position - TRUTH.position) < 5e-4


def test_rows_with_noise_alone_are_never_set_aside():
    for seed in range(60):
        frames, _, points = recording(8 + seed % 20, seed)
        found = base_from_poses(frames.flange_rotations, frames.flange_positions, points)
        assert found.aside == ()


def test_where_half_the_rows_are_wrong_nobody_is_set_aside():
    frames, _, points = recording(20, 3)
    points[::2] += np.random.default_rng(0).normal(0.0, 0.3, (10, 3))
    found = base_from_poses(frames.flange_rotations, frames.flange_positions, points)
    assert len(found.aside) <= 5


def test_the_command_names_the_row_on_its_page_and_in_its_json(tmp_path, capsys):
    _, q, points = recording(20, 1)
    points[11] += np.array([0.4, 0.0, 0.0])
    path = written(tmp_path, q, points)
    assert run(["base", str(path)]) == 0
    assert "outlier: row 15 (" in capsys.readouterr().out
    assert run(["base", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["robots"][0]["outliers"][0]["row"] == 15


@pytest.mark.parametrize("factor", [1e-3, 1e3, 1 / 25.4, 25.4])
def test_lengths_in_another_unit_are_told_with_the_factor(factor, tmp_path):
    _, q, points = recording(20, 5)
    result = run_base([written(tmp_path, q, factor * points)])
    (warning,) = result.to_json()["warnings"]
    assert warning["code"] == "units" and f"{1 / factor:.4g}" in warning["message"]


def test_lengths_in_their_own_unit_are_not_doubted():
    for seed in range(20):
        frames, _, points = recording(12, seed)
        rough = points + np.random.default_rng(seed).normal(
            0.0, 0.004, points.shape
        )  # an arm far from its description
        assert base_from_poses(frames.flange_rotations, frames.flange_positions, rough).scale is None
