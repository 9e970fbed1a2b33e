"""What holds a session together: jogging under the enabling switch, a reload, a second tab."""

import numpy as np
import pytest

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]


def hold(person, name, milliseconds):
    """Keeps a button pressed."""
    box = person.page.get_by_role("button", name=name, exact=True).bounding_box()
    person.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    person.page.mouse.down()
    person.page.wait_for_timeout(milliseconds)
    person.page.mouse.up()
    person.at_rest()


def test_jogging_reload_and_a_second_tab(serve, sit_down):
    server = serve(robot="ur10e")
    person = sit_down(server)
    start = person.pendant.q.copy()

    person.tab("Jog")
    hold(person, "J1 +", 300)
    assert np.array_equal(person.pendant.q, start)  # not enabled
    person.page.get_by_label("Enable", exact=True).click()
    person.until(lambda: person.pendant.jogging.enabled, "the switch")
    hold(person, "J1 +", 700)
    person.until(lambda: person.pendant.q[0] > start[0], "axis 1 to move")
    person.picture("jogging")
    person.click("EMERGENCY STOP")
    person.until(lambda: person.pendant.jogging.stopped, "the emergency stop")
    stands = person.pendant.q.copy()
    hold(person, "J1 +", 300)
    assert np.array_equal(person.pendant.q, stands)
    person.click("Release the emergency stop")
    person.until(lambda: not person.pendant.jogging.stopped, "the release")

    person.click("Record", row="○ Touch 1")
    person.until(lambda: "touch1" in person.state.captures, "the first point")
    name, before = person.pendant.session.name, person.pendant

    person.page.reload()
    person.until(lambda: server.pendants and server.pendants[-1] is not before, "the page to come back")
    back = server.pendants[-1]
    person.page.get_by_text("● Touch 1", exact=True).wait_for()
    assert back.session.name == name and np.array_equal(back.q, stands)

    second = sit_down(server, context=person.page.context)
    assert second.pendant.session.name == name
    person.page.get_by_text("This session continues in another tab.").first.wait_for()
    second.picture("second_tab")
    second.click("Record", row="○ Touch 2")
    second.until(lambda: "touch2" in second.state.captures, "the second point")
