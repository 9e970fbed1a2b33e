"""Logs that are not what they say: a clear line or a warning in the result, never a wrong name."""

import numpy as np
import pytest

from tests.cli.running import teachframe
from tests.cli.test_bad_static_recordings import Recording, diagnosed, refused, told

TRUTH = ("coulomb_friction", 2)


@pytest.fixture(scope="module")
def texts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("logs")
    out = {}
    for name, fault in (("sound", ()), ("rough", ("--effect", "coulomb_friction:joint=2"))):
        path = folder / f"{name}.csv"
        common = ("--robot", "ur10e", "--kind", "motion", "--seed", "2", "--samples", "2000")
        said = teachframe("simulate", path, *common, *fault)
        assert said.code == 0, said.err
        out[name] = path.read_text(encoding="utf-8")
    return out


@pytest.fixture(params=["sound", "rough"], name="arm")
def either_arm(request):
    return request.param


def swapped(recording, a, b, *prefixes):
    for prefix, unit in (("q", "rad"), ("qd", "rad_s"), ("tau", "Nm")):
        if prefix in prefixes:
            i, j = (recording.names.index(f"{prefix}{k}_{unit}") for k in (a, b))
            for row in recording.rows:
                row[i], row[j] = row[j], row[i]
    return recording


def test_time_that_runs_backwards_is_refused_with_its_row(texts, arm, tmp_path):
    recording = Recording(texts[arm])
    recording.rows.reverse()
    refused(recording, tmp_path / "r.csv", "column t_s", "backwards")


def test_time_that_stands_still_is_refused(texts, tmp_path):
    recording = Recording(texts["sound"]).change("t_s", lambda k, v: "1.0")
    refused(recording, tmp_path / "r.csv", "column t_s")


def test_a_position_that_never_changes_while_its_speed_does_is_refused(texts, arm, tmp_path):
    recording = Recording(texts[arm]).change("q4_rad", lambda k, v: "0.5")
    refused(recording, tmp_path / "r.csv", "column q4_rad", "same in every row")


def test_a_speed_that_never_changes_is_said_and_changes_no_name(texts, arm, tmp_path):
    recording = Recording(texts[arm]).change("qd4_rad_s", lambda k, v: "0.0")
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert told(out, "speed of joint 4 stands still")
    assert named == ([TRUTH] if arm == "rough" else [])


@pytest.mark.parametrize("prefixes", [("q", "qd"), ("tau",), ("q", "qd", "tau")])
def test_swapped_joints_are_undone_and_said(texts, prefixes, tmp_path):
    recording = swapped(Recording(texts["rough"]), 2, 4, *prefixes)
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert named == [("wrong_convention", 2), TRUTH]
    assert "joints 2 and 4 are changed over" in str(out["findings"])


def test_degrees_marked_as_radians_are_refused(texts, tmp_path):
    recording = Recording(texts["sound"])
    for j in range(1, 7):
        recording.change(f"q{j}_rad", lambda k, v: str(np.degrees(float(v))))
    refused(recording, tmp_path / "r.csv", "degrees marked as radians")


@pytest.mark.parametrize("joint", [2, 3])
def test_one_joint_in_radians_under_names_in_degrees_is_undone_and_said(texts, joint, arm, tmp_path):
    recording = Recording(texts[arm])
    renamed = {f"q{joint}_rad": f"q{joint}_deg", f"qd{joint}_rad_s": f"qd{joint}_deg_s"}
    recording.names = [renamed.get(name, name) for name in recording.names]
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert named == [("wrong_convention", joint), *([TRUTH] if arm == "rough" else [])]
    assert f"the positions of joint {joint} are true at 57.3 times what is written" in str(out["findings"])


def test_currents_without_gains_ask_for_them_or_mark_their_own(texts, arm, tmp_path):
    recording = Recording(texts[arm])
    recording.names = [name.replace("tau", "i").replace("_Nm", "_A") for name in recording.names]
    recording.head = [line for line in recording.head if "noise" not in line]
    refused(recording, tmp_path / "r.csv", "drive_gain_Nm_per_A", "motor currents without drive gains")


def test_a_third_of_corrupt_rows_is_counted_and_gives_no_wrong_name(texts, arm, tmp_path):
    recording, rng = Recording(texts[arm]), np.random.default_rng(3)
    for k in rng.choice(len(recording.rows), int(0.3 * len(recording.rows)), replace=False):
        for cell in rng.choice(len(recording.names), 3, replace=False):
            recording.rows[k][cell] = str(rng.choice(["nan", "", "xx", "1e9", "-"]))
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert told(out, "600 of 2000 rows")
    assert named in ([], [TRUTH]) if arm == "rough" else not named


def test_torques_of_another_size_are_a_factor_of_all(texts, tmp_path):
    recording = Recording(texts["rough"])
    for j in range(1, 7):
        recording.change(f"tau{j}_Nm", lambda k, v: str(float(v) / 1e3))
    _, named = diagnosed(recording, tmp_path / "r.csv")
    assert sorted(named, key=str) == sorted([("torque_constant", None), TRUTH], key=str)
