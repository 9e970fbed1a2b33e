"""The Compare screen as a person uses it: record in a cell with a hidden fault, find it, put it into the simulation."""

import time

import numpy as np
import pytest

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

#: With the findings in the simulation the residual is noise: this share of what it was, at most.
SHRINKS_TO = 0.7


def compare(person):
    """The screen's own state on the server."""
    from app.pendant.screens._compare.kept import kept_for

    return kept_for(person.pendant.session.name)


def test_a_hidden_fault_is_found_and_put_into_the_simulation(serve, sit_down):
    person = sit_down(serve(robot="ur10e"))
    person.pendant.rng = np.random.default_rng(4)  # the cell's fault is drawn with it
    kept = compare(person)
    person.tab("Compare")
    person.click("Record with a hidden fault")
    person.until(lambda: kept.loaded is not None, "the recording")
    person.at_rest()
    person.picture("compare_loaded")
    before = np.linalg.norm(kept.loaded.vectors(0.0), axis=1).mean()
    assert "line" in person.seen("compare-row").lower()

    person.click("Find what is missing")
    person.until(lambda: kept.loaded.diagnosis is not None, "the diagnosis")
    person.at_rest()
    found = kept.loaded.diagnosis
    assert found.verdict == "named"
    assert found.findings[0].sentence in person.seen("compare-finding-1")
    person.picture("compare_found")

    person.click("Put it into the simulation")
    person.until(lambda: kept.loaded.applied, "the findings in the simulation")
    person.at_rest()
    after = np.linalg.norm(kept.loaded.vectors(1.0), axis=1).mean()
    assert after < SHRINKS_TO * before
    person.picture("compare_applied")

    person.click("What was hidden?")
    person.until(lambda: person.page.get_by_test_id("compare-truth").count() == 1, "the truth")
    assert found.findings[0].effect.replace("_", " ") in person.seen("compare-truth").lower()
    with person.page.expect_download() as waiting:
        person.click("Report")
    assert waiting.value.suggested_filename.endswith(".report.html")
    assert not person.faults


def log_file(folder, case):
    """The hand-made log as a file."""
    from app.recordings.columns import parse_column

    evidence = case.evidence
    n = evidence.q.shape[1]
    names = ["t_s", *(f"q{j}_rad" for j in range(1, n + 1)), *(f"tau{j}_Nm" for j in range(1, n + 1))]
    assert all(parse_column(name).known for name in names)
    rows = np.column_stack([evidence.t, evidence.q, evidence.measured])
    text = "\n".join([",".join(names), *(",".join(f"{v:.6f}" for v in row) for row in rows)])
    (folder / "log.csv").write_text(f"# kind: motion\n# robot: ur10e\n{text}\n", encoding="utf-8")


def test_a_log_plays_its_search_can_be_stopped_and_its_contact_is_marked(
    serve, sit_down, tmp_path, monkeypatch
):
    """The engine is a stand-in here: what is held is the screen."""
    from app.pendant.screens._compare import loaded as loading
    from tests.diagnosis.report.cases import motion_case

    case = motion_case()
    log_file(tmp_path, case)
    monkeypatch.chdir(tmp_path)
    asked, patience = [], {"steps": 2000}

    def slow(path, *, robot=None, model=None, progress=None):
        asked.append(path)
        for step in range(patience["steps"]):
            progress(step / patience["steps"], f"step {step}")
            time.sleep(0.01)
        return case

    monkeypatch.setattr(loading, "diagnose_file", slow)
    person = sit_down(serve(robot="ur10e"))
    kept = compare(person)
    person.tab("Compare")
    field = person.row("Or a path").locator("input")
    field.fill("../elsewhere.csv")
    field.press("Enter")
    person.click("Load from the path")
    person.until(lambda: any("below" in words for _, _, words in person.pendant.log), "the refusal")
    field.fill("log.csv")
    field.press("Enter")
    person.click("Load from the path")
    person.until(lambda: kept.loaded is not None, "the log")
    person.at_rest()

    person.click("Find what is missing")
    person.until(lambda: asked, "the search")
    person.click("Stop the search")
    person.until(
        lambda: any("stopped" in words for _, _, words in person.pendant.log), "the end of the search"
    )
    assert kept.loaded.diagnosis is None

    patience["steps"] = 5
    person.click("Find what is missing")
    person.until(lambda: kept.loaded.diagnosis is not None, "the diagnosis")
    person.at_rest()
    assert "Contact" in person.seen("compare-finding-2")
    assert person.page.get_by_test_id("compare-trace").locator(".window").count() > 0
    person.click("Put it into the simulation")
    person.click("Play")
    person.until(lambda: person.pendant.worker.running("compare.play"), "the log to play")
    person.picture("compare_log")
    assert "simulated [Nm]" in person.seen("compare-torques")
    person.click("Pause")
    person.until(lambda: not person.pendant.worker.running("compare.play"), "the log to stand")
    assert not person.faults


def test_a_saved_model_is_set_beside_a_recording_and_goes_into_the_practice_cell(serve, sit_down, tmp_path):
    from app.diagnosis.model import ModelEffect, SavedModel, save_model

    zero = ModelEffect("joint_zero", {"joint": 3}, {"offset": 0.004})
    save_model(SavedModel("static", "ur10e", (zero,), source="last_week.csv"), tmp_path / "model.json")
    person = sit_down(serve(robot="ur10e"))
    kept = compare(person)
    person.tab("Compare")
    person.page.get_by_text("Saved model", exact=True).click()
    with person.page.expect_file_chooser() as choosing:
        person.click("Send a model file")
    choosing.value.set_files(str(tmp_path / "model.json"))
    person.until(lambda: kept.model is not None, "the model")
    person.click("Record in a cell with it")
    person.until(lambda: kept.loaded is not None and kept.loaded.judged is not None, "the recording")
    person.at_rest()
    person.page.get_by_test_id("compare-judged").wait_for()
    assert "with the model" in person.seen("compare-judged")
    assert "last_week.csv" in person.page.locator("body").inner_text()
    person.click("Put it into the simulation")
    person.until(lambda: kept.loaded.applied, "the model in the simulation")
    person.at_rest()
    sizes = [np.linalg.norm(kept.loaded.vectors(share), axis=1).mean() for share in (0.0, 1.0)]
    assert sizes[1] < SHRINKS_TO * sizes[0]
    person.picture("compare_model")
    person.click("Put it into the practice cell")
    person.until(lambda: person.state.cell_model is not None, "the model in the practice cell")
    person.at_rest()
    q = person.pendant.q
    shown, true = person.pendant.world.shown_flange(q), person.pendant.world.true_flange(q)
    assert np.linalg.norm(shown.position - true.position) > 1e-3
    person.page.get_by_test_id("compare-cell").wait_for()
    assert "joint 3" in person.seen("compare-cell")
    person.page.reload()
    person.until(
        lambda: any(p is not person.pendant and p.world.faults for p in person.server.pendants),
        "the model in the practice cell after a reload",
    )
    assert not person.faults
