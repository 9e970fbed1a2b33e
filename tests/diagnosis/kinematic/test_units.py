"""Lengths written in another unit than the column says: named where all are, never named wrongly where some are."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.kinematics import load_robot
from tests.diagnosis.kinematic.simulating import poses, tracker_rows, write_tracker


@pytest.fixture(scope="module")
def ur10e():
    robot = load_robot("ur10e")
    rng = np.random.default_rng(21)
    q = poses(robot, rng, 50)
    return robot, q, tracker_rows(robot, q, rng=rng)


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (1 / 1000.0, "millimetres and metres"),
        (1 / 10.0, "centimetres"),
        (1 / 25.4, "inches"),
    ],
)
def test_another_unit_is_said_and_undone(ur10e, tmp_path, factor, words):
    robot, q, points = ur10e
    found = diagnose(write_tracker(tmp_path / "u.csv", robot, q, points * factor), robot)
    assert [f.effect for f in found.findings] == ["wrong_convention"]
    assert words in str(found.findings[0].sentence)
    assert found.after.fit_rms < 1.0


@pytest.mark.parametrize("factor", [1 / 10.0, 1 / 25.4])
@pytest.mark.parametrize("which", ["half of the rows", "one column"])
def test_units_mixed_in_one_file_get_no_name(ur10e, tmp_path, factor, which):
    robot, q, points = ur10e
    mixed = points.copy()
    if which == "one column":
        mixed[:, :, 0] *= factor
    else:
        mixed[25:] *= factor
    found = diagnose(write_tracker(tmp_path / "u.csv", robot, q, mixed), robot)
    assert found.findings == ()
    assert any("do not belong to these poses" in str(note) for note in found.notes)
