"""The Compare screen as a person uses it: record in a cell with a hidden fault, find it, put it into the simulation."""

import time

import numpy as np
import pytest

from app.apart import GivenUpError
from app.diagnosis.report.drawing.bars import before_after_bars
from app.diagnosis.result import Diagnosis, Leftover, Noise, Quality
from app.screens._compare import finding, plots

pytestmark = pytest.mark.browser

#: With the findings in the simulation the residual is noise: this share of what it was, at most.
SHRINKS_TO = 0.7


def compare(person):
    """The screen's own state on the server."""
    from app.screens._compare.kept import kept_for

    return kept_for(person.context.session.name)


def test_a_hidden_fault_is_found_and_put_into_the_simulation(sit_down, brisk):
    person = sit_down()
    person.context.rng = np.random.default_rng(4)  # the cell's fault is drawn with it
    kept = compare(person)
    person.screen("compare")
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


#: Texts of the bars that stand on one line nearer than an eye parts them [words, words, px].
_TOUCHING = """([markup, wide]) => {
    const place = Object.assign(document.createElement("div"), { innerHTML: markup });
    document.querySelector("#screens .screen:not([hidden])").prepend(place);
    place.style.width = wide + "px";
    const texts = [...place.querySelectorAll("svg text")].map((one) => [one.textContent, one.getBoundingClientRect()]);
    const frame = place.querySelector("svg").getBoundingClientRect();
    const near = texts.flatMap(([a, one]) => texts
        .filter(([, other]) => other.left > one.left && Math.abs(one.bottom - other.bottom) < 5
            && other.left - one.right < GAP)
        .map(([b, other]) => [a, b, other.left - one.right]));
    near.push(...texts.filter(([, one]) => one.right > frame.right).map(([a]) => [a, "edge", 0]));
    place.remove();
    return near;
}"""
GAP_PX = 6


@pytest.mark.parametrize("unit", ["mm", "Nm"])
def test_the_unit_of_the_bars_keeps_off_the_last_number(sit_down, unit):
    """The number of a tick at the very end ran into the unit behind it, in a panel of any width and in a report."""
    person = sit_down()
    person.screen("compare")
    script = _TOUCHING.replace("GAP", str(GAP_PX))
    for most in (0.25, 0.3, 1.25, 2.5, 12.5, 1000.0, 1250.0):
        quality = Quality(most, 0.99 * most, unit)
        drawn = Diagnosis(
            "x.csv", "touch", "ur10e", 9, "named", Noise(0.1 * most, unit, "stated"), quality, quality, (), (),
            Leftover(1.0, {}), (), 0.0,
        )  # fmt: skip
        for wide in (280, 324, 360, 700):
            assert not (near := person.page.evaluate(script, [plots.bars(drawn), wide])), (most, wide, near)
        sheet = plots._framed(before_after_bars(drawn), "sheet", "en")  # as wide as a report draws it
        assert not (near := person.page.evaluate(script, [sheet, 700])), (most, near)


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
    sit_down, brisk, tmp_path, monkeypatch
):
    """The engine is a stand-in here: what is held is the screen."""
    from tests.diagnosis.report.cases import motion_case

    case = motion_case()
    log_file(tmp_path, case)
    monkeypatch.chdir(tmp_path)
    asked, patience = [], {"steps": 2000}

    def slow(job, path, *args, bounds, say, stop):
        asked.append(path)
        for step in range(patience["steps"]):
            if stop.is_set():
                raise GivenUpError("given up")
            say(step / patience["steps"], f"step {step}")
            time.sleep(0.01)
        return case

    monkeypatch.setattr(finding, "apart", slow)
    person = sit_down()
    kept = compare(person)
    person.screen("compare")
    field = person.page.get_by_label("Or a path", exact=True)
    field.fill("../elsewhere.csv")
    field.press("Enter")
    person.click("Load from the path")
    person.until(lambda: any("below" in words for _, _, words in person.context.log), "the refusal")
    field.fill("log.csv")
    field.press("Enter")
    person.click("Load from the path")
    person.until(lambda: kept.loaded is not None, "the log")
    person.at_rest()

    person.click("Find what is missing")
    person.until(lambda: asked, "the search")
    person.click("Stop the search")
    person.until(
        lambda: any("stopped" in words for _, _, words in person.context.log), "the end of the search"
    )
    assert kept.loaded.diagnosis is None

    patience["steps"] = 5
    person.click("Find what is missing")
    person.until(lambda: kept.loaded.diagnosis is not None, "the diagnosis")
    person.at_rest()
    assert "Contact" in person.seen("compare-finding-2")
    # The trace is drawn after the finding, in a message of its own: it is waited for, not looked at once.
    person.page.get_by_test_id("compare-trace").locator(".window").first.wait_for(state="attached")
    person.click("Put it into the simulation")
    person.click("Play")
    person.until(lambda: person.context.worker.running("compare.play"), "the log to play")
    person.picture("compare_log")
    assert "simulated [Nm]" in person.seen("compare-torques")
    person.click("Pause")
    person.until(lambda: not person.context.worker.running("compare.play"), "the log to stand")
    assert not person.faults


def test_a_saved_model_is_set_beside_a_recording_and_goes_into_the_practice_cell(sit_down, brisk, tmp_path):
    from app.diagnosis.model import ModelEffect, SavedModel, save_model

    zero = ModelEffect("joint_zero", {"joint": 3}, {"offset": 0.004})
    save_model(SavedModel("static", "ur10e", (zero,), source="last_week.csv"), tmp_path / "model.json")
    person = sit_down()
    kept = compare(person)
    person.screen("compare")
    person.unfold("Saved model")
    person.page.get_by_label("Send a model file", exact=True).set_input_files(tmp_path / "model.json")
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
    world, q = person.context.world, person.q
    shown, true = world.shown_flange(q), world.true_flange(q)
    assert np.linalg.norm(shown.position - true.position) > 1e-3
    person.page.get_by_test_id("compare-cell").wait_for()
    assert "joint 3" in person.seen("compare-cell")
    person.page.reload()
    person.come_back()
    person.unfold("Saved model")
    person.reads("compare-cell", "joint 3")
    assert person.context.world.faults
    assert not person.faults


def test_a_recording_and_its_description_are_dropped_together_in_a_zip(sit_down, brisk, tmp_path):
    import zipfile

    from app import resources
    from tests.diagnosis.report.cases import motion_case

    log_file(tmp_path, motion_case())
    text = (tmp_path / "log.csv").read_text().replace("# robot: ur10e\n", "")
    urdf = next((resources.ROBOTS / "ur10e").glob("*.urdf")).read_text(encoding="utf-8")
    with zipfile.ZipFile(tmp_path / "both.zip", "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("run/log.csv", text)
        packed.writestr("run/arm.urdf", urdf)
    person = sit_down("irb120")
    kept = compare(person)
    person.screen("compare")
    person.page.get_by_label("Drop a recording and its URDF", exact=True).first.set_input_files(
        tmp_path / "both.zip"
    )
    person.until(lambda: kept.loaded is not None, "the recording")
    assert kept.loaded.robot.joint_count == 6 and kept.urdf.name == "arm.urdf"
    # The read-outs are those of the arm that is seen, and it is not jogged.
    person.reads("status-robot", kept.loaded.robot.said("title", "en"))
    assert person.page.locator(".jk").first.is_disabled()
    person.click("Close the recording")
    person.until(lambda: person.context.seen is None, "the own arm")
    assert not person.faults
