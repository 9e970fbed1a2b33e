"""Measured orientation takes part in the fit, by a noise that is estimated."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.kinematic.orientation import with_worth
from app.diagnosis.models.kinematic.cell import pose
from app.diagnosis.models.kinematic.situation import situation_for
from app.diagnosis.models.kinematic.terms import apply_terms
from app.diagnosis.observations.pose_reading import read_static
from app.geometry import exp_so3
from app.kinematics import load_robot
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_tracker

#: In the flange, on the last joint's axis: turning that joint does not move it.
ON_AXIS = np.array([0.0, 0.0, 0.15])
TURN_NOISE = 2e-4


@pytest.fixture(scope="module")
def ur10e():
    return load_robot("ur10e")


def _written(folder, robot, rng, terms, *, told=True, wrong=None, tool=ON_AXIS):
    """A recording with orientation; `wrong(q)` (m, 3) [rad] are errors of the marks beside their noise."""
    q = poses(robot, rng, 150)
    points = tracker_rows(robot, q, terms, rng=rng, reflectors=(tool,))
    situation = situation_for(robot, q)
    posed = pose(situation, apply_terms(situation, tuple(terms)), tool[None])
    seen = exp_so3(np.array([0.02, -0.03, 0.9])) @ posed.hand @ exp_so3(np.array([0.4, 1.1, -0.2]))
    error = rng.normal(0.0, TURN_NOISE, (len(q), 3)) + (0.0 if wrong is None else wrong(q))
    x, y, z, w = Rotation.from_matrix(exp_so3(error) @ seen).as_quat().T
    extra = {"qw": w, "qx": x, "qy": y, "qz": z} if told else None
    return write_tracker(folder / f"told{told}.csv", robot, q, points, extra=extra)


def test_what_only_orientation_shows_is_found_by_it(tmp_path, ur10e):
    """A wave of the last joint turns a reflector on its axis about itself."""
    wave = (term("gear_eccentricity", {"joint": 6, "driver": "own_angle", "order": 1}, [1.2e-3, -0.8e-3]),)
    with_it = diagnose(_written(tmp_path, ur10e, np.random.default_rng(1), wave), ur10e)
    without = diagnose(_written(tmp_path, ur10e, np.random.default_rng(1), wave, told=False), ur10e)
    assert [(f.effect, f.where["joint"]) for f in with_it.findings] == [("gear_eccentricity", 6)]
    for found, true in zip(with_it.findings[0].parameters, np.rad2deg([1.2e-3, -0.8e-3]), strict=True):
        assert abs(found.value - true) < 4.0 * found.std < 0.01
    assert not without.findings


def test_white_orientation_counts_in_full(tmp_path, ur10e):
    recording = read_static(_written(tmp_path, ur10e, np.random.default_rng(2), ()), ur10e)
    assert with_worth(recording, ()).turn_worth == 1.0


def test_marks_that_are_off_by_where_the_arm_stands_do_no_harm_to_points(tmp_path, ur10e):
    """Ten times the noise, smooth in the pose: at its word it would move the arm's zeros."""

    def wrong(q):
        return 2e-3 * np.stack([np.sin(q[:, 1]), np.cos(q[:, 2]), np.sin(q[:, 3] + q[:, 0])], axis=1)

    tool = np.array([0.05, -0.03, 0.2])
    zero = (term("joint_zero", {"joint": 3}, 4e-4),)
    table = _written(tmp_path, ur10e, np.random.default_rng(3), zero, wrong=wrong, tool=tool)
    assert with_worth(read_static(table, ur10e), ()).turn_worth < 0.2
    plain = _written(tmp_path, ur10e, np.random.default_rng(3), zero, wrong=wrong, tool=tool, told=False)
    assert diagnose(table, ur10e).after.heldout_rms < 1.01 * diagnose(plain, ur10e).after.heldout_rms
