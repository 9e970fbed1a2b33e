"""What goes wrong is named, with its rows; what must be refused is refused."""

import re

import numpy as np
import pytest

from app.calibration.base.run import run_base
from app.errors import DegenerateGeometryError, TooFewPointsError
from app.estimation import HALF
from tests.calibration.base.cells import random_cells, turned
from tests.calibration.base.files import cell, codes, first_row, turn_error, write

CLOSE_MM, CLOSE_RAD = 0.3, 3e-4  # tracker noise over a 2 m arm
FALSE_ALARMS = 0.03  # share of clean cells with any warning at all


def _run(tmp_path, first, second, **options):
    return run_base([write(tmp_path / "a.csv", first, second, **options)])


def _message(result, code):
    return next(w["message"] for w in result.to_json()["warnings"] if w["code"] == code)


def test_a_clean_cell_gives_its_frame_and_not_one_warning(tmp_path):
    first, second, truth, _ = cell()
    result = _run(tmp_path, first, second)
    assert codes(result) == set()
    angle, distance = turn_error(result.to_json()["T_tracker_base"], truth)
    assert angle < CLOSE_RAD and distance < CLOSE_MM


def test_clean_cells_hardly_ever_raise_a_false_alarm(tmp_path):
    cells = random_cells(30, 200)
    alarmed = 0
    for k in range(200):
        path = write(tmp_path / "a.csv", cells.first[k] * 1e3, cells.second[k] * 1e3)
        alarmed += bool(codes(run_base([path])))
    assert alarmed <= FALSE_ALARMS * 200


def test_angles_give_the_same_frame_whatever_the_order_of_rows(tmp_path):
    first, second, truth, _ = cell()
    span = np.linspace(0, 1, 36)
    # angles only need to be right in steps; each arc's own span is recovered from its places
    a1, a2 = (_angles(points, span) for points in (first, second))
    order = np.random.default_rng(1).permutation(36)
    result = _run(tmp_path, first[order], second[order], angles=(a1[order], a2[order]))
    assert not codes(result) - {"zero_position"}
    angle, distance = turn_error(result.to_json()["T_tracker_base"], truth)
    assert angle < CLOSE_RAD and distance < CLOSE_MM


def _angles(points, span):
    from app.geometry.circle import fit_axis

    places = np.unwrap(fit_axis(points).azimuths)
    return np.degrees(np.abs(places[-1] - places[0])) * (span - 0.5)


@pytest.mark.parametrize("axis", [1, 2])
def test_a_maker_who_counts_the_other_way_says_so_and_gets_the_same_frame(tmp_path, axis):
    first, second, truth, _ = cell()
    span = np.linspace(0, 1, 36)
    angles = [_angles(first, span), _angles(second, span)]
    angles[axis - 1] = -angles[axis - 1]
    keys = [f"axis{axis}_sense: -1"]
    result = _run(tmp_path, first, second, angles=angles, keys=keys)
    angle, _ = turn_error(result.to_json()["T_tracker_base"], truth)
    assert angle < CLOSE_RAD
    assert "direction" not in codes(result) and "swapped" not in codes(result)


def test_an_arc_under_90_degrees_is_named_with_the_error_it_costs(tmp_path):
    first, second, _, _ = cell()
    found = _run(tmp_path, first[:6], second)
    message = _message(found, "short_arc")
    costs = re.search(r"open by ([\d.]+) degrees and its centre by ([\d.]+) mm, where 180 degrees", message)
    assert costs is not None
    arc = found.to_json()["arcs"][0]
    assert float(costs[1]) == pytest.approx(HALF * arc["sigma_axis_deg"], abs=1e-4)
    assert float(costs[2]) == pytest.approx(HALF * arc["sigma_centre_mm"], abs=1e-3)
    assert "axis 1" in message and "axis 2" not in message


@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_points_are_refused(tmp_path, count):
    first, second, _, _ = cell()
    if count == 0:
        with pytest.raises(Exception, match="no row of axis 1"):
            _run(tmp_path, first[:0], second)
        return
    with pytest.raises(TooFewPointsError, match=rf"axis 1: {count} point"):
        _run(tmp_path, first[:count], second)


def test_three_points_are_fitted_with_a_warning_that_nothing_checks_them(tmp_path):
    first, second, truth, _ = cell()
    result = _run(tmp_path, first[::14], second)
    assert "too_few" in codes(result)
    angle, _ = turn_error(result.to_json()["T_tracker_base"], truth)
    assert angle < 10 * CLOSE_RAD


