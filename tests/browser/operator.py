"""What a person does at the pendant: looks, clicks, types, holds. Waits for the server's state, never for time."""

import contextlib
import time
from pathlib import Path

import numpy as np

from app.figures import NO_BREAK
from app.session.actions import ChooseRobot
from app.session.motion.drive import MOTIONS
from app.session.owners import owner_of
from app.shell.security import COOKIE

SCREENSHOTS = Path(__file__).parent / "screenshots"
PATIENCE_S = 60.0  # a slow machine may take this long for what takes a blink elsewhere

#: Where a point in base is on the page: viser turns z up into three.js' y up.
_PROJECT = """([x, y, z]) => {
    const frame = document.getElementById('scene'), inner = frame.contentWindow;
    const camera = inner.__viserMutable.camera;
    const box = inner.document.querySelector('canvas').getBoundingClientRect(), at = frame.getBoundingClientRect();
    const point = camera.position.clone().set(-y, z, -x).project(camera);
    return [at.x + box.x + (point.x + 1) / 2 * box.width, at.y + box.y + (1 - point.y) / 2 * box.height];
}"""

#: What the keys say that stand out on the page.
_LOUD = """() => [...document.querySelectorAll("button.main:not(:disabled)")]
    .filter((one) => one.checkVisibility()).map((one) => one.textContent)"""


