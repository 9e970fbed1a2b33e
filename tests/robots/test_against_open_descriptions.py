"""Our own descriptions against those that came with recordings of real arms: the same arm, the same motion."""

import numpy as np
import pytest

from app.geometry import rot_z
from app.kinematics import load_robot
from tests.data_folder import data_folder

SAME = 2e-6  # m and unit vectors: the others round at 1e-8 rad and some figures at micrometres
UR10E_ROUNDING = 2e-3  # m: that description rounds lengths to millimetres

CASES = {
    "panda": ("mukca/panda.urdf", SAME, False),
    "iiwa14": ("mukca/iiwa14.urdf", SAME, False),
    "iiwa7": ("iiwa7_tracker/robot.urdf", SAME, False),
    "r2000ic_165f": ("fanuc_arcs/robot.urdf", SAME, False),
    "ur5": ("ur5_tracker/robot.urdf", SAME, True),
    "ur10e": ("ur10e_motion/robot.urdf", UR10E_ROUNDING, True),
}


@pytest.mark.parametrize("name", CASES)
def test_the_flange_goes_where_the_open_description_puts_it(name):
    path, tolerance, turned = CASES[name]
    ours, theirs = load_robot(name), load_robot(data_folder() / path)
    assert np.allclose(ours.lower, theirs.lower, atol=1e-3) and np.allclose(
        ours.upper, theirs.upper, atol=1e-3
    )
    rng = np.random.default_rng(0)
    base = rot_z(np.pi) if turned else np.eye(3)  # ROS turns UR's base by half a turn
    zero = np.zeros(ours.joint_count)
    flange = (base @ ours.forward(zero).rotation).T @ theirs.forward(zero).rotation  # one fixed turn, if any
    for q in rng.uniform(ours.lower, ours.upper, (20, ours.joint_count)):
        a, b = ours.forward(q), theirs.forward(q)
        assert np.abs(base @ a.position - b.position).max() < tolerance
        assert np.abs(base @ a.rotation @ flange - b.rotation).max() < SAME
