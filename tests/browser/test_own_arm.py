"""An arm of one's own in the browser: dropped on the page, drawn, jogged, taught, and there again after a reload."""

import numpy as np
import pytest

from app.units import mm
from tests.own_arm import TITLE, zipped

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

TOOL_TOLERANCE_MM = 1.0


def test_a_dropped_arm_is_jogged_taught_and_solved_with_and_comes_back(sit_down, brisk, tmp_path):
    person = sit_down("irb120")
    person.scene_is_there()
    person.screen("cell")
    person.unfold("An arm of your own")
    drop = person.page.get_by_label("Drop a description", exact=True).first
    drop.set_input_files(zipped(tmp_path))
    person.until(lambda: person.state.robot.startswith(f"{TITLE}~"), "the arm")
    person.reads("status-robot", TITLE)
    person.at_rest()
    person.picture("own_arm")

    before = person.q
    person.page.keyboard.down("Space")
    person.page.keyboard.down("q")
    person.until(lambda: np.abs(person.q - before).max() > 0.01, "the jog")
    person.page.keyboard.up("q")
    person.page.keyboard.up("Space")

    person.screen("tool")
    for step in person.state.steps:
        person.takes(step)
    person.click("Calculate")
    person.until(lambda: person.state.result is not None, "the result")
    found, true = person.state.result.result.tool_point, person.context.world.T_flange_tool_true.position
    assert mm(np.linalg.norm(found - true)) < TOOL_TOLERANCE_MM

    name, points = person.state.robot, len(person.state.captures)
    person.page.reload()
    person.come_back()
    assert person.state.robot == name and len(person.state.captures) == points
    person.reads("status-robot", TITLE)
    assert not person.faults
