"""The paper's table at the press of a button: the arm goes through its points, then the result stands there."""

import numpy as np
import pytest

from app.calibration.solving import solve_file
from app.screens._tool.paper import PAPER
from app.units import mm

pytestmark = pytest.mark.browser


def test_the_papers_table_is_played_and_explained(sit_down, brisk):
    person = sit_down()
    other = person.q
    person.unfold("Examples and files")
    person.click("Load the paper's table")
    person.until(lambda: person.state.robot == "jby50", "the paper's arm")
    person.until(lambda: len(person.state.captures) == 6, "six points")
    with person.holding():
        person.until(lambda: person.state.result is not None, "the result")
        person.at_rest()
    # The verdict is read first: the list was scrolled down to the examples, the result stands at the top.
    person.until(
        lambda: person.page.evaluate("document.getElementById('work').scrollTop === 0"),
        "the verdict to be on top",
    )
    person.unfold("Details")
    assert len(person.q) == len(other)

    expected = solve_file(PAPER, method="pairwise", orientation="zx")
    result = person.state.result.result
    assert np.array_equal(result.tool_point, expected.result.tool_point)
    assert result.delta == expected.result.delta
    for value in mm(result.tool_point):
        assert f"{value:.3f}" in person.seen("tool-point")
    remarks = person.seen("notes")
    assert "Rounding: the written digits alone scatter the tool point" in remarks
    assert "Gap to the printed tool" in remarks
    assert person.seen("light")
    person.picture("paper_light")

    person.page.locator("#theme").click()
    person.page.locator("html[data-theme=dark]").wait_for()
    person.picture("paper_dark")
    assert not person.faults
