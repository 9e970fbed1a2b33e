"""The README's pictures that need more than one person at a pendant: a class at work, the robots beside each other."""

import re
import time
from pathlib import Path

import numpy as np
import viser

from app.classroom import working
from app.kinematics import load_robot, robot_names
from app.people import People
from app.scene.arm import ArmView
from app.scene.camera import framed
from app.scene.client_page import _STYLE
from app.scene.ground import lay_floor, light_up
from app.session import Store
from app.shell.server import PendantServer
from app.training.score import ScoreCard
from tests.browser.conftest import SCREEN
from tests.desk import Desk

_SECRET = "a long password"
_LESSONS = ("first_tool", "bent_tip", "spike_moved", "something_is_wrong")
#: Trainee: points, error [mm] and seconds of the last try of each lesson that was tried, with the tries before it.
_CLASS = {
    "Ada Lee": (),
    "Ben Ortiz": ((70.0, 82.0, 0.31, 220.0), (64.0, 0.60, 260.0)),
    "Chen Wei": ((91.0, 0.14, 180.0), (88.0, 0.22, 220.0), (76.0, 0.40, 260.0)),
    "Dara Novak": ((48.0, 60.0, 66.0, 0.70, 260.0),),
    "Eli Roth": ((73.0, 0.50, 180.0),),
    "Fay Okoro": ((95.0, 0.12, 180.0), (90.0, 0.20, 220.0), (93.0, 0.16, 260.0), (58.0, 0.80, 300.0)),
}


def school(browser, data: Path, path: Path) -> None:
    """The trainer's page: who is stuck, and a hint that is written."""
    store = Store(data)
    server = PendantServer(store, port=0, people=People(store.database), robot="ur10e", linger=30.0)
    usual, working.STUCK = working.STUCK, 2.0
    try:
        room = server.hub.room
        tim = room.people.add("tim", "Tim Brown", "trainer", _SECRET)
        at = room.people.classes.make("Monday", tim.id)
        for key in _LESSONS:
            room.assignments.give(at.id, key, due=time.time() + 2.5 * 86400)
        ada = None
        for name, lessons in _CLASS.items():
            person = room.people.add(name.split()[0].lower(), name, "trainee", _SECRET)
            room.people.classes.enroll(at.id, person.id)
            ada = ada or person
            for key, (*totals, error, seconds) in zip(_LESSONS, lessons, strict=False):
                for total in totals:
                    begun = time.time() - 3600.0 + total
                    figures = {"tool_mm": error}
                    card = ScoreCard(key, 1, begun, seconds, total, (), figures, {}, "", 0, "", 0)
                    room.records.add(person.id, "", card)
        hers = _logged_in(browser, server, "ada")
        hers.get_by_test_id("status-state").filter(has_text="ready").wait_for()
        desk = Desk(server.hub.find(ada.owner))
        desk.does(desk.view("choose")._start)
        his = _logged_in(browser, server, "tim")
        his.goto(f"{server.address}/class/{at.id}")
        row = his.get_by_test_id("seat").filter(has_text="Ada Lee")
        row.locator("[data-field=state]", has_text="stuck").wait_for()
        row.get_by_label("Hint to Ada Lee").first.click()
        his.keyboard.press("Tab")
        his.keyboard.type("Tilt the torch more.")
        his.screenshot(path=str(path))
        for page in (hers, his):
            page.context.close()
    finally:
        working.STUCK = usual
        server.stop()


def _logged_in(browser, server, login):
    page = browser.new_context(viewport=SCREEN, locale="en").new_page()
    page.set_default_timeout(60_000)
    page.goto(f"{server.address}/login?language=en")
    page.locator("input[name=login]").fill(login)
    page.locator("input[name=secret]").fill(_SECRET)
    page.locator("input[name=secret]").press("Enter")
    page.wait_for_url(re.compile(r"/$"), wait_until="commit")
    return page


_GAP = 0.12  # between two arms, in metres
_SHEET = {"width": 1400, "height": 600}
_FAR = 0.12  # vertical field of view [rad]: from far off, so that all stand there to one scale


def robots(browser, path: Path) -> None:
    """All shipped arms in a row, to scale, each with its name."""
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        scene = server.scene
        scene.world_axes.visible = False
        light_up(scene)
        lay_floor(scene, dark=False)
        at, seen = -3.1, []
        for name in sorted(robot_names(), key=lambda name: -load_robot(name).reach):
            robot = load_robot(name)
            half = 0.2 + 0.1 * robot.reach
            at += half
            ArmView(scene, robot, root=f"/{name}")._root.position = (0.0, at, 0.0)
            place = (0.45 + 0.2 * robot.reach, at, 0.0)
            scene.add_label(f"/name_{name}", robot.title, position=place, anchor="top-center")
            places = robot.chain.frames(robot.home[None]).joint_positions.reshape(-1, 3)
            seen += [np.array([0.0, at, 0.0]) + places, [place]]
            at += half + _GAP
        shape = _SHEET["width"] / _SHEET["height"]
        eye, centre = framed(np.vstack(seen), np.array([1.0, -0.3, 0.3]), shape, 0.84, _FAR)
        camera = server.initial_camera
        camera.position, camera.look_at, camera.fov = tuple(eye), tuple(centre), _FAR
        page = browser.new_context(viewport=_SHEET).new_page()
        page.goto(f"http://127.0.0.1:{server.get_port()}")
        page.add_style_tag(content=_STYLE)
        page.wait_for_timeout(12_000)
        page.screenshot(path=str(path))
        page.context.close()
    finally:
        server.stop()
