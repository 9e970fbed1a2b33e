"""The wizard as actions: touches of a spike from four orientations, then the strokes."""

import numpy as np

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.session.actions import Calculate, ChooseRobot, Move, Record
from app.session.state import as_tuple, robot_named
from app.simulation.world import default_world

TILTS = ((0.0, 0.0, 0.0), (0.6, 0.0, 0.0), (0.0, 0.6, 0.2), (-0.4, -0.4, 0.5))
STROKE = 0.15


def wizard_actions(robot="ur10e", seed=3, world=None):
    """Everything a person does for four touches and two strokes, and the world it was done in."""
    model = robot_named(robot)
    world = world or default_world(model)
    rng = np.random.default_rng(seed)
    actions = [ChooseRobot(robot)]
    home = model.home
    upright = world.tip(home).rotation
    origin = home
    for number, tilt in enumerate(TILTS, 1):
        aim = Pose.of(exp_so3(np.array(tilt)) @ upright, world.p_base_spike)
        near = solve_ik(model, aim, home, T_flange_tool=world.T_flange_tool_true, max_steps=200)
        touched = world.touch(near.q, rng)
        assert touched.reached
        actions += [Move(as_tuple(touched.q)), Record(f"touch{number}")]
        origin = touched.q
    for axis, step in ((0, "x"), (2, "z")):
        moved = world.stroke(origin, axis, STROKE if axis == 0 else -STROKE, rng)
        assert moved.reached
        actions += [Move(as_tuple(moved.q)), Record(step)]
    return [*actions, Calculate()], world
