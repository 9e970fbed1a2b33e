"""Recordings that are not what they say: a clear line or a warning in the result, never a wrong name.

Every damage is done to a recording of a sound arm and to one whose joint 2 gives way, so that neither a false alarm nor
a wrong name for a true fault goes unseen.
"""

import json

import numpy as np
import pytest

from tests.cli.running import assert_one_line, teachframe

TRUTH = ("joint_compliance", 2)
FAULT = "joint_compliance:joint=2"


class Recording:
    """A CSV as text that can be damaged column by column."""

    def __init__(self, text):
        lines = text.splitlines()
        start = next(i for i, line in enumerate(lines) if not line.startswith("#"))
        self.head, self.names = lines[:start], lines[start].split(",")
        self.rows = [line.split(",") for line in lines[start + 1 :]]

    def change(self, name, to):
        """Every cell of a column: to(row number from 0, text) -> text."""
        i = self.names.index(name)
        for k, row in enumerate(self.rows):
            row[i] = to(k, row[i])
        return self

    def write(self, path):
        body = (",".join(row) for row in self.rows)
        path.write_text("\n".join([*self.head, ",".join(self.names), *body]) + "\n", encoding="utf-8")
        return path


@pytest.fixture(scope="module")
def texts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("good")
    out = {}
    for kind in ("tracker", "touch"):
        for name, fault in (("sound", ()), ("soft", ("--effect", FAULT))):
            path = folder / f"{kind}_{name}.csv"
            said = teachframe("simulate", path, "--robot", "ur10e", "--kind", kind, "--seed", "3", *fault)
            assert said.code == 0, said.err
            out[kind, name] = path.read_text(encoding="utf-8")
    return out


@pytest.fixture(params=["sound", "soft"], name="arm")
def either_arm(request):
    return request.param


def diagnosed(recording, path):
    said = teachframe("diagnose", recording.write(path), "--json")
    assert said.code == 0, said.err
    out = json.loads(said.out)
    named = [(f["effect"], f["where"].get("joint")) for f in out["findings"]]
    return out, named


def refused(recording, path, *words):
    assert_one_line(teachframe("diagnose", recording.write(path), "--json"), path.name, *words)


def told(out, *words):
    return any(all(word in note for word in words) for note in out["notes"])


def test_a_recording_of_another_shipped_robot_is_refused_with_the_robot_it_fits(texts, arm, tmp_path):
    recording = Recording(texts["tracker", arm].replace("robot: ur10e", "robot: ur5"))
    refused(recording, tmp_path / "r.csv", "another arm", "--robot ur10e")


def test_touches_of_another_robot_name_nothing_and_say_so(texts, arm, tmp_path):
    recording = Recording(texts["touch", arm].replace("robot: ur10e", "robot: ur5"))
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert out["verdict"] == "unexplained" and not named and told(out, "another arm")


def test_a_kind_that_only_the_columns_tell_is_diagnosed_as_such(texts, tmp_path):
    recording = Recording(texts["touch", "soft"].replace("# kind: touch\n", ""))
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert out["kind"] == "touch" and named == [TRUTH]


@pytest.mark.parametrize("kind", ["tracker", "touch"])
def test_one_joint_in_radians_under_a_name_in_degrees_is_refused_by_name(texts, kind, arm, tmp_path):
    recording = Recording(texts[kind, arm])
    recording.names[recording.names.index("q5_rad")] = "q5_deg"
    refused(recording, tmp_path / "r.csv", "column q5_deg", "look like radians")


def test_half_of_a_column_in_degrees_is_refused_with_its_cell(texts, arm, tmp_path):
    recording = Recording(texts["tracker", arm])
    recording.change("q5_rad", lambda k, v: str(np.degrees(float(v))) if k % 2 else v)
    refused(recording, tmp_path / "r.csv", "column q5_rad", "row")


@pytest.mark.parametrize("axes", ["xyz", "z"])
def test_metres_and_millimetres_mixed_name_nothing(texts, axes, arm, tmp_path):
    recording = Recording(texts["tracker", arm])
    for axis in axes:
        half = len(recording.rows) // 2 if len(axes) > 1 else 0
        recording.change(f"{axis}_mm", lambda k, v, half=half: str(float(v) / 1e3) if k >= half else v)
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert out["verdict"] == "unexplained" and not named and told(out, "do not belong to these poses")


