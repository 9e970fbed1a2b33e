"""Makes the README's pictures from the running program: `python -m tests.browser.picture [FOLDER]`."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

from app.session import Store
from app.session.motion import enabling, pace
from app.shell.server import PendantServer
from tests.browser.conftest import BRISK, FLAGS, PATIENT_S, SCREEN, chromium_path
from tests.browser.more_pictures import robots, school
from tests.browser.operator import Operator


def first_tool(person: Operator) -> None:
    """A tool found by following the pendant's proposals."""
    person.context.rng = np.random.default_rng(3)
    for step in person.state.steps:
        person.takes(step)
    person.click("Calculate")
    person.until(lambda: person.state.result is not None, "the result")


def exercise(person: Operator) -> None:
    """An exercise while it is done: the task above the work."""
    person.screen("training")
    person.click("Begin")
    person.until(lambda: person.state.running is not None, "the exercise")
    person.page.get_by_role("button", name="Record Touch 1", exact=True).wait_for()


def two_robots(person: Operator) -> None:
    """Two robots around a tracker, measured, at one point."""
    person.screen("base")
    person.click("Open the cell")
    person.reads("base-plan", "Robot 1")
    person.click("Run the whole procedure")
    view = person.view("run")
    assert view is not None
    with person.holding():
        person.until(lambda: view.run.relation is not None, "the relation")
        person.at_rest()


#: Draws the hidden fault of the picture, play in a joint: the same one whenever the picture is made again.
_FAULT = 4


def compare(person: Operator) -> None:
    """A recording with a fault in it, found."""
    person.context.rng = np.random.default_rng(_FAULT)
    person.screen("compare")
    person.click("Record with a hidden fault")
    person.page.get_by_role("button", name="Find what is missing", exact=True).wait_for(timeout=60_000)
    person.click("Find what is missing")
    person.page.get_by_test_id("compare-verdict").wait_for(timeout=120_000)


#: An arm of many small faults, as the command line makes and diagnoses it.
_FAULTS = (
    "joint_zero:joint=3",
    "joint_zero:joint=5",
    "joint_compliance:joint=2",
    "gear_eccentricity:joint=2",
)
_SHEET = {"width": 860, "height": 1000}


def report(browser, path: Path) -> None:
    """The first page of a report."""
    with tempfile.TemporaryDirectory() as folder:
        teachframe = [sys.executable, "-m", "app"]
        wrong = [part for fault in _FAULTS for part in ("--effect", fault)]
        made = [
            "--robot",
            "r2000ic_165f",
            "--kind",
            "tracker",
            "--samples",
            "250",
            "--seed",
            "8",
            "--clutter-mm",
            "0.1",
        ]
        subprocess.run([*teachframe, "simulate", f"{folder}/sim.csv", *made, *wrong], check=True)
        subprocess.run(
            [*teachframe, "diagnose", f"{folder}/sim.csv", "--report", f"{folder}/sim.html"], check=True
        )
        page = browser.new_context(viewport=_SHEET).new_page()
        page.goto(f"file://{folder}/sim.html")
        page.screenshot(path=str(path))
        page.context.close()


PICTURES = {"pendant": first_tool, "training": exercise, "two_robots": two_robots, "compare": compare}
#: Those that are no pendant's page; each gets a browser, a folder for data and the picture's path.
SHEETS = {
    "report": lambda browser, _, path: report(browser, path),
    "class": school,
    "robots": lambda browser, _, path: robots(browser, path),
}
ROBOTS = {"pendant": "jby50", "training": "jby50", "two_robots": "irb120", "compare": "ur10e"}


def take(folder: Path, names: list[str]) -> None:
    """The pictures of these names."""
    enabling.SILENCE, pace.TIP_SPEED, pace.TURN_SPEED = (
        PATIENT_S,
        BRISK * pace.TIP_SPEED,
        BRISK * pace.TURN_SPEED,
    )
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as data, sync_playwright() as playwright:
        server = PendantServer(Store(Path(data)), port=0)
        browser = playwright.chromium.launch(executable_path=chromium_path(), args=FLAGS)
        try:
            for name in names:
                if name in SHEETS:
                    SHEETS[name](browser, Path(data) / "school", folder / f"{name}.png")
                    make_light(folder / f"{name}.png")
                    continue
                context = browser.new_context(viewport=SCREEN)
                person = Operator(context.new_page(), server, ROBOTS[name])
                person.scene_is_there()
                PICTURES[name](person)
                # At full resolution, which software draws slowly: nobody holds anything any more.
                scene = person.page.locator("#scene")
                scene.evaluate("frame => { frame.src = '/scene/'; }")
                person.page.wait_for_timeout(9000)
                person.page.screenshot(path=str(folder / f"{name}.png"))
                make_light(folder / f"{name}.png")
                context.close()
        finally:
            browser.close()
            server.stop()


def make_light(path: Path) -> None:
    """Drops the two lowest bits of every colour: nobody sees them, and they are a quarter of the file."""
    picture = Image.open(path).convert("RGB")
    picture.point([min(255, (v + 2) // 4 * 4) for v in range(256)] * 3).save(path, optimize=True)


if __name__ == "__main__":
    take(Path(sys.argv[1] if len(sys.argv) > 1 else "static/pictures"), sys.argv[2:] or [*PICTURES, *SHEETS])
