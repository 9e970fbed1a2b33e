"""Recordings that are not what they seem: a clear line or a warning, never a wrong name."""

import numpy as np
import pytest

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.observations.pose_reading import read_static
from app.errors import CellValueError, InputError, MissingColumnError, TeachframeError, TooFewPointsError
from app.recordings import read_table
from app.units import deg
from tests.diagnosis.kinematic.arms import write_arm
from tests.diagnosis.kinematic.simulating import (
    NOISE_MM,
    TOOL,
    poses,
    tracker_rows,
    write_touch,
    write_tracker,
)

ROWS = 50


@pytest.fixture
def rows(arm):
    rng = np.random.default_rng(17)
    q = poses(arm, rng, ROWS)
    return q, tracker_rows(arm, q, rng=rng)


def test_a_recording_of_a_shorter_robot_names_the_missing_joint(arm, rows, tmp_path):
    path = tmp_path / "r.csv"
    write_tracker(path, arm, *rows)
    path.write_text(path.read_text().replace("q6_rad", "other"))
    with pytest.raises(MissingColumnError, match="q6_"):
        read_static(read_table(path), arm)


def test_a_recording_of_a_longer_robot_is_refused(arm, rows, tmp_path):
    five = write_arm(
        tmp_path / "five.urdf",
        [("z", "0 0 .3", 1, "0 0 0"), *[("y", "0.2 0 0", 1, "0 0 0"), ("x", "0.2 0 0", 1, "0 0 0")] * 2],
    )
    with pytest.raises(InputError, match="6 joints are recorded, five has 5"):
        read_static(write_tracker(tmp_path / "r.csv", arm, *rows), five)


def test_degrees_in_a_radian_column_are_refused_with_the_cell(arm, rows, tmp_path):
    q, points = rows
    with pytest.raises(CellValueError, match="degrees in a radian column") as caught:
        read_static(write_tracker(tmp_path / "r.csv", arm, deg(q), points), arm)
    assert caught.value.row is not None and caught.value.column == "q1_rad"


def test_metres_in_a_millimetre_column_are_named(arm, rows, tmp_path):
    from app.units import from_mm

    q, points = rows
    found = diagnose(write_tracker(tmp_path / "r.csv", arm, q, from_mm(points), stated=False), arm)
    assert [f.effect for f in found.findings] == ["wrong_convention"]
    assert "millimetres and metres" in found.findings[0].sentence


def test_a_column_of_zeros_is_refused_by_name(arm, rows, tmp_path):
    q, points = rows
    points = points.copy()
    points[:, 0, 2] = 0.0
    with pytest.raises(InputError, match="z_mm: every value is 0"):
        read_static(write_tracker(tmp_path / "r.csv", arm, q, points), arm)


def test_an_arm_that_does_not_move_is_refused(arm, rows, tmp_path):
    q, points = rows
    with pytest.raises(InputError, match="no joint moves"):
        read_static(write_tracker(tmp_path / "r.csv", arm, np.tile(q[:1], (ROWS, 1)), points), arm)


def test_a_joint_that_never_moves_is_said(arm, tmp_path):
    rng = np.random.default_rng(19)
    q = poses(arm, rng, ROWS)
    q[:, 3] = 0.2
    found = diagnose(write_tracker(tmp_path / "r.csv", arm, q, tracker_rows(arm, q, rng=rng)), arm)
    assert found.verdict == "clean"
    assert any("joint 4 never moves" in note for note in found.notes)


def test_exact_copies_of_rows_count_once(arm, rows, tmp_path):
    q, points = rows
    path = tmp_path / "r.csv"
    write_tracker(path, arm, q, points)
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines, *lines[-10:]]) + "\n")
    recording = read_static(read_table(path), arm)
    assert recording.size == ROWS
    assert any("10 rows are exact copies" in note for note in recording.notes)


def test_ten_rows_only_give_no_name(arm, rows, tmp_path):
    q, points = rows
    assert diagnose(write_tracker(tmp_path / "r.csv", arm, q[:10], points[:10]), arm).findings == ()


def test_three_rows_are_refused(arm, rows, tmp_path):
    q, points = rows
    with pytest.raises(TeachframeError):
        diagnose(write_tracker(tmp_path / "r.csv", arm, q[:3], points[:3]), arm)


