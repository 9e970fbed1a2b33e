"""Rows that are left out are left out of every driver."""

from dataclasses import fields

import numpy as np

from app.diagnosis.observations.pose_reading import read_static
from app.kinematics import load_robot
from tests.diagnosis.kinematic.simulating import poses, tracker_rows, write_tracker


def test_every_driver_has_the_rows_that_are_kept_and_no_others(tmp_path):
    robot, rng = load_robot("ur5"), np.random.default_rng(4)
    q = poses(robot, rng, 23)
    table = write_tracker(tmp_path / "r.csv", robot, q, tracker_rows(robot, q, rng=rng))
    whole = read_static(table, robot)
    keep = np.arange(23) % 3 > 0
    part = whole.subset(keep)
    for f in fields(whole.situation):
        rows = getattr(whole.situation, f.name)
        if isinstance(rows, np.ndarray) and len(rows) == 23:
            assert (getattr(part.situation, f.name) == rows[keep]).all(), f.name
