"""The whole tool wizard by following the pendant's own proposals, against a tool only the test knows."""

from dataclasses import replace

import numpy as np
import pytest

from app.calibration.exchange import read_frame
from app.geometry import Pose, angle_between
from app.units import deg, from_deg, from_mm, mm

pytestmark = pytest.mark.browser

#: The torch of the arm, bent: what has to be found.
BENT_MM = np.array([3.2, -2.1, 4.7])
TOUCH_SIGMA_MM = 0.1
TOOL_TOLERANCE_MM = 1.0  # about five standard deviations of four such touches
AXIS_TOLERANCE_DEG = 0.5


def bend(person):
    """A bent torch in the cell; the true tool."""
    usual = person.context._usual_world

    def bent_world(robot):
        world = usual(robot)
        tool = world.T_flange_tool_true
        bent = Pose.of(tool.rotation, tool.position + from_mm(BENT_MM))
        return replace(world, T_flange_tool_true=bent, touch_sigma=from_mm(TOUCH_SIGMA_MM))

    person.context._usual_world = bent_world
    person.does(
        lambda: (
            setattr(person.context.drive, "world", person.context._own_world()),
            person.context.rebuild(),
        )
    )
    return person.context.world.T_flange_tool_true


def test_a_person_finds_a_hidden_tool_by_following_the_proposals(sit_down, brisk):
    person = sit_down("jby50")
    person.context.rng = np.random.default_rng(
        20261201
    )  # one good tool in some hundred is told to be touched again
    hidden = bend(person)
    person.scene_is_there()
    person.picture("wizard_1_start")
    for number, step in enumerate(person.state.steps, 1):
        person.takes(step)
        person.page.locator(f".done[data-testid=row-{step.key}]").wait_for()
        if number == 2:
            person.picture("wizard_3_second_touch")
    touched = [c for c in person.state.ordered if "touch" in c.roles]
    assert all(person.context.world.distance(c.q) < from_mm(1.0) for c in touched)

    person.click("Calculate")
    person.until(lambda: person.state.result is not None, "a result")
    result = person.state.result.result
    assert mm(np.linalg.norm(result.tool_point - hidden.position)) < TOOL_TOLERANCE_MM
    assert deg(angle_between(result.T_flange_tool.rotation, hidden.rotation)) < AXIS_TOLERANCE_DEG
    person.reads("light", "")
    person.picture("wizard_4_result")
    person.unfold("Details")
    assert "95% region" in person.seen("region") and "drawn ×" in person.seen("region")
    for value in mm(result.tool_point):
        assert f"{value:.3f}" in person.seen("tool-point")
    for miss in mm(result.per_point):
        assert f"{miss:.3f}" in person.seen("touches")

    assert person.state.result.light.colour != "red"
    person.click("Accept")
    person.until(lambda: person.state.tool is not None, "the tool to be active")
    assert person.state.tool.T_flange_tool == result.T_flange_tool
    person.reads("status-tool", "tool 1")
    verify_by_turning(person, result, hidden)
    take_away(person, result)
    again = person.server.hub.store.state(person.context.session.name)
    assert np.array_equal(again.result.result.tool_point, result.tool_point)
    assert not person.faults


def verify_by_turning(person, result, hidden):
    """The turn about the new tool point wanders by what the tool point is off, and its trace is drawn."""
    person.moves("Verify")
    with person.holding():
        person.until(lambda: person.view("deciding").deciding.verifying._done, "the turn")
    person.reads("verified", "wandered")
    person.picture("wizard_6_verified")
    said = person.seen("verified")
    wander = from_mm(float(said.split("wandered ")[1].split(" mm")[0]))
    off = np.linalg.norm(result.tool_point - hidden.position)
    assert 0.0 < wander <= 2.0 * np.sin(from_deg(45.0) / 2) * off + from_mm(0.01)
    assert person.context.stage.trace.drawn and not person.context.stage.handle.visible


def take_away(person, result):
    """Export and report come as downloads."""
    with person.page.expect_download() as waiting:
        person.click("Export")
    frame = read_frame(waiting.value.path(), "abb_rapid")
    np.testing.assert_allclose(frame.pose.position, result.tool_point, atol=1e-9)
    with person.page.expect_download() as waiting:
        person.click("Report")
    sheet = waiting.value.path().read_text(encoding="utf-8")
    assert "Tool calibration: tool 1" in sheet and "Checked by" in sheet
