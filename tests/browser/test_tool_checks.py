"""What goes wrong while teaching, seen by a person: by name, with the advice; and the sheet on one page of paper."""

import re

import numpy as np
import pytest

from app.calibration.report import report, two_robots_report
from app.calibration.solving import solve_file
from app.diagnosis.report import as_page
from app.resources import STATIC
from app.session import Session
from app.session.actions import Calculate, ChooseMode, Enter
from app.simulation.tracker_cell import make_cell
from app.simulation.tracker_procedure import carry_out
from tests.calibration.drawing import captures, touches
from tests.diagnosis.report.cases import motion_case, static_case
from tests.screens.tool.test_checks_shown import CASES
from tests.session.wizard import wizard_actions

pytestmark = pytest.mark.browser

SEEN = ("bumped spike", "wrong Euler order", "orientation changed", "too few")
TABLE_1 = STATIC / "samples" / "xiong2012_table1.csv"


def showing(person, place):
    """Whether a result, or a refusal, is there."""
    return person.state.result is not None if place == "notes" else person.view("deciding")._refused.visible


def test_a_person_reads_what_went_wrong_by_name_with_the_advice(sit_down, brisk, tmp_path):
    person = sit_down()
    person.unfold("Examples and files")
    for case in SEEN:
        _, text, words = CASES[case]
        path = tmp_path / f"{case.replace(' ', '_')}.csv"
        path.write_text(text(), encoding="utf-8")
        person.page.get_by_label("Load a points file", exact=True).set_input_files(path)
        place = "refused" if case == "too few" else "notes"
        with person.holding():
            person.until(lambda place=place: showing(person, place), f"the arm to have gone through {case}")
            person.at_rest()
        if place == "notes":
            person.unfold("Details")
        shown = person.page.get_by_test_id(place).filter(has_text=words[0])
        shown.first.wait_for(timeout=60_000)
        said = person.seen(place)
        assert all(word in said for word in words), said
        person.picture(f"check_{case.replace(' ', '_')}")
        if person.state.result is not None:
            person.click("Cancel")
            person.until(lambda: person.state.result is None, "the list again")
    assert not person.faults


def taught_in_the_wizard():
    session = Session(robot="ur10e")
    for action in wizard_actions()[0]:
        session.do(action)
    return session.state.result


def typed():
    session = Session()
    session.do(ChooseMode("direct"))
    session.do(Enter((0.1, 0.0, 0.3), (0.0, 0.5, 0.0)))
    return session.do(Calculate()).result


def many_touches_with_remarks(tmp_path):
    """Sixteen touches, one of which missed, several of them alike."""
    from tests.screens.tool.mistakes import text_of

    rotations, positions = touches(16, 0.1, 1e-4, 2)
    positions[3] += np.array([0.0, 0.004, 0.0])
    path = tmp_path / "many.csv"
    path.write_text(text_of(captures(rotations, positions)), encoding="utf-8")
    return solve_file(path)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_sheet_prints_on_exactly_one_page(language, chromium, tmp_path):
    sheets = {
        "paper": solve_file(TABLE_1, method="pairwise"),
        "wizard": taught_in_the_wizard(),
        "typed": typed(),
        "many": many_touches_with_remarks(tmp_path),
    }
    pages = {
        name: report(solved, name="torch", made="2026-01-02 03:04", language=language)
        for name, solved in sheets.items()
    }
    outcome = carry_out(make_cell("irb120", "ur10e", 5), seed=5)
    pages["two robots"] = two_robots_report(
        ("ABB IRB 120", "Universal Robots UR10e"), outcome.bases, outcome.relation, language=language
    )
    page = chromium.new_page()
    for name, content in pages.items():
        page.set_content(content)
        paper = page.pdf(prefer_css_page_size=True, print_background=True)
        assert len(re.findall(rb"/Type\s*/Page\b(?!s)", paper)) == 1, name
        box = re.search(rb"/MediaBox\s*\[0 0 ([\d.]+) ([\d.]+)\]", paper)
        assert box is not None
        np.testing.assert_allclose([float(v) for v in box.groups()], [595, 842], atol=1.0)  # A4 in points
    page.close()


_WIDER = """() => [...document.querySelectorAll("body *")].filter((one) => !one.closest("table, figure, svg")
    && one.getBoundingClientRect().right > innerWidth + 1).map((one) => one.tagName + one.className)"""


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_sheet_and_report_fits_a_phone(language, chromium):
    outcome = carry_out(make_cell("irb120", "ur10e", 5), seed=5)
    pages = {
        "tool": report(solve_file(TABLE_1, method="pairwise"), language=language),
        "two robots": two_robots_report(("A", "B"), outcome.bases, outcome.relation, language=language),
        "static": as_page([static_case()], [None], command="teachframe diagnose x.csv", language=language),
        "motion": as_page([motion_case()], [None], command="teachframe diagnose x.csv", language=language),
    }
    phone = chromium.new_page(viewport={"width": 390, "height": 844})
    for name, content in pages.items():
        phone.set_content(content)
        assert phone.evaluate("document.documentElement.scrollWidth") == 390, name
        assert phone.evaluate(_WIDER) == [], name
    phone.close()
