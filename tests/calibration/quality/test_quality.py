"""Leave-one-out, rounding, references, the light, and the page that shows them."""

import numpy as np
import pytest

from app.calibration.as_json import tool_json
from app.calibration.points import read_points
from app.calibration.quality.leave_one_out import leave_one_out
from app.calibration.quality.light import light
from app.calibration.quality.references import gap_to
from app.calibration.quality.rounding import rounding
from app.calibration.solving import solve_file
from app.calibration.text import page
from app.calibration.tool import METHODS, calibrate
from app.cli import run
from app.resources import STATIC
from tests.calibration.drawing import TOOL, captures, touches
from tests.golden_text import assert_golden

TABLE_1 = STATIC / "samples" / "xiong2012_table1.csv"
EXACT = 1e-12
DRAWS = 1500
X, Y, _ = np.eye(3)
JSON_KEYS = [
    "format", "T_flange_tool", "tool_mm", "quaternion_wxyz", "delta_mm", "per_point_mm", "mean_mm", "max_mm",
    "rms_mm", "sigma_tool_mm", "condition", "warnings",
]  # fmt: skip


def test_leaving_a_touch_out_is_fitting_the_others():
    points = captures(*touches(6, 0.5, 3e-4, 1))
    whole = calibrate(points).tool_point
    for entry in leave_one_out(points):
        rest = calibrate([c for i, c in enumerate(points) if i != entry.index])
        assert entry.shift == pytest.approx(np.linalg.norm(rest.tool_point - whole))
        tip = points[entry.index].T_base_flange.apply(rest.tool_point)
        assert entry.heldout == pytest.approx(np.linalg.norm(tip - rest.p_base))


def test_with_three_touches_none_can_be_left_out():
    assert leave_one_out(captures(*touches(3, 0.5, 3e-4))) == ()


@pytest.mark.parametrize("method", ["joint", "pairwise"])
def test_propagated_rounding_is_that_of_draws_inside_the_last_digit(method):
    points = read_points(TABLE_1)
    result = calibrate(points.captures, method=method)
    rng = np.random.default_rng(0)
    written = points.written
    tools = []
    for _ in range(DRAWS):
        shift = rng.uniform(-0.5, 0.5, (4, len(written.steps))) * written.steps
        poses = written.poses(written.values[:4] + shift)
        tools.append(METHODS[method](poses[:, :3, :3], poses[:, :3, 3]).tool)
    np.testing.assert_allclose(rounding(points, result).sigma_tool, np.std(tools, axis=0), rtol=0.07)


def test_the_columns_that_matter_most_are_named_first():
    effect = rounding(read_points(TABLE_1), solve_file(TABLE_1).result)
    assert set(effect.columns[:3]) == {"a_deg", "b_deg", "c_deg"}
    assert set(effect.columns[3:]) == {"x_mm", "y_mm", "z_mm"}


def test_the_gap_of_table_1_to_the_measured_torch_is_explained_by_rounding():
    gaps = {gap.name: gap for gap in solve_file(TABLE_1, method="pairwise").gaps}
    assert gaps["printed_tool"].explained_by == gaps["measured_tool"].explained_by == "rounding"
    assert np.abs(gaps["printed_tool"].gap).max() < 5.1e-6
    assert np.abs(gaps["measured_tool"].sigmas).max() < 3.0


def test_a_gap_that_rounding_cannot_make_is_not_blamed_on_it():
    points = read_points(TABLE_1)
    result = calibrate(points.captures)
    effect = rounding(points, result)
    within = gap_to("gauge_tool", result.tool_point + 0.001 * X, result, effect)
    beyond = gap_to("gauge_tool", result.tool_point + 0.02 * Y, result, effect)
    assert within.explained_by == "touch noise" and beyond.explained_by == "nothing"
    assert "NOT explained" in beyond.sentence()


def test_numbers_written_in_full_have_no_rounding(tmp_path):
    rotations, positions = touches(4, 0.5)
    lines = ["# angles: quaternion", "role,x_m,y_m,z_m,qw,qx,qy,qz"]
    for capture in captures(rotations, positions):
        pose = capture.T_base_flange
        lines.append("touch," + ",".join(f"{v:.12f}" for v in (*pose.position, *pose.quaternion)))
    path = tmp_path / "points.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    solved = solve_file(path)
    assert solved.rounding.sigma_tool.max() == 0.0
    np.testing.assert_allclose(solved.result.tool_point, TOOL, atol=1e-9)
    assert "less than 0.001 mm" in page(solved)