def test_points_on_one_line_or_in_one_place_are_refused(tmp_path):
    _, second, _, _ = cell()
    line = np.linspace(0, 100, 10)[:, None] * np.ones(3)
    with pytest.raises(DegenerateGeometryError, match="one line"):
        _run(tmp_path, line, second)
    with pytest.raises(DegenerateGeometryError, match="one place"):
        _run(tmp_path, np.ones((10, 3)), second)


def test_parallel_axes_are_refused_as_on_a_scara(tmp_path):
    z = np.array([[0.0, 0.0, 1.0]])
    angles = np.linspace(-1, 1, 20)[None]
    first = turned(np.array([[600.0, 0, 0]]), z, angles)[0]
    second = turned(np.array([[250.0, 0, 0]]), z, angles)[0] + [350.0, 0, 0]
    noise = np.random.default_rng(0).normal(0, 0.02, (2, 20, 3))
    with pytest.raises(DegenerateGeometryError, match=r"parallel.*SCARA") as refused:
        _run(tmp_path, first + noise[0], second + noise[1])
    assert refused.value.code == "parallel"


def test_axes_that_are_not_square_are_named_by_how_much(tmp_path):
    first, second, _, _ = cell(seed=5, square=np.radians(0.5))
    result = _run(tmp_path, first, second)
    message = _message(result, "axis_angle")
    stated = float(re.search(r"([\d.]+) away from square", message)[1])
    assert stated > 0.02
    assert stated == pytest.approx(abs(result.to_json()["robots"][0]["axis_angle_deg"] - 90), abs=1e-4)


@pytest.mark.parametrize("seed", range(6))
def test_swapped_rows_are_never_taken_for_a_good_frame(tmp_path, seed):
    first, second, _, towards = cell(seed)
    keys = [f"towards_workspace_mm: [{', '.join(f'{v:.1f}' for v in towards)}]"]
    result = _run(tmp_path, first, second, axes=(2, 1), keys=keys)
    assert codes(result) & {"swapped", "direction"}
    assert "swapped" in str(result.to_json()["warnings"])


@pytest.mark.parametrize("level", [0, 1])
def test_under_a_levelled_tracker_swapped_rows_are_called_so(tmp_path, level):
    z, y = np.array([[0.0, 0.0, 1.0]]), np.array([[0.0, 1.0, 0.0]])
    angles = np.linspace(-1, 1, 20)[None]
    reflector = np.array([[1500.0, 50, 900]])
    first = turned(reflector, z, angles)[0]
    second = turned(reflector - [[300.0, 0, 0]], y, 0.7 * angles)[0] + [300.0, 0, 0]
    axes = (2, 1) if level else (1, 2)
    result = _run(tmp_path, first, second, axes=axes)
    assert ("swapped" in codes(result)) == bool(level)


@pytest.mark.parametrize("axis", [1, 2])
def test_an_arc_recorded_backwards_contradicts_the_other(tmp_path, axis):
    first, second, _, towards = cell(7)
    keys = [f"towards_workspace_mm: [{', '.join(f'{v:.1f}' for v in towards)}]"]
    points = [first, second]
    points[axis - 1] = points[axis - 1][::-1]
    assert codes(_run(tmp_path, *points, keys=keys)) & {"direction", "swapped"}


def test_rows_out_of_order_are_named(tmp_path):
    first, second, truth, _ = cell()
    mixed = first.copy()
    mixed[[10, 20]] = mixed[[20, 10]]
    result = _run(tmp_path, mixed, second)
    assert re.search(rf"rows? .*\b{first_row() + 11}\b", _message(result, "order"))
    assert turn_error(result.to_json()["T_tracker_base"], truth)[0] < CLOSE_RAD


def test_rows_that_run_to_and_fro_are_refused_for_want_of_a_direction(tmp_path):
    first, second, _, _ = cell()
    with pytest.raises(DegenerateGeometryError, match="to and fro") as refused:
        _run(tmp_path, np.concatenate([first, first[::-1]]), second)
    assert refused.value.code == "order"


def test_an_angle_beside_the_wrong_row_is_named(tmp_path):
    first, second, _, _ = cell()
    span = np.linspace(0, 1, 36)
    a1, a2 = _angles(first, span), _angles(second, span)
    a1[7] += 4.0
    result = _run(tmp_path, first, second, angles=(a1, a2))
    assert f"row {first_row() + 7}" in _message(result, "order")


