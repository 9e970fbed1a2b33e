"""Every wizard mode can be demonstrated: its own points, through the session's actions, to its own truth."""

import numpy as np
import pytest

from app.calibration.modes import modes
from app.screens._training.demo_points import load_demo, reachable
from app.session import Session
from app.session.actions import Accept, Calculate, ChooseMode, Enter
from app.session.state import FIRST_ROBOT, robot_named
from app.units import from_mm

MODES = [mode for mode in modes().values() if mode.default_touches]
#: What 0.1 mm of touch noise leaves of the least determined tool (a plate tells only one direction a touch).
NEAR_M = from_mm(2.0)


def _id(mode):
    return mode.key


@pytest.mark.parametrize("mode", MODES, ids=_id)
def test_a_demonstration_goes_through_the_session_to_the_modes_own_truth(mode):
    demo, stops = reachable(robot_named(FIRST_ROBOT), mode)
    session = Session(robot=FIRST_ROBOT)
    known = demo.options.get("known_tool")
    if known is not None:
        session.do(ChooseMode("direct"))
        session.do(Enter(tuple(float(v) for v in known), (0.0, 0.0, 0.0)))
        session.do(Calculate())
        session.do(Accept("known"))
    state = session.do(load_demo(mode, demo, "demo"))
    assert state.mode == mode.key and not state.missing
    result = session.do(Calculate()).result.result
    assert np.linalg.norm(result.T_flange_tool.position - demo.T_flange_tool.position) < NEAR_M
    assert len(stops) == len(state.steps)


@pytest.mark.parametrize("mode", MODES, ids=_id)
def test_the_arm_goes_to_all_points_of_a_demonstration_but_one_at_most(mode):
    robot = robot_named(FIRST_ROBOT)
    demo, stops = reachable(robot, mode)
    assert sum(stop is None for stop in stops) <= 1
    for stop, capture in zip(stops, demo.captures, strict=True):
        if stop is not None:
            assert np.allclose(robot.forward(stop).position, capture.T_base_flange.position, atol=1e-4)
