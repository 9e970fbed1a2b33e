"""A class in the browser: a trainer sees who is stuck and helps; a trainee finds what is next."""

import re

import pytest

from app.classroom import working
from app.people import People
from app.session import Store
from app.shell.server import PendantServer
from tests.browser.conftest import SCREEN
from tests.browser.operator import SCREENSHOTS
from tests.desk import Desk, until

SECRET = "a long password"
#: Seconds after which somebody is stuck here: what is tried is not how long three minutes are.
SOON_S = 3.0
UPRIGHT = {"width": 820, "height": 1180}


@pytest.fixture
def school(tmp_path):
    store = Store(tmp_path)
    people = People(store.database)
    server = PendantServer(store, port=0, people=people, robot="ur10e", linger=30.0)
    yield server
    server.stop()


@pytest.fixture
def log_in(chromium, school):
    """A browser of somebody: log_in(person, screen=…)."""
    contexts = []

    def open_(person, screen=SCREEN, language="en"):
        context = chromium.new_context(viewport=screen, locale=language)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(60_000)  # a machine that runs other tests beside
        page.faults = []
        page.on("pageerror", lambda error: page.faults.append(str(error)))
        page.on(
            "console",
            lambda said: page.faults.append(said.text) if "Content Security Policy" in said.text else None,
        )
        page.goto(f"{school.address}/login?language={language}")
        page.locator("input[name=login]").fill(person.login)
        page.locator("input[name=secret]").fill(SECRET)
        page.locator("input[name=secret]").press("Enter")
        page.wait_for_url(re.compile(r"/$"), wait_until="commit", timeout=60_000)
        return page

    yield open_
    for context in contexts:
        context.close()


@pytest.fixture
def room(school):
    return school.hub.room


@pytest.fixture
def tim(room):
    return room.people.add("tim", "Tim Brown", "trainer", SECRET)


@pytest.fixture
def at(room, tim):
    return room.people.classes.make("Monday", tim.id)


@pytest.fixture
def ada(room, at):
    ada = room.people.add("ada", "Ada Lee", "trainee", SECRET)
    room.people.classes.enroll(at.id, ada.id)
    return ada


def shot(page, name):
    SCREENSHOTS.mkdir(exist_ok=True)
    page.screenshot(path=str(SCREENSHOTS / f"class_{name}.png"))


def no_faults(*pages):
    """viser's client tries eval once, and goes on without."""
    assert not [fault for page in pages for fault in page.faults if "unsafe-eval" not in fault]


PHONE = {"width": 390, "height": 844}


def box_of(place):
    """Left, right and width on the screen [px]."""
    box = place.bounding_box()
    return box["x"], box["x"] + box["width"], box["width"]


def fits(page):
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "wider than the screen"