def test_targets_touched_once_are_set_aside_and_said(arm, rows, tmp_path):
    q, _ = rows
    recording = read_static(
        write_touch(tmp_path / "t.csv", arm, q, ["a"] * 30 + ["b"] * 17 + ["c", "d", "e"]), arm
    )
    assert recording.target_names == ("a", "b")
    assert any("touched only once" in note for note in recording.notes)


def test_only_single_touches_are_refused(arm, rows, tmp_path):
    q, _ = rows
    with pytest.raises(TooFewPointsError):
        read_static(write_touch(tmp_path / "t.csv", arm, q, [f"p{i}" for i in range(ROWS)]), arm)


def test_a_reflector_lost_in_half_of_the_rows_is_said_and_the_rest_used(arm, tmp_path):
    rng = np.random.default_rng(23)
    q = poses(arm, rng, ROWS)
    points = tracker_rows(arm, q, rng=rng, reflectors=(TOOL, TOOL + np.array([0, 0.1, 0])))
    points[: ROWS // 2, 1] = np.nan
    path = tmp_path / "r.csv"
    write_tracker(path, arm, q, points)
    path.write_text(path.read_text().replace("nan", ""))
    found = diagnose(read_table(path), arm)
    assert found.verdict == "clean"
    assert any("reflector 2 was lost in 25 of 50" in note for note in found.notes)


def test_rows_outside_the_limits_are_said(arm, rows, tmp_path):
    q, points = rows
    q = q.copy()
    q[0, 0] += 2.0 * np.pi
    recording = read_static(write_tracker(tmp_path / "r.csv", arm, q, points), arm)
    assert any("1 rows lie outside" in note for note in recording.notes)


def test_noise_from_repeats_wins_over_what_is_stated(arm, tmp_path):
    rng = np.random.default_rng(29)
    q = np.repeat(poses(arm, rng, 30), 3, axis=0)
    table = write_tracker(tmp_path / "r.csv", arm, q, tracker_rows(arm, q, rng=rng), keys=[], noise=0.5)
    found = diagnose(table, arm)
    assert found.noise.source == "repeats"
    assert found.noise.value == pytest.approx(NOISE_MM, rel=0.25)


def test_each_session_has_its_own_frame_and_tool(arm, tmp_path):
    rng = np.random.default_rng(37)
    q = poses(arm, rng, 60)
    points = tracker_rows(arm, q, rng=rng)
    points[30:] = (
        points[30:, :, [1, 0, 2]] * [1, -1, 1] + 0.4
    )  # turned and moved: the tracker was set up anew
    path = tmp_path / "r.csv"
    write_tracker(path, arm, q, points)
    lines = path.read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("q1"))
    lines[head] += ",session"
    for i in range(head + 1, len(lines)):
        lines[i] += ",morning" if i <= head + 30 else ",evening"
    path.write_text("\n".join(lines) + "\n")
    found = diagnose(read_table(path), arm)
    assert (found.verdict, found.findings) == ("clean", ())


def test_a_draw_wire_is_enough_for_a_clean_verdict(arm, tmp_path):
    rng = np.random.default_rng(41)
    q = poses(arm, rng, 80)
    points = tracker_rows(arm, q, rng=rng, noise=0.0)
    path = tmp_path / "r.csv"
    length = np.linalg.norm(points[:, 0], axis=1) + rng.normal(0, 1.5e-4, 80)
    lines = [
        "# kind: tracker",
        "# noise_mm: 0.15",
        ",".join([*(f"q{j}_rad" for j in range(1, 7)), "length_m"]),
    ]
    lines += [",".join(f"{v:.9f}" for v in [*row, wire]) for row, wire in zip(q, length, strict=True)]
    path.write_text("\n".join(lines) + "\n")
    found = diagnose(read_table(path), arm)
    assert found.verdict == "clean"
    assert found.after.fit_rms == pytest.approx(NOISE_MM, rel=0.3)


def test_every_driver_of_a_row_that_is_set_aside_goes_with_it(arm, rows, tmp_path):
    recording = read_static(write_tracker(tmp_path / "r.csv", arm, *rows), arm)
    kept = np.arange(recording.size) % 3 > 0
    before, after = recording.situation, recording.subset(kept).situation
    by_row = {
        name: value
        for name, value in vars(before).items()
        if isinstance(value, np.ndarray) and len(value) == recording.size
    }
    assert "leaning" in by_row and "q" in by_row
    for name, value in by_row.items():
        np.testing.assert_array_equal(getattr(after, name), value[kept], err_msg=name)
