"""teachframe diagnose: bad input, and the way from a file to its engine, without any engine's arithmetic."""

import json
import sys
import types

import numpy as np
import pytest

from app.diagnosis import dispatch
from app.kinematics import load_robot
from tests.cli.running import assert_one_line, teachframe
from tests.diagnosis.report.cases import static_case

ROBOT = "ur10e"


def recording(
    folder, name="run.csv", *, head=f"# kind: touch\n# robot: {ROBOT}\n", joints=6, extra=",target", rows=12
):
    """A small touch file of the right shape."""
    rng = np.random.default_rng(0)
    lines = [",".join(f"q{j}_rad" for j in range(1, joints + 1)) + extra]
    lines += [
        ",".join(f"{v:.4f}" for v in rng.uniform(-1, 1, joints)) + (",A" if extra else "")
        for _ in range(rows)
    ]
    path = folder / name
    path.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def engine(monkeypatch):
    """An engine that gives a ready answer and remembers what it was asked."""
    asked = {}

    def diagnose(table, robot, *, progress=None, seed=0, model=None, reference=None):
        asked.update(table=table, robot=robot, seed=seed, model=model, reference=reference)
        if progress:
            progress(0.5, "half")
        return static_case()

    fake = types.ModuleType("fake_engine")
    fake.diagnose = diagnose
    monkeypatch.setitem(sys.modules, "fake_engine", fake)
    monkeypatch.setattr(dispatch, "ENGINES", dict.fromkeys(dispatch.ENGINES, "fake_engine"))
    return asked


def test_json_is_one_line_in_the_contract_format(tmp_path, engine):
    path = recording(tmp_path)
    said = teachframe("diagnose", path, "--json")
    assert said.code == 0 and said.err == "" and said.out.count("\n") == 1
    out = json.loads(said.out)
    assert out["format"] == "teachframe.diagnosis/1"
    assert out["file"] == str(path) and out["kind"] == "touch"
    assert set(out) >= {
        "robot", "samples", "verdict", "noise", "before", "after", "findings", "families", "outliers", "leftover",
        "next_poses", "seconds",
    }  # fmt: skip
    assert set(out["findings"][0]) == {
        "effect", "where", "parameters", "visible", "p_value", "heldout_rms_without", "heldout_rms_with",
        "alternatives", "sentence", "equation",
    }  # fmt: skip


def test_the_default_output_is_for_a_person(tmp_path, engine):
    said = teachframe("diagnose", recording(tmp_path))
    assert said.code == 0 and said.out.splitlines()[2].startswith("NAMED: ")


def test_the_robot_named_by_the_header_is_found_beside_the_file(tmp_path, engine, monkeypatch):
    (tmp_path / "arm").mkdir()
    urdf = tmp_path / "arm" / "mine.urdf"
    urdf.write_bytes(load_robot(ROBOT).path.read_bytes())
    path = recording(tmp_path / "arm", head="# kind: touch\n# robot: mine.urdf\n")
    monkeypatch.chdir("/")
    assert teachframe("diagnose", path).code == 0
    assert engine["robot"].path == urdf


def test_a_robot_on_the_command_line_wins(tmp_path, engine):
    path = recording(tmp_path, head="# kind: touch\n# robot: nowhere.urdf\n")
    assert teachframe("diagnose", path, "--robot", ROBOT).code == 0
    assert engine["robot"].name == ROBOT


def test_seed_and_model_reach_the_engine(tmp_path, engine):
    from app.diagnosis.model import SavedModel, save_model

    save_model(SavedModel("static", ROBOT), tmp_path / "m.json")
    teachframe("diagnose", recording(tmp_path), "--seed", "7", "--model", tmp_path / "m.json")
    assert engine["seed"] == 7 and engine["model"].robot == ROBOT


def test_a_report_is_written_and_named_on_stderr(tmp_path, engine):
    out = tmp_path / "page.html"
    said = teachframe("diagnose", recording(tmp_path), "--report", out)
    assert said.code == 0 and str(out) in said.err
    assert out.read_text(encoding="utf-8").startswith("<!doctype html>")


def test_the_report_speaks_chinese_when_asked_and_json_and_terminal_stay_english(tmp_path, engine):
    path, out = recording(tmp_path), tmp_path / "page.html"
    asked = ("--language", "zh", "--report", out)
    for more in ((), ("--json",)):
        in_english, in_chinese = (teachframe("diagnose", path, *more, *rest) for rest in ((), asked))
        assert in_chinese.code == 0 and in_chinese.out == in_english.out
        page = out.read_text(encoding="utf-8")
        assert "<h2>描述遗漏了什么</h2>" in page and "What was left out" not in page