def test_the_light_takes_the_worse_of_mean_and_predicted_region():
    good = calibrate(captures(*touches(6, 0.8, 1e-4, 2)))
    assert light(good).colour == "green" and light(good).action
    noisy = calibrate(captures(*touches(6, 0.8, 2e-3, 2)))
    assert light(noisy).colour == "red" and "on average" in light(noisy).reason
    narrow = calibrate(captures(*touches(4, 0.1, 3e-4, 2)))
    assert narrow.mean < 5e-4 and light(narrow).colour == "red" and "only known to" in light(narrow).reason


def test_the_json_begins_with_the_contracts_keys(capsys):
    import json

    assert run(["solve", str(TABLE_1), "--method", "pairwise", "--orientation", "zx", "--json"]) == 0
    out = json.loads(capsys.readouterr().out)
    assert list(out)[: len(JSON_KEYS)] == JSON_KEYS and out["format"] == "teachframe.tool/1"
    np.testing.assert_allclose(out["tool_mm"], [119.6205, -0.3230, 351.8951], atol=1e-4)
    np.testing.assert_allclose(
        np.array(out["T_flange_tool"])[:3, :3],
        [[0.58354, 0.00204, 0.81208], [-0.00349, 0.99999, 0.0], [-0.81208, -0.00283, 0.58354]],
        atol=1e-5,
    )
    assert out["delta_mm"] == pytest.approx(0.66299, abs=1e-5)
    assert out["condition"] == pytest.approx(3.1721, abs=1e-4)
    assert len(out["per_point_mm"]) == 4 and len(out["sigma_tool_mm"]) == 3
    assert max(out["per_point_mm"]) == out["max_mm"] >= out["rms_mm"] >= out["mean_mm"]


@pytest.mark.parametrize("orientation, column", [("default", [1, 0, 0]), ("z", [0.58354, 0.0, -0.81208])])
def test_the_paper_s_other_orientations_follow_from_the_same_points(orientation, column):
    result = solve_file(TABLE_1, orientation=orientation).result
    np.testing.assert_allclose(result.T_flange_tool.rotation[:, 0], column, atol=1e-4)


def test_orientation_without_being_asked_for_is_the_fullest_that_the_roles_allow():
    assert solve_file(TABLE_1).result.orientation == "zx"


def test_every_warning_reaches_the_json_with_its_advice():
    result = calibrate(captures(*touches(5, 0.6)), context={"tool_active": "gun"})
    (warning,) = tool_json(result)["warnings"]
    assert warning["code"] == "tool_active" and "gun" in warning["message"] and "tool 0" in warning["message"]


def test_golden_page_of_table_1():
    assert_golden("solve_table1.txt", page(solve_file(TABLE_1, method="pairwise")) + "\n")


def test_golden_summary_of_table_1():
    assert_golden("tool_summary.txt", solve_file(TABLE_1).result.summary() + "\n")


def test_the_json_says_all_that_the_page_says(capsys):
    import json

    assert run(["solve", str(TABLE_1), "--json"]) == 0
    out = json.loads(capsys.readouterr().out)
    solved = solve_file(TABLE_1)
    said = page(solved)
    assert out["light"]["colour"] in ("yellow", "red")
    for text in (out["light"]["reason"], out["light"]["action"], out["next_touch"]["sentence"], out["title"]):
        assert text in said
    for gap in out["gaps"]:
        assert gap["sentence"] in said
    assert len(out["left_out"]) == len(solved.left_out) == 4
    assert out["rounding"]["sigma_tool_mm"] == pytest.approx([1e3 * v for v in solved.rounding.sigma_tool])
    assert [axis["axis"] for axis in out["axes"]] == [cone.axis for cone in solved.result.cones]


def test_garbage_is_red_in_the_json_too(tmp_path, capsys):
    import json

    rng = np.random.default_rng(5)
    rows = [",".join(f"{v:.2f}" for v in rng.uniform(-900, 900, 6)) for _ in range(5)]
    path = tmp_path / "garbage.csv"
    path.write_text(
        "# kind: points\n# angles: ZYX\nrole,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg\n"
        + "".join(f"touch,{row}\n" for row in rows)
    )
    assert run(["solve", str(path), "--json"]) == 0
    out = json.loads(capsys.readouterr().out)
    assert out["light"]["colour"] == "red" and "mm" in out["light"]["reason"]


def test_leaving_each_touch_out_takes_a_time_that_grows_with_their_number():
    found = leave_one_out(captures(*touches(5000, 0.6, 1e-4, 3)))
    assert len(found) == 5000
