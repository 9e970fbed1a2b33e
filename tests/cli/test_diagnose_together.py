"""Several recordings of one arm: learnt on two of them, judged on the third."""

import json

import numpy as np
import pytest

from app.recordings import read_table
from app.recordings.joining import joined
from tests.cli.running import assert_one_line, teachframe

SMALL_MM = 0.35  # what the fault does to each recording alone, about twice the noise
NEAR_NOISE_MM = 0.2


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Three tracker recordings of one soft arm, each from a set-up of its own."""
    folder = tmp_path_factory.mktemp("runs")
    out = []
    for seed, name in enumerate("abc", 4):
        path = folder / f"run_{name}.csv"
        effect = "joint_compliance:joint=2,compliance=3e-5"
        said = teachframe(
            "simulate", path, "--robot", "ur10e", "--kind", "tracker", "--effect", effect, "--seed", seed
        )
        assert said.code == 0, said.err
        out.append(path)
    return out


def test_what_two_recordings_share_is_learnt_and_predicts_a_third(runs, tmp_path):
    a, b, c = runs
    model, page = tmp_path / "model.json", tmp_path / "page.html"
    said = teachframe("diagnose", a, b, "--together", "--json", "--save-model", model)
    assert said.code == 0, said.err
    learnt = json.loads(said.out)
    assert learnt["samples"] == 120 and learnt["file"].endswith("run_a.csv + run_b.csv")
    assert [(f["effect"], f["where"]["joint"]) for f in learnt["findings"]] == [("joint_compliance", 2)]
    assert any("run_a.csv 1 to 60, run_b.csv 61 to 120" in note for note in learnt["notes"])
    said = teachframe("diagnose", c, "--model", model, "--json", "--report", page)
    steps = json.loads(said.out)["judged"]["steps"]
    assert steps["description alone"]["heldout_rms"] > SMALL_MM
    assert steps["with the model"]["heldout_rms"] < NEAR_NOISE_MM
    assert "The given model on this recording" in page.read_text(encoding="utf-8")
    text = teachframe("diagnose", c, "--model", model).out
    assert "with the model" in text and "learnt on run_a.csv + run_b.csv" in text


def test_a_parameter_learnt_on_two_is_known_better_than_on_one(runs):
    def std(*argv):
        said = json.loads(teachframe("diagnose", *argv, "--json").out)
        return said["findings"][0]["parameters"][0]["std"]

    assert std(runs[0], runs[1], "--together") < 0.85 * std(runs[0])


def test_a_wrong_model_is_seen_to_make_an_unseen_recording_worse(runs, tmp_path):
    from app.diagnosis.model import ModelEffect, SavedModel, save_model

    wrong = ModelEffect("joint_compliance", {"joint": 2, "driver": "gravity_torque"}, {"compliance": -3e-5})
    save_model(SavedModel("static", "ur10e", (wrong,), source="elsewhere.csv"), tmp_path / "wrong.json")
    out = json.loads(teachframe("diagnose", runs[2], "--model", tmp_path / "wrong.json", "--json").out)
    steps = out["judged"]["steps"]
    assert steps["with the model"]["heldout_rms"] > 1.5 * steps["description alone"]["heldout_rms"]


def test_a_model_of_a_log_is_judged_on_another_log(tmp_path):
    common = ("--robot", "ur10e", "--kind", "motion", "--effect", "coulomb_friction:joint=2,size=12")
    for seed, name in ((1, "a"), (2, "b")):
        assert teachframe("simulate", tmp_path / f"{name}.csv", *common, "--seed", seed).code == 0
    model = tmp_path / "m.json"
    assert teachframe("diagnose", tmp_path / "a.csv", "--save-model", model).code == 0
    out = json.loads(teachframe("diagnose", tmp_path / "b.csv", "--model", model, "--json").out)
    steps = out["judged"]["steps"]
    assert steps["with the model"]["heldout_rms"] < 0.5 * steps["description alone"]["heldout_rms"]
    assert out["findings"] == []


def test_joined_rows_keep_their_files_apart(tmp_path):
    head = "# kind: touch\n# robot: ur10e\nq1_rad,t_s,target,note\n"
    (tmp_path / "a.csv").write_text(head + "0.1,0,T1,x\n0.2,5,T2,x\n", encoding="utf-8")
    (tmp_path / "b.csv").write_text(head.replace(",note", "") + "0.3,0,T1\n", encoding="utf-8")
    table, notes = joined([read_table(tmp_path / n) for n in ("a.csv", "b.csv")])
    assert table.text("target") == ["1:T1", "1:T2", "2:T1"]  # places that nobody measured are not the same
    assert table.text("session") == ["1:", "1:", "2:"]
    assert np.all(np.diff(table.number("t")) > 0)
    assert table.rows.tolist() == [1, 2, 3] and "a.csv 1 to 2, b.csv 3 to 3" in notes[0]


def test_recordings_that_do_not_belong_together_are_refused(runs, tmp_path):
    a, b, _ = runs
    other = tmp_path / "other.csv"
    other.write_text(b.read_text().replace("robot: ur10e", "robot: ur5"), encoding="utf-8")
    assert_one_line(teachframe("diagnose", a, other, "--together"), "other.csv", "robot", "ur10e")
    other.write_text(b.read_text().replace("q1_rad", "q1_deg"), encoding="utf-8")
    assert_one_line(teachframe("diagnose", a, other, "--together"), "other.csv", "q1_deg", "same unit")
    other.write_text(b.read_text().replace("z_mm", "height"), encoding="utf-8")
    assert_one_line(teachframe("diagnose", a, other, "--together"), "other.csv", "z_mm")
    other.write_text(b.read_text().replace("kind: tracker", "kind: motion"), encoding="utf-8")
    assert_one_line(teachframe("diagnose", a, other, "--together"), "other.csv", "kind")