def test_a_kind_that_the_header_leaves_out_is_read_from_the_columns_and_said(tmp_path, engine):
    said = teachframe("diagnose", recording(tmp_path, head=f"# robot: {ROBOT}\n"))
    assert said.code == 0 and "'# kind:'" in said.out


@pytest.mark.parametrize(("kind", "command"), [("points", "teachframe solve"), ("arcs", "teachframe base")])
def test_a_file_for_another_command_is_sent_there(tmp_path, kind, command):
    assert_one_line(teachframe("diagnose", recording(tmp_path, head=f"# kind: {kind}\n")), "run.csv", command)


def test_no_robot_names_both_ways_to_give_one(tmp_path):
    said = teachframe("diagnose", recording(tmp_path, head="# kind: touch\n"))
    assert_one_line(said, "run.csv", "column robot", "--robot", "# robot:")


def test_a_robot_that_is_not_there_names_the_file_and_lists_the_robots(tmp_path):
    said = teachframe("diagnose", recording(tmp_path, head="# kind: touch\n# robot: none.urdf\n"))
    assert_one_line(said, "run.csv", "none.urdf", ROBOT)


def test_a_robot_that_is_no_name_is_one_line(tmp_path):
    assert_one_line(
        teachframe("diagnose", recording(tmp_path, head="# kind: touch\n# robot: [1, 2]\n")), "column robot"
    )


def test_an_unknown_kind_lists_the_kinds(tmp_path):
    said = teachframe("diagnose", recording(tmp_path, head="# kind: tocuh\n"))
    assert_one_line(said, "run.csv", "column kind", "touch", "tracker", "motion")


def test_too_few_joints_for_the_robot_are_refused(tmp_path):
    n = load_robot(ROBOT).joint_count
    assert_one_line(teachframe("diagnose", recording(tmp_path, joints=n - 1)), "run.csv", "row 3", f"q{n}_")


def test_too_many_joints_for_the_robot_are_refused(tmp_path):
    n = load_robot(ROBOT).joint_count
    assert_one_line(
        teachframe("diagnose", recording(tmp_path, joints=n + 1)), "run.csv", f"q{n + 1}_rad", f"{n} joints"
    )


def test_a_turning_joint_in_metres_is_refused(tmp_path):
    path = recording(tmp_path)
    path.write_text(path.read_text().replace("q2_rad", "q2_m"))
    assert_one_line(teachframe("diagnose", path), "run.csv", "q2_m", "q2_rad or q2_deg")


def test_an_angle_beyond_any_joint_names_its_cell(tmp_path):
    path = recording(tmp_path)
    lines = path.read_text().splitlines()
    lines[5] = "1e308," + lines[5].partition(",")[2]
    path.write_text("\n".join(lines) + "\n")
    assert_one_line(teachframe("diagnose", path), "run.csv", "row 6", "column q1_rad", "1e308", "100 rad")


def test_a_reference_for_touches_is_refused(tmp_path):
    path = recording(tmp_path)
    assert_one_line(teachframe("diagnose", path, "--reference", path), "run.csv", "--reference", "motion")


def test_a_model_of_the_other_kind_is_refused(tmp_path):
    from app.diagnosis.model import SavedModel, save_model

    save_model(SavedModel("motion", ROBOT), tmp_path / "m.json")
    said = teachframe("diagnose", recording(tmp_path), "--model", tmp_path / "m.json")
    assert_one_line(said, "motion", "static")


@pytest.mark.parametrize("option", ["--report", "--save-model", "--save-urdf"])
def test_a_folder_that_is_not_there_is_said_before_the_work(tmp_path, option):
    said = teachframe("diagnose", recording(tmp_path), option, tmp_path / "none" / "x")
    assert_one_line(said, "none")


def test_one_model_file_for_two_recordings_is_refused(tmp_path):
    path = recording(tmp_path)
    assert_one_line(teachframe("diagnose", path, path, "--save-model", tmp_path / "m.json"), "--save-model")


def test_no_file_is_one_line():
    assert_one_line(teachframe("diagnose"), "FILE")


def test_bad_files_among_many_each_give_their_line_and_exit_2(tmp_path):
    a = recording(tmp_path, "a.csv", head="# kind: points\n")
    b = recording(tmp_path, "b.csv", head="# kind: touch\n")
    said = teachframe("diagnose", a, b, tmp_path / "none.csv", "--json")
    assert said.code == 2 and said.out == ""
    lines = said.err.splitlines()
    assert [name in line for name, line in zip(("a.csv", "b.csv", "none.csv"), lines, strict=True)] == [
        True
    ] * 3
