"""A small window: the status line says all of it, near views keep the tip in their middle, a key is held and let go."""

import numpy as np
import pytest

from app.session.actions import Accept, Calculate
from app.units import from_mm
from tests.session.wizard import wizard_actions

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

SMALL = {"width": 1024, "height": 768}
LONG_NAME = "welding torch of cell 4, bent neck, after the collision of Tuesday"
MIDDLE_PX = 12.0

#: Of each entry of the status line: whether all of it lies in the line, and nothing lies over it.
_HIDDEN = """() => {
    const line = document.querySelector('[data-testid=status]').getBoundingClientRect();
    return [...document.querySelectorAll('[data-testid^=status-]')].filter(entry => {
        const box = entry.getBoundingClientRect();
        const at = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
        const inside = box.left >= line.left && box.right <= line.right && box.bottom <= line.bottom;
        return !(inside && box.width > 0 && entry.scrollWidth <= box.width + 1 && entry.contains(at));
    }).map(entry => entry.dataset.testid);
}"""


def off_middle(person):
    """How far the tip is from the middle of the canvas [px]."""
    box = person.page.locator("canvas").first.bounding_box()
    middle = np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])
    return float(np.linalg.norm(person.on_page(person.pendant.hand().position) - middle))


def aside(person, angle):
    """Turns the arm about its first axis [rad]; how far its tip moved [m]."""
    pendant = person.pendant
    q, before = pendant.q.copy(), pendant.hand().position
    q[0] += angle
    pendant.post(lambda: pendant.place(q))
    person.at_rest()
    return float(np.linalg.norm(pendant.hand().position - before))


def test_a_small_window_hides_nothing_and_near_views_follow_the_tip(serve, sit_down):
    person = sit_down(serve(robot="ur10e"), screen=SMALL)
    pendant = person.pendant
    for action in wizard_actions("ur10e", world=pendant.world)[0]:
        pendant.post(lambda action=action: pendant.session.do(action))
    pendant.post(lambda: pendant.do(Calculate()))
    pendant.post(lambda: pendant.do(Accept(LONG_NAME)))
    person.at_rest()
    person.until(lambda: LONG_NAME in person.seen("status-tool"), "the tool's name")
    # While a page is still being laid out, or a message of viser's passes over it, the line may be covered.
    person.until(lambda: person.page.evaluate(_HIDDEN) == [], "nothing of the status line to be hidden")
    assert pendant.model.title in person.seen("status-robot")
    person.picture("small_window")

    for view in ("Side", "Front"):
        person.click(view)
        person.until(lambda: off_middle(person) < MIDDLE_PX, f"the tip in the middle of {view}")
        moved = aside(person, 0.1)
        assert moved > from_mm(50.0)
        person.until(lambda: off_middle(person) < MIDDLE_PX, f"{view} to follow")
    person.click("Cell")
    person.until(lambda: pendant.stage._followed is None, "the whole cell")
    person.page.wait_for_timeout(300)
    before = person.on_page([0.0, 0.0, 0.0])
    aside(person, -0.2)
    person.page.wait_for_timeout(300)
    assert np.allclose(person.on_page([0.0, 0.0, 0.0]), before)  # the whole cell stays where it is

    pendant.jogging.enabled = True
    person.page.mouse.click(480, 700)  # the keys belong to the page, not to a field
    person.page.keyboard.press("1")
    start = pendant.q[0]
    for _ in range(12):
        person.page.keyboard.down("m")  # pressed again while it is down: what the browser calls a repeat
        person.page.wait_for_timeout(33)
    person.page.keyboard.up("m")
    person.until(lambda: not pendant.worker.running("jog"), "the arm to stand")
    stands = pendant.q.copy()
    assert stands[0] < start
    person.page.wait_for_timeout(400)
    assert np.array_equal(pendant.q, stands)
    assert not person.faults
