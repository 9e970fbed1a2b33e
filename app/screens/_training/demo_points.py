"""The points of a demonstration, and joints with which the arm reaches them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.calibration.captures import Capture, Demo, Mode
from app.kinematics import RobotModel, solve_ik
from app.session.actions import LoadPoints
from app.units import from_mm

_NOISE = from_mm(0.1)
_SEEDS = 6  # draws of a demonstration that are tried: the first the arm can go through wholly is shown
_TRIES = 12  # other postures from which a point is tried that lies far from the one before


def reachable(robot: RobotModel, mode: Mode) -> tuple[Demo, list[np.ndarray | None]]:
    """The demonstration of which the arm reaches most, and joints for each of its points; None where it does not."""
    best: tuple[Demo, list[np.ndarray | None]] | None = None
    for seed in range(_SEEDS):
        demo = mode.demo(touches=mode.default_touches, noise=_NOISE, seed=seed)
        stops = _stops(robot, demo.captures)
        if best is None or sum(s is None for s in stops) < sum(s is None for s in best[1]):
            best = demo, stops
        if all(stop is not None for stop in stops):
            break
    assert best is not None
    return best


def _stops(robot: RobotModel, captures: tuple[Capture, ...]) -> list[np.ndarray | None]:
    stops: list[np.ndarray | None] = []
    q, rng = robot.home, np.random.default_rng(0)
    others = rng.uniform(robot.lower, robot.upper, (_TRIES, robot.joint_count)) / 2.0
    for capture in captures:
        starts = (q, robot.home, *others)
        tried = (solve_ik(robot, capture.T_base_flange, start, max_steps=200) for start in starts)
        found = next((result for result in tried if result.reached), None)
        stops.append(None if found is None else found.q)
        q = q if found is None else found.q
    return stops


def load_demo(mode: Mode, demo: Demo, source: str) -> LoadPoints:
    """A demonstration's points as the action that loads them, as if from a file."""
    captures = [replace(capture, row=number) for number, capture in enumerate(demo.captures, 1)]
    return LoadPoints(
        source=source,
        title=mode.title,
        mode=mode.key,
        method="joint",
        roles=tuple(capture.role for capture in captures),
        rows=tuple(capture.row for capture in captures),
        columns=("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"),
        values=tuple(
            tuple(float(v) for v in (*capture.T_base_flange.position, *capture.T_base_flange.quaternion))
            for capture in captures
        ),
        steps=(0.0,) * 7,
        angles="quaternion",
    )
