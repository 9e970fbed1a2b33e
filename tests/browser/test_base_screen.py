"""The two-robot cell, done by a person in a browser, and the miss of both tools against the hidden truth."""

import pytest

from app.units import from_mm

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

NEAR_M, SIGMAS = from_mm(1.0), 4.0


def _view(person):
    return next(view for view in person.pendant.page._views if hasattr(view, "run"))


def _run(person):
    return _view(person).run


def test_a_person_finds_where_the_second_robot_stands_and_both_tools_meet(serve, sit_down):
    person = sit_down(serve(robot="irb120"))
    person.tab("Two robots")
    person.click("Open the cell")
    person.page.get_by_test_id("base-plan").wait_for()
    person.picture("base_1_cell")
    assert person.seen("base-plan").count("○") == 9

    person.click("Run this step")
    person.until(lambda: _run(person).wizard.index == 1, "the nests to be measured")
    person.until(lambda: person.seen("base-plan").count("●") == 1, "the list to show it")
    before = person.pendant
    person.page.reload()
    person.until(lambda: any(p is not before for p in person.server.pendants), "the page to come back")
    person.pendant = next(p for p in person.server.pendants if p is not before)
    person.page.get_by_test_id("status").wait_for()
    person.close_notice()
    person.tab("Two robots")
    person.until(lambda: person.seen("base-plan").count("●") == 1, "the procedure where it was left")
    _view(person)._every.value = 20  # fewer points, so that the test is short
    person.click("Run the whole procedure")
    person.until(lambda: len(_run(person).wizard.of("1.axis1")) > 3, "half an arc")
    person.picture("base_2_measuring")
    person.page.get_by_test_id("base-light").wait_for(timeout=180_000)
    person.at_rest()
    person.picture("base_3_found")
    assert "Off by" in person.seen("base-off")

    person.click("Send both tools to one point")
    person.until(lambda: _run(person).meeting is not None, "both tools to stand")
    person.page.get_by_test_id("base-miss").wait_for()
    person.at_rest()
    person.picture("base_4_meeting")
    miss = float(person.seen("base-miss").split("by ")[1].split(" mm")[0])
    meeting = _run(person).meeting
    assert from_mm(miss) < NEAR_M and abs(from_mm(miss) - meeting.miss) < from_mm(0.001)
    assert meeting.miss < SIGMAS * meeting.predicted
    assert not person.faults

    person.click("Close the cell")
    person.page.get_by_text("Open the cell", exact=True).wait_for()
