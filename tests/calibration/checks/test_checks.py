"""Each thing that can go wrong is caught by name, with the advice; and nothing is said where nothing is wrong."""

import numpy as np
import pytest

from app.calibration.captures import Capture
from app.calibration.checks import refusal
from app.calibration.checks.tool_active import SessionTool
from app.calibration.modes import modes
from app.calibration.points import read_points
from app.calibration.solving import solve_file
from app.calibration.tool import calibrate
from app.errors import DegenerateGeometryError
from app.geometry import CONVENTIONS, Pose, exp_so3, rot_x, rot_z
from app.kinematics import load_robot
from app.units import deg, mm
from tests.calibration.drawing import TOOL, captures, stroke, touches

NOISE = 1e-4
X, Y, Z = np.eye(3)


def codes(result):
    return [w.code for w in result.warnings]


def said(result, code):
    return next(w for w in result.warnings if w.code == code)


def taught(strokes, count=5, seed=0):
    """Touches, the last one the origin, and strokes by role."""
    points = captures(*touches(count, 0.6, NOISE, seed))
    last = points[-1]
    points[-1] = Capture(last.step_key, "touch+origin", last.T_base_flange, None, last.row)
    return points + [stroke(last, role, *rest) for role, *rest in strokes]


def write(path, rows, head="# angles: ZYX", columns="x_mm,y_mm,z_mm,a_deg,b_deg,c_deg"):
    lines = [head, "role," + columns, *("touch," + ",".join(f"{v:.6f}" for v in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def written(convention, seed=0, count=5):
    rotations, positions = touches(count, 0.6, NOISE, seed, None)
    rotations = rotations @ rot_x(np.pi - 0.4)
    positions = touches(count, rotations=rotations, noise=NOISE, seed=seed)[1]
    return mm(positions), CONVENTIONS[convention].from_rotation(rotations)


@pytest.mark.parametrize("key", modes())
def test_a_sound_demonstration_raises_no_warning(key):
    mode = modes()[key]
    demo = mode.demo(touches=mode.default_touches, noise=NOISE, seed=4)
    assert codes(mode.solve(demo.captures, **demo.options)) == []


def test_too_few_and_one_axis_have_the_shape_of_warnings():
    for points, code in ((touches(2), "too_few"), (touches(rotations=rot_z(np.arange(4.0) / 3)), "one_axis")):
        with pytest.raises(DegenerateGeometryError) as caught:
            calibrate(captures(*points))
        warning = refusal(caught.value)
        assert warning.code == code and warning.severe and warning.advice


def test_touches_almost_about_one_axis_name_the_axis():
    rotations = rot_z(np.linspace(0, 2, 5)) @ exp_so3(np.outer(np.array([0.0, 0.03, 0.0, -0.03, 0.02]), X))
    result = calibrate(captures(*touches(rotations=rotations, noise=1e-5)))
    message = said(result, "one_axis").message
    along = np.array([float(v) for v in message.partition("(")[2].partition(")")[0].split(",")])
    assert along @ Z > 0.99 and "less certain" in message


def test_touches_are_compared_with_all_others_not_only_the_first():
    rotations, _ = touches(4, 0.6)
    rotations[3] = rotations[1] @ rot_x(0.03)
    warning = said(calibrate(captures(*touches(rotations=rotations, noise=NOISE))), "too_alike")
    assert "2 and 4 (1.7 degrees)" in warning.message and "touch 4" in warning.advice


@pytest.mark.parametrize("different, alike", [(3, True), (4, False), (5, False), (6, False)])
def test_a_touch_that_comes_again_is_a_fault_only_where_it_stands_for_one_of_four(different, alike):
    rotations, _ = touches(different, 0.6)
    again = np.concatenate([rotations, rotations[:1]])
    result = calibrate(captures(*touches(rotations=again, noise=NOISE)))
    assert ("too_alike" in codes(result)) == alike


def test_beside_a_known_tool_one_orientation_is_enough():
    demo = modes()["reference"].demo(touches=1, noise=NOISE)
    known, new = demo.captures
    again = Capture("touch2", "touch", new.T_base_flange, None, 3)
    result = modes()["reference"].solve([known, new, again], **demo.options)
    assert "too_alike" not in codes(result)


def test_many_touches_in_three_orientations_are_alike_however_many_they_are():
    rotations, _ = touches(3, 0.6)
    result = calibrate(captures(*touches(rotations=np.tile(rotations, (4, 1, 1)), noise=NOISE)))
    assert "too_alike" in codes(result)


@pytest.mark.parametrize("start", [3, 4, 5])
def test_a_bumped_spike_is_found_with_the_touch_it_starts_at(start):
    rotations, positions = touches(7, 0.6, NOISE, start)
    positions[start - 1 :] += np.array([0.002, -0.001, 0.0])
    warning = said(calibrate(captures(rotations, positions)), "bumped")
    assert f"from touch {start} on" in warning.message and warning.severe
    assert "spike" in warning.message


def test_a_bent_tip_is_told_from_a_moved_spike():
    rotations, _ = touches(8, 0.6)
    tools = np.array([TOOL] * 4 + [TOOL + 0.003 * X] * 4)
    positions = np.array([1.0, 0.1, 0.4]) - np.einsum("nij,nj->ni", rotations, tools)
    positions += np.random.default_rng(0).normal(0, NOISE, (8, 3))
    message = said(calibrate(captures(rotations, positions)), "bumped").message
    assert "from touch 5 on" in message and "tip bent by 3.0" in message


def test_one_touch_that_missed_is_named_and_not_dropped():
    rotations, positions = touches(6, 0.6, NOISE, 2)
    positions[3] += np.array([0.0, 0.003, 0.0])
    result = calibrate(captures(rotations, positions))
    assert "touch 4 lies" in said(result, "bumped").message
    assert len(result.per_point) == 6 and (result.weights == 1).all()


def test_nothing_bumped_is_rarely_reported_as_bumped():
    told = [
        w
        for s in range(300)
        for w in calibrate(captures(*touches(6, 0.6, NOISE, s))).warnings
        if w.code == "bumped"
    ]
    assert len(told) <= 9  # 1 in 100 is meant; 10 of 300 has a chance of 1 in 1000
    assert sum(w.severe for w in told) <= 2  # 1 in 1000 is meant; 3 of 300 has a chance of 4 in 1000


def test_an_orientation_that_changed_between_origin_and_stroke_is_named():
    result = calibrate(taught([("x", 0.15 * X), ("z", 0.15 * Z, rot_z(0.1))]))
    warning = said(result, "orientation_changed")
    assert "5.7 degrees" in warning.message and "Z" in warning.message and warning.severe


def test_a_short_stroke_says_what_noise_does_to_the_axis():
    warning = said(calibrate(taught([("x", 0.15 * X), ("z", 0.02 * Z)])), "short_stroke")
    assert "along Z" in warning.message and "degrees" in warning.message and "100 mm" in warning.advice


def test_strokes_that_are_nearly_parallel_are_severe_and_parallel_ones_refused():
    result = calibrate(taught([("x", 0.15 * X), ("z", 0.15 * (X + 0.2 * Z))]))
    assert said(result, "nearly_parallel").severe
    with pytest.raises(DegenerateGeometryError) as caught:
        calibrate(taught([("x", 0.15 * X), ("z", -0.15 * X)]))
    assert caught.value.code == "nearly_parallel"


def test_a_tip_that_did_not_move_shows_no_axis():
    with pytest.raises(DegenerateGeometryError) as caught:
        calibrate(taught([("x", 0 * X), ("z", 0.15 * Z)]))
    assert caught.value.code == "short_stroke"


def test_three_strokes_that_make_a_left_handed_frame_are_severe():
    result = calibrate(taught([("x", 0.15 * X), ("y", -0.15 * Y), ("z", 0.15 * Z)]))
    assert said(result, "left_handed").severe


def test_x_and_y_swapped_turn_z_into_the_flange():
    assert codes(calibrate(taught([("x", 0.15 * X), ("y", 0.15 * Y)]))) == []
    assert codes(calibrate(taught([("x", 0.15 * Y), ("y", 0.15 * X)]))) == ["left_handed"]


def test_a_stroke_along_minus_z_is_noticed():
    assert codes(calibrate(taught([("x", 0.15 * X), ("z", -0.15 * Z)]))) == ["axis_reversed"]


def test_a_tool_left_active_shows_by_its_length():
    rotations, positions = touches(5, 0.6, NOISE)
    tips = positions + rotations @ TOOL
    result = calibrate(captures(rotations, tips))
    assert "tool 0" in said(result, "tool_active").advice


def test_a_tool_that_the_controller_reports_as_active_is_named():
    result = calibrate(captures(*touches(5, 0.6)), context={"tool_active": "torch"})
    assert "torch" in said(result, "tool_active").message


@pytest.mark.parametrize(
    "true, stated", [("ZYX", "XYZ"), ("XYZ", "ZYX"), ("ZYZ", "ZYX"), ("rotvec", "XYZ"), ("ZYX", "rotvec")]
)
def test_a_wrong_euler_order_is_named_with_the_right_one(true, stated, tmp_path):
    positions, angles = written(true)
    path = write(tmp_path / "p.csv", np.hstack([positions, deg(angles)]), f"# angles: {stated}")
    warning = said(solve_file(path).result, "convention")
    assert f"look like {true}" in warning.message and warning.severe


def test_radians_in_a_column_of_degrees_are_named(tmp_path):
    positions, angles = written("ZYX")
    path = write(tmp_path / "p.csv", np.hstack([positions, angles]))
    assert "radians, not degrees" in said(solve_file(path).result, "convention").message


def test_degrees_in_a_column_of_radians_are_named(tmp_path):
    positions, angles = written("ZYX")
    columns = "x_mm,y_mm,z_mm,a_rad,b_rad,c_rad"
    path = write(tmp_path / "p.csv", np.hstack([positions, deg(angles)]), columns=columns)
    assert "degrees, not radians" in said(solve_file(path).result, "convention").message


def test_a_quaternion_with_w_last_is_named(tmp_path):
    positions, quaternions = written("quaternion")
    rows = np.hstack([positions, quaternions[:, [1, 2, 3, 0]]])
    path = write(tmp_path / "p.csv", rows, "# angles: quaternion", "x_mm,y_mm,z_mm,qw,qx,qy,qz")
    assert "w last" in said(solve_file(path).result, "convention").message


@pytest.mark.parametrize("factor, columns", [(1e-3, "x_mm,y_mm,z_mm"), (1.0, "x_m,y_m,z_m")])
def test_lengths_in_the_wrong_unit_show_by_their_size(factor, columns, tmp_path):
    positions, angles = written("ZYX")
    path = write(
        tmp_path / "p.csv",
        np.hstack([factor * positions, deg(angles)]),
        columns=columns + ",a_deg,b_deg,c_deg",
    )
    assert said(solve_file(path).result, "units").severe


def test_the_right_convention_is_not_doubted(tmp_path):
    for convention in ("ZYX", "XYZ", "ZYZ", "rotvec"):
        positions, angles = written(convention)
        path = write(tmp_path / "p.csv", np.hstack([positions, deg(angles)]), f"# angles: {convention}")
        assert codes(solve_file(path).result) == []


def both(tmp_path, change):
    """A file with joints and poses of one arm, the poses changed by `change(i, pose)`."""
    robot = load_robot("ur10e")
    rng = np.random.default_rng(3)
    rows = []
    for i in range(5):
        q = robot.home + rng.normal(0, 0.4, 6)
        pose = change(i, robot.forward(q))
        rows.append([*mm(pose.position), *deg(CONVENTIONS["ZYX"].from_rotation(pose.rotation)), *deg(q)])
    joints = ",".join(f"q{j}_deg" for j in range(1, 7))
    return write(
        tmp_path / "p.csv",
        rows,
        "# robot: ur10e\n# angles: ZYX",
        "x_mm,y_mm,z_mm,a_deg,b_deg,c_deg," + joints,
    )


def test_joints_and_poses_that_agree_are_not_mentioned(tmp_path):
    found = codes(solve_file(both(tmp_path, lambda i, pose: pose)).result)
    assert "joints_disagree" not in found and "tool_active" not in found


def test_a_row_whose_joints_and_pose_disagree_is_named(tmp_path):
    shift = Pose.of(None, np.array([0.05, 0.0, 0.0]))
    path = both(tmp_path, lambda i, pose: shift @ pose if i == 2 else pose)
    message = said(solve_file(path).result, "joints_disagree").message
    assert "in row 6:" in message and "50.00 mm" in message


def test_poses_that_are_a_tools_instead_of_the_flanges_are_named_by_that_tool(tmp_path):
    path = both(tmp_path, lambda i, pose: pose @ Pose.of(rot_x(0.3), np.array([0.0, 0.01, 0.12])))
    result = solve_file(path).result
    assert "(0.0, 10.0, 120.0) mm" in said(result, "tool_active").message
    assert "joints_disagree" not in codes(result)


def test_the_sessions_active_tool_is_named_where_the_poses_are_its_own(tmp_path):
    tool = Pose.of(rot_x(0.3), np.array([0.0, 0.01, 0.12]))
    points = read_points(both(tmp_path, lambda i, pose: pose @ tool))
    for name, pose in (("torch", tool), ("another", Pose.of(None, np.array([0.0, 0.0, 0.3])))):
        context = {"points": points, "session_tool": SessionTool(name, pose, recorded=False)}
        message = said(calibrate(points.captures, context=context), "tool_active").message
        assert ("torch" in message) == (name == "torch") and "another" not in message


def test_the_sessions_active_tool_is_named_where_poses_turn_about_the_tip():
    rotations, positions = touches(5, 0.6, NOISE)
    active = SessionTool("torch", Pose.of(None, TOOL), recorded=False)
    result = calibrate(captures(rotations, positions + rotations @ TOOL), context={"session_tool": active})
    assert "torch" in said(result, "tool_active").message and said(result, "tool_active").severe


def test_a_tool_that_is_the_flange_is_not_mentioned():
    flange = SessionTool("tool 0", Pose.identity(), recorded=True)
    assert not codes(calibrate(captures(*touches(5, 0.6)), context={"session_tool": flange}))