def test_angles_in_radians_do_not_pass_for_degrees(tmp_path):
    first, second, _, _ = cell(points=36)
    span = np.linspace(0, 1, 36)
    a1, a2 = np.radians(_angles(first, span)), np.radians(_angles(second, span))
    with pytest.raises(DegenerateGeometryError, match="do not follow the turn"):
        _run(tmp_path, first, second, angles=(a1, a2))


@pytest.mark.parametrize("row", [0, 9, 35])
def test_an_outlier_is_named_by_its_row_and_does_not_bend_the_frame(tmp_path, row):
    first, second, truth, _ = cell()
    first[row] += [2.0, -1.0, 1.5]
    result = _run(tmp_path, first, second)
    assert f"row {first_row() + row} " in _message(result, "outlier")
    assert result.to_json()["arcs"][0]["rows_set_aside"] == [first_row() + row]
    angle, distance = turn_error(result.to_json()["T_tracker_base"], truth)
    assert angle < CLOSE_RAD and distance < CLOSE_MM


def test_several_outliers_are_all_named(tmp_path):
    first, second, truth, _ = cell()
    for row in (3, 18, 30):
        second[row] += np.random.default_rng(row).normal(0, 3.0, 3)
    result = _run(tmp_path, first, second)
    assert result.to_json()["arcs"][1]["rows_set_aside"] == [first_row() + 36 + r for r in (3, 18, 30)]
    assert turn_error(result.to_json()["T_tracker_base"], truth)[0] < CLOSE_RAD


@pytest.mark.parametrize("row", [8, 20, 30])
def test_a_reflector_that_moved_is_named_by_the_row_from_which_on(tmp_path, row):
    first, second, truth, _ = cell(14)
    axis = truth[:3, 2]
    outwards = first - truth[:3, 3]
    outwards -= (outwards @ axis)[:, None] * axis
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    first[row:] += 0.4 * axis + 0.3 * outwards[row:]
    result = _run(tmp_path, first, second)
    assert f"from row {first_row() + row} on" in _message(result, "reflector_moved")
    assert result.to_json()["arcs"][0]["moved_mm"] == pytest.approx(0.5, abs=0.1)
    angle, distance = turn_error(result.to_json()["T_tracker_base"], truth)
    assert angle < CLOSE_RAD and distance < CLOSE_MM


def test_stated_noise_that_the_points_deny_widens_the_uncertainty(tmp_path):
    first, second, _, _ = cell(noise=100e-6)
    honest = _run(tmp_path, first, second).to_json()["arcs"][0]["sigma_axis_deg"]
    denied = _run(tmp_path, first, second, keys=["noise_mm: 0.01"])
    assert "noise" in codes(denied)
    assert denied.to_json()["arcs"][0]["sigma_axis_deg"] == pytest.approx(honest, rel=0.35)


def test_a_front_that_is_no_front_leaves_x_to_the_turn_of_axis_2(tmp_path):
    first, second, truth, _ = cell()
    keys = [f"towards_workspace_mm: [{', '.join(f'{v:.4f}' for v in truth[:3, 3])}]"]
    result = _run(tmp_path, first, second, keys=keys)
    assert "workspace_side" in codes(result)
    assert turn_error(result.to_json()["T_tracker_base"], truth)[0] < CLOSE_RAD


def test_axis_2_turned_with_joint_1_aside_is_found_where_the_circles_meet(tmp_path):
    z, y = np.array([[0.0, 0.0, 1.0]]), np.array([[0.0, 1.0, 0.0]])
    reflector = np.array([[1500.0, 50, 900]])
    a1, a2 = np.radians(np.linspace(-60, 60, 13)), np.radians(np.linspace(-50, 50, 13))
    first = turned(reflector, z, a1[None])[0]
    second = turned(reflector - [[300.0, 0, 0]], y, a2[None])[0] + [300.0, 0, 0]
    aside = turned(second, np.repeat(z, 13, axis=0), np.full((13, 1), np.radians(25.0)))[:, 0]
    result = _run(tmp_path, first, aside, angles=(np.degrees(a1), np.degrees(a2)))
    assert "25.00 degrees" in _message(result, "zero_position")
    assert result.to_json()["robots"][0]["joint1_during_axis2_deg"] == pytest.approx(25.0, abs=0.01)


def test_every_check_is_found_by_its_file_and_has_a_title():
    from app import catalog

    found = catalog.members("app.calibration.base.checks", "CHECK")
    assert {"too_few", "short_arc", "order", "direction", "parallel", "axis_angle", "outlier"} <= set(found)
    assert {"reflector_moved", "tracker_moved", "description", "noise", "zero_position"} <= set(found)
    assert all(check.title and check.stages for check in found.values())
