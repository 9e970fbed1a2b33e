"""Residual against its drivers: the finding's own comes first and shows the law."""

import numpy as np
import pytest

from app.diagnosis.report.curves import binned, driver_curves
from app.kinematics import load_robot
from tests.diagnosis.report.cases import motion_case, static_case

#: Slope of a fault found again from the picture's numbers, against the fault put in.
SLOPE_TOLERANCE = 0.05


def test_the_driver_of_the_finding_stands_first():
    curves = driver_curves(static_case(), None)
    assert curves[0].driver == "gravity torque of joint 2 [Nm]" and curves[0].found
    assert not any(c.found for c in curves[1:])


def test_the_finding_flattens_the_curve():
    curve = driver_curves(static_case(), None)[0]
    assert np.ptp(curve.mean_after) < 0.4 * np.ptp(curve.mean_before)


def test_torque_errors_are_plotted_for_the_drivers_own_joint():
    curves = {c.driver: c for c in driver_curves(motion_case(), None)}
    assert curves["speed of joint 3 [deg/s]"].response == "torque error of joint 3 [Nm]"
    assert any(c.driver == "time [s]" and c.found for c in curves.values())  # the contact names a time


def test_outliers_are_not_plotted():
    case = static_case()
    assert all(len(c.x) <= case.evidence.kept.sum() for c in driver_curves(case, None))


def test_a_fault_of_a_joint_shows_as_that_joints_angle():
    import dataclasses

    robot = load_robot("ur10e")
    case = static_case()
    q = case.evidence.q[:, : robot.joint_count]
    off = 0.002 * q[:, 1]  # rad: joint 2 turns 0.2% too far
    wrong = q.copy()
    wrong[:, 1] += off
    nominal = robot.chain.frames(q).flange_positions
    measured = robot.chain.frames(wrong).flange_positions
    evidence = dataclasses.replace(
        case.evidence,
        q=q,
        drivers={"angle of joint 2 [deg]": np.degrees(q[:, 1])},
        points_predicted_before=nominal,
        points_predicted_after=measured,
        points_measured=measured,
    )
    curves = driver_curves(dataclasses.replace(case, evidence=evidence, findings=()), robot)
    assert curves[0].response == "joint 2 off by [deg]"
    slope = np.polyfit(curves[0].x, curves[0].before, 1)[0]
    assert slope == pytest.approx(0.002, rel=SLOPE_TOLERANCE)


def test_bins_explain_a_line_and_not_noise():
    rng = np.random.default_rng(0)
    x = rng.uniform(-1, 1, 400)
    assert binned(x, x, np.ones(400))[2] > 0.98
    assert binned(x, rng.normal(size=400), np.ones(400))[2] < 0.1


def test_a_driver_that_never_changes_gives_no_curve():
    import dataclasses

    case = static_case()
    evidence = dataclasses.replace(case.evidence, drivers={"temperature [degC]": np.full(60, 20.0)})
    assert driver_curves(dataclasses.replace(case, evidence=evidence, findings=()), None) == ()


def test_what_is_left_over_is_plotted_first_where_nothing_is_named():
    curves = driver_curves(static_case("unexplained"), None)
    assert curves[0].driver == "angle of joint 3 [deg]" and curves[0].found
