"""The Compare screen as a person uses it: record in a cell with a hidden fault, find it, put it into the simulation."""

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
