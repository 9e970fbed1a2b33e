"""Real recordings: a FANUC R-2000iC turned axis by axis, and two Motoman arms on one turntable."""

import numpy as np
import pytest

from app.calibration.base.run import run_base
from tests.calibration.base.files import codes
from tests.data_folder import data_folder

DESCRIBED = {"a1": 312.0, "a2": 1075.0, "a3": 225.0, "d4": 1280.0}  # mm
ARM_TOLERANCE = 1.5  # mm, what a maker's tolerance leaves of each
NOISE = 0.05  # mm rms from the circle, a tracker's
HELD_OUT = 0.30  # mm rms


@pytest.fixture(scope="module")
def fanuc():
    return data_folder() / "fanuc_arcs"


def test_six_points_an_axis_find_the_distance_of_the_axes_within_their_uncertainty(fanuc):
    out = run_base([fanuc / "run_arcs.csv"]).to_json()
    robot = out["robots"][0]
    assert abs(robot["axis_distance_mm"] - DESCRIBED["a1"]) < ARM_TOLERANCE
    assert abs(robot["axis_angle_deg"] - 90) < 4 * robot["sigma_axis_angle_deg"]
    assert all(a["rms_mm"] < NOISE for a in out["arcs"])
    assert [round(a["arc_deg"]) for a in out["arcs"]] == [60, 80]


def test_the_arcs_tell_that_joint_1_stood_at_47_degrees_and_that_they_are_short(fanuc):
    result = run_base([fanuc / "run_arcs.csv"])
    assert codes(result) == {"short_arc", "zero_position"}
    assert result.to_json()["robots"][0]["joint1_during_axis2_deg"] == pytest.approx(47.0, abs=0.05)


def test_the_makers_frame_lies_670_mm_below_and_turned_back(fanuc):
    out = run_base([fanuc / "run_arcs.csv"]).to_json()
    found, maker = np.array(out["T_tracker_base"]), np.array(out["robots"][0]["T_tracker_maker"])
    step = np.linalg.inv(found) @ maker
    np.testing.assert_allclose(step[:3, 3], [0, 0, -670], atol=1e-6)
    assert np.degrees(np.arctan2(step[1, 0], step[0, 0])) == pytest.approx(-47.0, abs=0.05)


def test_x_looks_at_the_work_space_and_axis_2_turns_about_plus_y(fanuc):
    result = run_base([fanuc / "run_arcs.csv"])
    base = result.bases[0]
    assert base.axis2_along_y > 0.999
    assert (base.towards - base.T_tracker_base.position) @ base.T_tracker_base.rotation[:, 0] > 0


def test_three_reflectors_halve_the_uncertainty_and_agree_with_one(fanuc):
    one, three = (run_base([fanuc / f"{n}.csv"]).bases[0] for n in ("run_arcs", "run_all"))
    gap = np.linalg.norm(one.T_tracker_base.position - three.T_tracker_base.position)
    assert gap < 3 * np.linalg.norm(one.sigma_position)
    assert np.linalg.norm(three.sigma_position) < 0.6 * np.linalg.norm(one.sigma_position)


def test_all_six_axes_give_the_real_arms_lengths_beside_the_description(fanuc):
    arm = run_base([fanuc / "run_all.csv"]).to_json()["robots"][0]["arm"]
    found = {f"{q['name']}{q['axis']}": q for q in arm["quantities"]}
    for name, length in DESCRIBED.items():
        assert found[name]["nominal"] == pytest.approx(length, abs=1e-6)
        assert abs(found[name]["measured"] - length) < ARM_TOLERANCE
        assert 0 < found[name]["sigma"] < 0.2
    # longer than described by many sigma: this arm's own, the reason to calibrate it
    assert found["a2"]["error"] > 5 * found["a2"]["sigma"]
    assert found["a3"]["error"] > 5 * found["a3"]["sigma"]
    assert all(abs(found[f"twist{k}"]["error"]) < 0.05 for k in range(1, 6))
    assert all(abs(t["slope"] - 1) < 5e-4 for t in arm["turning"])


@pytest.fixture(scope="module")
def dual():
    folder = data_folder() / "dualarm_tracker"
    return run_base([folder / "right.csv", folder / "left.csv"])


def test_each_base_from_poses_predicts_poses_that_were_left_out(dual):
    assert all(r["heldout_rms_mm"] < HELD_OUT for r in dual.to_json()["robots"])


def test_a_wrist_that_never_turned_is_seen_as_the_reason_for_an_open_base(dual):
    assert "weak_poses" in codes(dual)
    assert all(base.wrist < np.radians(0.5) for base in dual.bases)
    assert all(max(r["sigma_mm"]) > 10 for r in dual.to_json()["robots"])


def test_the_relation_of_the_two_arms_is_refused_because_the_frames_differ(dual):
    out = dual.to_json()
    assert out["T_base1_base2"] is None
    message = next(w["message"] for w in out["warnings"] if w["code"] == "tracker_moved")
    assert "107.6" in message and "one and the same base" in message