class Operator:
    """One person at one page.

    Args:
        robot: the arm of a new session; None leaves it.
    """

    def __init__(self, page, server, robot=None):
        self.page, self.server = page, server
        self.faults, self._holding, self._pressing = [], False, False
        page.on("pageerror", self._fault)
        page.goto(server.address)
        secret = next(c["value"] for c in page.context.cookies() if c["name"] == COOKIE)
        self.live = server.hub.find(owner_of(secret))
        self._secret = secret
        self.until(lambda: bool(self.context.views), "the screens")
        page.get_by_test_id("status-state").filter(has_text="").first.wait_for()
        if robot is not None and self.state.robot != robot:
            self.does(lambda: self.context.do(ChooseRobot(robot)))
        self.context.drive.override = 1.0

    def _fault(self, error):
        if "unsafe-eval" not in str(error):  # viser's client tries it once, and goes on without
            self.faults.append(str(error))

    @property
    def context(self):
        return self.live.context

    @property
    def state(self):
        return self.context.session.state

    @property
    def q(self):
        return self.context.q.copy()

    def view(self, name):
        """A screen's view by something it has."""
        return next((view for view in self.context.views if hasattr(view, name)), None)

    def come_back(self):
        """After a reload, or when another session was opened."""
        self.until(lambda: self.server.hub.find(owner_of(self._secret)) is not None, "the session")
        self.live = self.server.hub.find(owner_of(self._secret))
        self.until(lambda: bool(self.context.views), "the screens")

    def does(self, job):
        """A job on the worker, done when this returns."""
        self.context.post(job)
        self.until(self._idle, "the worker")

    def _idle(self):
        worker = self.context.worker
        with worker._wake:
            return not (worker._queue or worker._busy)

    def until(self, true, what):
        """Waits until something is so on the server; a switch that tripped on the way is let go and pressed anew."""
        end = time.monotonic() + PATIENCE_S
        while not true():
            assert time.monotonic() < end, f"waited {PATIENCE_S:g} s for {what}; {self.last_words()}"
            if self._holding and not self.context.drive.live:
                self._anew()
            self.page.wait_for_timeout(20)

    def _anew(self):
        """After a trip everything has to be let go; and a press that has moved the arm once moves it no more."""
        if self._pressing:
            self.page.mouse.up()
        self.page.keyboard.up("Space")
        self.page.wait_for_timeout(60)
        self.page.keyboard.down("Space")
        self.page.wait_for_timeout(60)
        if self._pressing:
            self.page.mouse.down()

    @contextlib.contextmanager
    def pressing(self):
        """The mouse is held where it is."""
        self.page.mouse.down()
        self._pressing = True
        try:
            yield
        finally:
            self._pressing = False
            self.page.mouse.up()

    def last_words(self):
        """Where the arm stands, and what the pendant said last."""
        return (
            f"arm at {np.degrees(self.q).round(2)}, {self.context.log[-3:]}" if hasattr(self, "live") else ""
        )

    @contextlib.contextmanager
    def holding(self):
        """The switch is held by the space key."""
        self.page.keyboard.down("Space")
        self._holding = True
        try:
            yield
        finally:
            self._holding = False
            self.page.keyboard.up("Space")

    def at_rest(self):
        """Waits until nothing moves and nothing waits to move."""
        running = self.context.worker.running
        self.until(lambda: not any(map(running, MOTIONS)) and self._idle(), "the arm to stand")

    def takes(self, step):
        """A step of the wizard as the pendant proposes it: to the ghost and the spike, or the stroke; recorded."""
        if "touch" in step.roles:
            self.until(lambda: self.view("deciding")._next_touch.proposal is not None, "the proposal")
            self.moves("Go to the ghost")
            self.moves("Touch the spike")
        else:
            self.moves(f"Move 150 mm along tool +{step.role.upper()}")
        self.click(f"Record {step.title}")
        # Until the worker is through, the ghost of the touch before still counts as the proposal.
        self.until(lambda: step.key in self.state.captures and self._idle(), f"{step.title} recorded")

    def moves(self, name):
        """Presses a button and holds the switch until the arm has gone there."""
        self.click(name)
        self.until(lambda: any(map(self.context.worker.running, MOTIONS)), f"{name} to begin")
        with self.holding():
            self.at_rest()

    def click(self, name, inside=None):
        """Presses a button that is seen."""
        place = self.page if inside is None else inside
        place.get_by_role("button", name=name, exact=True).locator("visible=true").first.click()
        self.page.wait_for_timeout(30)

    def row(self, key):
        """A row of the wizard's list."""
        return self.page.locator(f"[data-testid=row-{key}]")

    def screen(self, key):
        self.page.locator(f"#tabs button[data-key={key}]").click()

    def choose(self, label, option):
        self.page.get_by_label(label, exact=True).locator("visible=true").first.select_option(label=option)

    def unfold(self, title):
        """Opens a part that is folded."""
        line = self.page.locator("summary").filter(has_text=title).locator("visible=true").first
        if not line.evaluate("line => line.parentElement.open"):
            line.click()

    def seen(self, testid):
        """What a place on the page says; a space that does not break is a space."""
        return (
            self.page.get_by_test_id(testid).locator("visible=true").first.inner_text().replace(NO_BREAK, " ")
        )

    def reads(self, testid, words):
        """Waits until a place on the page says so."""
        self.page.get_by_test_id(testid).locator("visible=true").filter(has_text=words).first.wait_for(
            timeout=PATIENCE_S * 1e3
        )

    def on_page(self, point):
        """Where a point in base [m] is on the page [px]."""
        return np.array(self.page.evaluate(_PROJECT, [float(v) for v in point]))

    def scene_is_there(self):
        """Waits until the scene has drawn."""
        inner = "document.getElementById('scene').contentWindow"
        self.until(
            lambda: self.page.evaluate(
                f"Boolean({inner}.__viserMutable?.camera && {inner}.document.querySelector('canvas'))"
            ),
            "the scene",
        )
        self.until(lambda: self.context.stage.eyes.known, "the scene's page to say how large it is")

    def picture(self, name):
        """Leaves a screenshot for people to look at, on which one key at most stands out."""
        SCREENSHOTS.mkdir(exist_ok=True)
        self.page.wait_for_timeout(600)
        assert len(loud := self.page.evaluate(_LOUD)) <= 1, f"more than one key is the next: {loud}"
        self.page.screenshot(path=str(SCREENSHOTS / f"{name}.png"))