@pytest.mark.browser
def test_a_trainer_sees_who_is_stuck_and_sends_a_hint(school, room, at, tim, ada, log_in, monkeypatch):
    monkeypatch.setattr(working, "STUCK", SOON_S)
    room.assignments.give(at.id, "first_tool", due=2e9)
    room.assignments.give(at.id, "bent_tip")
    hers = log_in(ada)
    hers.get_by_test_id("status-state").filter(has_text="ready").wait_for()
    desk = Desk(school.hub.find(ada.owner))
    desk.does(desk.view("choose")._start)

    his = log_in(tim)
    his.get_by_test_id("beside").click()
    his.get_by_role("link", name="Monday").click()
    row = his.get_by_test_id("seat").filter(has_text="Ada Lee")
    row.locator("[data-field=state]", has_text="stuck").wait_for(timeout=60_000)
    assert his.locator("[data-count=stuck]").inner_text() == "1"
    fits(his)
    row.get_by_label("Hint to Ada Lee").first.click()
    his.keyboard.press("Tab")  # by keyboard alone: into the field, words, Enter
    his.keyboard.type("Tilt the torch more between two touches.")
    shot(his, "stuck")
    his.keyboard.press("Enter")
    his.get_by_test_id("said").wait_for()

    hint = hers.get_by_test_id("hint")
    hint.filter(has_text="Tilt the torch more").wait_for(timeout=60_000)
    desk.context.say("info", "Something else happened.")
    hers.locator("#message", has_text="Something else").wait_for()
    assert hint.is_visible()
    fits(hers)
    shot(hers, "hint")
    hers.set_viewport_size(PHONE)
    fits(hers)
    assert box_of(hers.locator("#hint-said"))[2] > 0.8 * PHONE["width"], (
        "words beside each other, not one a line"
    )
    hers.evaluate("""() => [["state", "MEASURING"], ["enabled", "ENABLED"]].forEach(
        ([id, words]) => { document.getElementById(id).textContent = words })""")  # the widest of their words
    tops = [hers.locator(f"#{one}").bounding_box()["y"] for one in ("beside", "estop")]
    assert abs(tops[0] - tops[1]) < 12, "the emergency stop stands in the first line"
    shot(hers, "hint_phone")
    hers.set_viewport_size(SCREEN)
    his.get_by_text("hint shown").wait_for(timeout=60_000)

    his.get_by_role("link", name="Watch Ada Lee").click()
    hers.get_by_test_id("watched").wait_for(timeout=60_000)
    his.get_by_test_id("watch-state").filter(has_text="ready").wait_for(timeout=60_000)
    inner = his.frame_locator("#scene").locator("canvas[data-engine]")
    inner.wait_for(timeout=60_000)
    before = his.locator("#axes dd").first.inner_text()
    desk.place(desk.q + 0.1)
    until(lambda: his.locator("#axes dd").first.inner_text() != before, "the watched joint")
    his.wait_for_timeout(4000)  # software draws the first picture of the cell
    shot(his, "watch")
    his.set_viewport_size(UPRIGHT)
    fits(his)
    shot(his, "watch_upright")
    his.goto(f"{school.address}/class/{at.id}")
    hers.get_by_test_id("watched").wait_for(state="hidden", timeout=60_000)

    hint.get_by_role("button", name="Put away").click()
    hint.wait_for(state="hidden", timeout=60_000)
    his.get_by_text("hint read").wait_for(timeout=60_000)
    fits(his)
    shot(his, "grid_upright")
    his.set_viewport_size(PHONE)
    fits(his)
    for link in his.locator("nav a").all():
        left, right, _ = box_of(link)
        assert left >= 0 and right <= PHONE["width"], link.inner_text()
    shot(his, "grid_phone")
    (kept,) = room.hints.of(ada.owner)
    assert kept.put_away >= kept.shown > 0
    no_faults(hers, his)


@pytest.mark.browser
def test_an_assignment_appears_as_next_and_opens_at_the_pendant(school, room, at, tim, ada, log_in):
    hers = log_in(ada, screen=UPRIGHT)
    hers.get_by_test_id("beside").click()
    hers.get_by_text("No lesson yet.").wait_for()

    his = log_in(tim, language="zh")
    his.goto(f"{school.address}/exercises/new")
    his.locator("input[name=title_en]").fill("The bent torch")
    his.locator("textarea[name=task_en]").fill("Teach the torch with six touches and say what is wrong.")
    his.locator("input[name=touches]").fill("6")
    his.locator("select[name=wrong]").select_option("bent_tip")
    his.locator("input[name=bent_mm]").fill("much")
    his.get_by_role("button", name="保存").click()
    his.get_by_test_id("mistakes").filter(has_text="much").wait_for()
    fits(his)
    shot(his, "mistake")
    his.locator("input[name=bent_mm]").fill("4")
    his.get_by_role("button", name="保存").click()
    his.get_by_test_id("made").filter(has_text="The bent torch").wait_for()
    his.goto(f"{school.address}/class/{at.id}/lessons")
    his.locator("select[name=exercise]").select_option(label="The bent torch")
    his.locator("section").filter(has=his.locator("select[name=exercise]")).get_by_role("button").click()
    his.get_by_test_id("lessons").filter(has_text="The bent torch").wait_for()
    fits(his)
    shot(his, "lessons")

    hers.reload()
    ahead = hers.get_by_test_id("next")
    ahead.filter(has_text="The bent torch").wait_for()
    fits(hers)
    shot(hers, "next")
    ahead.get_by_role("button").click()
    hers.get_by_test_id("exercise-facts").wait_for(timeout=60_000)
    desk = Desk(school.hub.find(ada.owner))
    assert desk.view("choose").chosen.said("en").title == "The bent torch"
    shot(hers, "opened")
    hers.get_by_role("button", name="Begin", exact=True).click()
    until(lambda: desk.state.running is not None, "the exercise")
    assert desk.state.running.begun.exercise.startswith("made_")
    no_faults(hers, his)
