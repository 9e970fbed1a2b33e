"""Follows the pendant's own proposals to a tool, without a browser: every robot, every mode.

    python -m tests.screens.follow [--robot NAME] [--mode KEY] [--seed N]

prints a row for each and ends with 1 where one of them leads to no good tool.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from app.calibration.modes import modes
from app.geometry import angle_between
from app.kinematics import robot_names
from app.session import Store
from app.session.actions import Accept, Calculate, ChooseMode, Enter
from app.session.motion import enabling, pace
from app.session.owners import owner_of
from app.session.state import DIRECT
from app.simulation.pointing import POINTED
from app.units import deg, mm
from app.workers.hub import Hub
from tests.desk import Desk, until

#: Touches where the mode's own number is not the one to try.
TOUCHES = {"touch_many": 8}
#: Five standard deviations of such touches, about; a plate tells a third of what a spike tells.
TOOL_MM, PLATE_MM, AXIS_DEG = 1.5, 3.0, 1.0
#: Which of the tool's axes a mode teaches; the others stay the flange's.
AXES = {"touch_z": "z", "spin": "z"} | dict.fromkeys(
    ("touch_zx", "touch_xy", "six_point_xz", "six_point_xy", "abc_world", "abc_two_point", "direct"), "xyz"
)
BRISK = 20.0  # the arm is so many times as quick: its speed is not what is tried


def follow(desk, mode):
    """Ghost, touch, record for every touch; what shows the point, record, for every other."""
    context = desk.context
    true = context.world.T_flange_tool_true
    if mode in (DIRECT, "reference"):  # a drawing's numbers; for the other, the tool that is known
        typed(desk, true)
        if mode == DIRECT:
            return
        desk.does(lambda: (context.do(Calculate()), context.do(Accept("known"))))
    desk.does(lambda: context.do(ChooseMode(mode, TOUCHES.get(mode))))
    view = desk.view("deciding")
    for step in desk.state.steps:
        if "touch" in step.roles and modes()[mode].least_touches >= 3:
            until(lambda: view._next_touch.proposal or view._next_touch._refused, "the proposal")
            assert view._next_touch.proposal is not None, view._next_touch._refused
            desk.moves(view._next_touch.go)
        before = desk.q.copy()
        desk.moves(view._help)
        if {"touch", "origin", "known"} & set(step.roles):
            assert context.world.touching(desk.q), (step.key, context.log[-2:])
        elif step.key not in ("spin1",):
            assert not np.allclose(desk.q, before), (step.key, context.log[-2:])
        if step.role in POINTED:
            assert context.world.off(desk.q, step.roles) <= context.world.contact_distance, step.key
        desk.does(view._record_next)
        assert step.key in desk.state.captures, (step.key, context.log[-2:])
    desk.does(view._compute)


def typed(desk, tool):
    x, y, z = (float(v) for v in tool.position)
    a, b, c = (float(v) for v in _zyx(tool.rotation))
    desk.does(lambda: desk.context.do(ChooseMode(DIRECT)))
    desk.does(lambda: (desk.context.do(Enter((x, y, z), (a, b, c), "ZYX")), desk.context.do(Calculate())))


def _zyx(rotation):
    from app.geometry import CONVENTIONS

    return CONVENTIONS["ZYX"].from_rotation(rotation)


def errors(desk):
    """Of the tool point [mm] and of the axes that were taught [deg]."""
    result, true = desk.state.result.result, desk.context.world.T_flange_tool_true
    taught = AXES.get(desk.state.mode, "")
    found, real = result.T_flange_tool.rotation, true.rotation
    turned = 0.0
    if taught == "xyz":
        turned = deg(float(angle_between(found, real)))
    elif taught:
        turned = deg(float(np.arccos(np.clip(found[:, 2] @ real[:, 2], -1.0, 1.0))))
    return mm(float(np.linalg.norm(result.tool_point - true.position))), turned


def why_not_good(desk):
    """What is wrong with the tool that was found; "" where it is good."""
    solved = desk.state.result
    if solved is None:
        return f"no result: {desk.context.log[-2:]}"
    away, turned = errors(desk)
    codes = [warning.code for warning in solved.result.warnings]
    if solved.light.colour == "red":
        return f"red: {', '.join(codes)}"
    if "mixed_configuration" in codes:
        return "the wrist was flipped"
    limit = PLATE_MM if desk.state.mode == "plane" else TOOL_MM
    return f"{away:.2f} mm, {turned:.2f} deg off" if away > limit or turned > AXIS_DEG else ""


def main():
    parser = argparse.ArgumentParser(prog="python -m tests.screens.follow")
    parser.add_argument("--robot", action="append")
    parser.add_argument("--mode", action="append")
    parser.add_argument("--seed", type=int, default=3)
    asked = parser.parse_args()
    enabling.SILENCE = 1e6
    pace.TIP_SPEED, pace.TURN_SPEED = BRISK * pace.TIP_SPEED, BRISK * pace.TURN_SPEED
    bad = 0
    for robot in asked.robot or robot_names():
        for mode in asked.mode or modes():
            with tempfile.TemporaryDirectory() as folder:
                hub, begun = Hub(Store(Path(folder)), robot=robot, linger=0.05), time.process_time()
                try:
                    desk = Desk(hub.enter(owner_of("somebody")))
                    desk.idle()
                    desk.drive.override = 1.0
                    desk.context.rng = np.random.default_rng(asked.seed)
                    try:
                        follow(desk, mode)
                        why = why_not_good(desk)
                    except AssertionError as error:
                        why = f"dead end: {error}"
                    said = ""
                    if desk.state.result is not None:
                        said = f"{desk.state.result.light.colour:<7}" + "{:6.2f} mm {:6.2f} deg".format(
                            *errors(desk)
                        )
                        codes = [warning.code for warning in desk.state.result.result.warnings]
                        said += f"  {', '.join(codes)}" if codes else ""
                finally:
                    hub.close()
            bad += bool(why)
            used = time.process_time() - begun
            print(f"{robot:<13}{mode:<15}{used:5.1f} s  {said}{'  BAD: ' + why if why else ''}", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
