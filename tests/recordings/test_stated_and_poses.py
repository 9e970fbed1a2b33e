"""What a header states of noise and masses; poses as other programs save them; lists beside joint angles."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.calibration.points import read_points
from app.errors import InputError
from app.geometry import Pose, exp_so3
from app.recordings import read_table
from app.recordings.options import ReadOptions
from app.recordings.stated import stated_inertials, stated_noise

POSES = [
    Pose.of(exp_so3(np.array(w)), np.array(p))
    for w, p in (([0.1, 0, 1], [1, 2, 3]), ([2, 0.3, 0], [-1, 0, 0.5]))
]


def table(tmp_path, head):
    path = tmp_path / "log.csv"
    path.write_text(head + "t_s\n1\n")
    return read_table(path)


def test_masses_are_trusted_as_the_header_says(tmp_path):
    assert stated_inertials(table(tmp_path, "")) == "cad"
    for word in ("exact", "cad", "unknown"):
        assert stated_inertials(table(tmp_path, f"# inertials: {word}\n")) == word
    with pytest.raises(InputError, match="# inertials: found 'guess'; expected one of exact, cad, unknown"):
        stated_inertials(table(tmp_path, "# inertials: guess\n"))


@pytest.mark.parametrize("text, noise", [("0.2", [0.2] * 3), ("[0.1, 0.2, 0.3]", [0.1, 0.2, 0.3])])
def test_noise_is_one_number_or_one_a_joint(tmp_path, text, noise):
    assert stated_noise(table(tmp_path, f"# noise_Nm: {text}\n"), "noise_Nm", 3) == pytest.approx(noise)
    assert stated_noise(table(tmp_path, ""), "noise_Nm", 3) is None


@pytest.mark.parametrize("text", ["-1", "[0.1, 0.2]", "much", "[.nan, 1, 1]", ".inf"])
def test_noise_that_cannot_be_is_named(tmp_path, text):
    with pytest.raises(InputError, match=r"column # noise_Nm: found .*or 3 of them"):
        stated_noise(table(tmp_path, f"# noise_Nm: {text}\n"), "noise_Nm", 3)


def rows_of(kind, scale):
    out = []
    for pose in POSES:
        matrix = np.array(pose.matrix)
        matrix[:3, 3] *= scale
        lines = matrix if kind == 4 else matrix[: kind // 4].reshape(1, -1)
        out += [" ".join(f"{v:.9f}" for v in line) for line in lines]
    return "\n".join(out) + "\n"


@pytest.mark.parametrize("kind", [16, 12, 4])
@pytest.mark.parametrize("unit, scale", [("mm", 1e3), ("m", 1.0), ("in", 1 / 0.0254)])
def test_matrices_in_rows_of_numbers_become_points(tmp_path, kind, unit, scale):
    path = tmp_path / "poses.txt"
    path.write_text(f"# unit: {unit}\n" + rows_of(kind, scale))
    points = read_points(path)
    assert [c.role for c in points.captures] == ["touch", "touch"]
    for capture, pose in zip(points.captures, POSES, strict=True):
        assert np.allclose(capture.T_base_flange.matrix, pose.matrix, atol=1e-7)
    path.write_text(rows_of(kind, scale))
    with pytest.raises(InputError, match="no unit"):
        read_table(path)
    assert len(read_table(path, ReadOptions(unit=unit))) == 2


@pytest.mark.parametrize(
    "text, problem",
    [
        (
            "# unit: mm\n" + rows_of(16, 1.0).replace(" 1.000000000\n", " 1\n", 1) + "1 2 3\n",
            "row 4: 3 numbers",
        ),
        ("# unit: mm\n" + rows_of(4, 1.0) + "1 0 0 0\n", "four lines for each pose"),
        ("# unit: mm\n" + "2 0 0 1 0 1 0 1 0 0 1 1\n", "a rotation that is off by"),
    ],
)
def test_rows_that_are_no_poses_are_named(tmp_path, text, problem):
    path = tmp_path / "poses.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=problem):
        read_table(path)


@pytest.mark.parametrize("front", ["", "pose.", "pose.pose.", "field.pose."])
def test_ros_poses_are_read_by_their_names_with_w_last(tmp_path, front):
    names = [f"{front}position.{a}" for a in "xyz"] + [f"{front}orientation.{a}" for a in "xyzw"]
    lines = [",".join(["time", *names])]
    for pose in POSES:
        w, x, y, z = pose.quaternion
        lines.append(",".join(repr(float(v)) for v in (0, *pose.position, x, y, z, w)))
    path = tmp_path / "poses.csv"
    path.write_text("\n".join(lines) + "\n")
    for capture, pose in zip(read_points(path).captures, POSES, strict=True):
        assert np.allclose(capture.T_base_flange.matrix, pose.matrix)


LEICA = "Target;X [mm];Y [mm];Z [mm]\nTMC 30-B #1;1,5;2;3\nTMC 30-B #1;4;5;6\n"
BARE = "X [in]\tY [in]\tZ [in]\n1\t2\t3\n4\t5\t6\n"
INCHES = "// SpatialAnalyzer\n// Units: inches\nC Axis1 A1_-60 1 2 3\nC Axis1 A1_0 4 5 6\n"
JOINTS = "# robot: ur5\nq1_deg,q2_deg,t_s\n10,20,0\n30,40,1\n"


@pytest.mark.parametrize(
    "text, first", [(LEICA, [1.5, 2, 3]), (BARE, [25.4, 50.8, 76.2]), (INCHES, [25.4, 50.8, 76.2])]
)
def test_a_trackers_list_beside_a_joint_list_is_a_recording(tmp_path, text, first):
    (tmp_path / "points.txt").write_text(text)
    (tmp_path / "joints.csv").write_text(JOINTS)
    paired = read_table(tmp_path / "points.txt", ReadOptions(joints=tmp_path / "joints.csv"))
    assert paired.kind == "tracker" and paired.keys["robot"] == "ur5"
    assert paired.number("q1") == pytest.approx(np.radians([10, 30]))
    assert 1e3 * paired.numbers("xyz")[0] == pytest.approx(first)
    assert "2 rows" in " ".join(paired.notes)


@pytest.mark.parametrize(
    "joints, problem",
    [
        (JOINTS + "50,60,2\n", "3 rows of joints; expected 2"),
        ("t_s\n1\n2\n", "no joint columns"),
        ("q1_deg\n1\n2,3\n", "2 cells"),
    ],
)
def test_lists_that_do_not_go_together_are_refused(tmp_path, joints, problem):
    (tmp_path / "points.txt").write_text(LEICA)
    (tmp_path / "joints.csv").write_text(joints)
    with pytest.raises(InputError, match=problem):
        read_table(tmp_path / "points.txt", ReadOptions(joints=tmp_path / "joints.csv")).numbers(["q1", "x"])


def test_a_reflector_in_the_column_target_is_no_name_of_a_point(tmp_path):
    (tmp_path / "points.txt").write_text(LEICA)
    assert read_table(tmp_path / "points.txt").text("name") == ["1", "2"]


@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    base=st.sampled_from(
        ["# unit: mm\n" + rows_of(16, 1.0), "# unit: m\n" + rows_of(4, 1.0), LEICA, BARE, JOINTS]
    ),
    at=st.integers(0, 400),
    noise=st.text(max_size=20),
)
def test_any_text_gives_a_table_or_one_line(tmp_path, base, at, noise):
    path = tmp_path / "poses.txt"
    path.write_text(base[:at] + noise + base[at:], encoding="utf-8", errors="replace")
    try:
        found = read_table(path)
        if found.has("x"):
            found.number("x")
    except InputError as error:
        assert "\n" not in str(error)