def test_metres_throughout_are_named_as_the_units_and_as_nothing_else(texts, arm, tmp_path):
    recording = Recording(texts["tracker", arm])
    for axis in "xyz":
        recording.change(f"{axis}_mm", lambda k, v: str(float(v) / 1e3))
    _, named = diagnosed(recording, tmp_path / "r.csv")
    assert named == [("wrong_convention", None), *([TRUTH] if arm == "soft" else [])]


@pytest.mark.parametrize("kind", ["tracker", "touch"])
def test_a_joint_column_of_zeros_names_nothing_and_says_it_never_moves(texts, kind, arm, tmp_path):
    out, named = diagnosed(
        Recording(texts[kind, arm]).change("q3_rad", lambda k, v: "0.0"), tmp_path / "r.csv"
    )
    assert out["verdict"] == "unexplained" and not named and told(out, "joint 3 never moves")


def test_a_measured_column_of_zeros_is_refused(texts, arm, tmp_path):
    recording = Recording(texts["tracker", arm]).change("x_mm", lambda k, v: "0")
    refused(recording, tmp_path / "r.csv", "column x_mm", "every value is 0")


@pytest.mark.parametrize("times", ["same", "other"])
@pytest.mark.parametrize("kind", ["tracker", "touch"])
def test_duplicate_rows_count_once_whatever_their_time(texts, kind, times, arm, tmp_path):
    recording = Recording(texts[kind, arm])
    recording.rows = [list(row) for row in recording.rows for _ in range(3)]
    if times == "other":
        recording.change("t_s", lambda k, v: f"{k}.0")
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert named == ([TRUTH] if arm == "soft" else [])
    assert out["verdict"] == ("named" if arm == "soft" else "clean")
    assert told(out, "120 rows are exact copies")


@pytest.mark.parametrize("kind", ["tracker", "touch"])
def test_ten_rows_give_no_wrong_name(texts, kind, arm, tmp_path):
    recording = Recording(texts[kind, arm])
    recording.rows = recording.rows[::6]
    _, named = diagnosed(recording, tmp_path / "r.csv")
    assert set(named) <= ({("joint_compliance", 2)} if arm == "soft" else set())


@pytest.mark.parametrize("kind", ["tracker", "touch"])
def test_angles_outside_the_limits_are_said_and_change_no_name(texts, kind, arm, tmp_path):
    recording = Recording(texts[kind, arm]).change("q3_rad", lambda k, v: str(float(v) + 2 * np.pi))
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert told(out, "outside the robot's joint limits")
    assert named == ([TRUTH] if arm == "soft" else [])


def test_targets_touched_once_are_said_and_change_no_name(texts, arm, tmp_path):
    recording = Recording(texts["touch", arm]).change("target", lambda k, v: f"once {k}" if k % 2 else v)
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert told(out, "30 targets were touched only once")
    assert named in ([], [TRUTH]) if arm == "soft" else not named


@pytest.mark.parametrize("how", ["", "0"])
def test_a_reflector_lost_in_half_of_the_rows_gives_no_wrong_name(texts, how, arm, tmp_path):
    recording = Recording(texts["tracker", arm])
    for axis in "xyz":
        recording.change(f"{axis}_mm", lambda k, v: how if k % 2 else v)
    out, named = diagnosed(recording, tmp_path / "r.csv")
    assert named in ([], [TRUTH]) if arm == "soft" else not named
    assert told(out, "reflector 1 was lost in 30 of 60 rows" if not how else "do not belong to these poses")


def test_names_of_targets_that_were_mixed_up_name_nothing(texts, arm, tmp_path):
    recording = Recording(texts["touch", arm])
    column = recording.names.index("target")
    labels = [row[column] for row in recording.rows]
    np.random.default_rng(1).shuffle(labels)
    recording.change("target", lambda k, v: labels[k])
    _, named = diagnosed(recording, tmp_path / "r.csv")
    assert not named
