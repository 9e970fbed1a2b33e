"""What a person does at the pendant: looks, clicks, types, drags. Waits for the server's state, never for time."""

import time
from pathlib import Path

import numpy as np

SCREENSHOTS = Path(__file__).parent / "screenshots"
PATIENCE_S = 40.0  # a slow machine may take this long for what takes a blink elsewhere
BETWEEN_ACTIONS_MS = 80  # the page gathers what happens within 50 ms

#: Where a point in base is on the page: viser turns z up into three.js' y up.
_PROJECT = """([x, y, z]) => {
    const camera = window.__viserMutable.camera;
    const box = document.querySelector('canvas').getBoundingClientRect();
    const point = camera.position.clone().set(-y, z, -x).project(camera);
    return [box.x + (point.x + 1) / 2 * box.width, box.y + (1 - point.y) / 2 * box.height];
}"""


class Operator:
    """One person at one tab."""

    def __init__(self, page, server):
        self.page, self.server = page, server
        self.faults = []
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        before = set(map(id, server.pendants))
        page.goto(server.address)
        self.until(lambda: any(id(p) not in before for p in server.pendants), "the pendant to know this tab")
        self.pendant = next(p for p in server.pendants if id(p) not in before)
        page.get_by_test_id("status").wait_for(timeout=PATIENCE_S * 1e3)
        self.close_notice()

    @property
    def state(self):
        return self.pendant.session.state

    def until(self, true, what):
        """Waits until something is so on the server."""
        end = time.monotonic() + PATIENCE_S
        while not true():
            assert time.monotonic() < end, f"waited {PATIENCE_S:g} s for {what}; {self.last_words()}"
            self.page.wait_for_timeout(20)

    def last_words(self):
        """Where the arm stands, and what the pendant said last."""
        pendant = getattr(self, "pendant", None)
        return "" if pendant is None else f"arm at {np.degrees(pendant.q).round(2)}, {pendant.log[-3:]}"

    def at_rest(self):
        """Waits until the arm stands and everything done is done."""
        self.until(lambda: self.pendant.worker.idle(0.05), "the arm to stand")

    def close_notice(self):
        """Closes what the page says about this machine having no graphics card, where it says so by now."""
        self.page.evaluate(
            "document.querySelectorAll('.mantine-Notification-closeButton').forEach(b => b.click())"
        )

    def click(self, name, row=None):
        """Presses a button, in the row of this label where one is named."""
        place = self.page if row is None else self.row(row)
        place.get_by_role("button", name=name, exact=True).click()
        self.page.wait_for_timeout(BETWEEN_ACTIONS_MS)

    def row(self, label):
        text = self.page.get_by_text(label, exact=True)
        return self.page.locator(".mantine-Flex-root").filter(has=text).last

    def tab(self, name):
        self.page.get_by_role("tab", name=name, exact=True).click()
        self.page.wait_for_timeout(BETWEEN_ACTIONS_MS)

    def shown_angle(self, label):
        """What the number field beside a slider says."""
        return float(self.row(label).locator("input[inputmode=decimal]").input_value() or "nan")

    def type_angle(self, label, degrees):
        """Types into the number field beside a slider."""
        field = self.row(label).locator("input[inputmode=decimal]")
        field.click(click_count=3)
        self.page.keyboard.type(f"{degrees:g}")
        field.press("Enter")
        self.page.wait_for_timeout(BETWEEN_ACTIONS_MS)

    def seen(self, testid):
        """What a place on the page says."""
        return self.page.get_by_test_id(testid).inner_text()

    def on_page(self, point):
        """Where a point in base [m] is on the page [px]."""
        return np.array(self.page.evaluate(_PROJECT, [float(v) for v in point]))

    def drag(self, start, direction, pixels, moves=30):
        """Presses at `start` [px], moves along `direction` and lets go."""
        mouse = self.page.mouse
        direction = direction / np.linalg.norm(direction)
        mouse.move(*start)
        self.page.wait_for_timeout(200)
        mouse.down()
        for k in range(1, moves + 1):
            mouse.move(*(start + direction * pixels * k / moves))
            self.page.wait_for_timeout(12)
        mouse.up()
        self.page.wait_for_timeout(BETWEEN_ACTIONS_MS)

    def picture(self, name):
        """Leaves a screenshot for people to look at."""
        SCREENSHOTS.mkdir(exist_ok=True)
        self.close_notice()
        self.page.wait_for_timeout(500)
        self.page.screenshot(path=str(SCREENSHOTS / f"{name}.png"))
