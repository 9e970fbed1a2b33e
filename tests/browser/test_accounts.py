"""Coming in, the account and going, as a person does it: at a desk, by keyboard alone, on a phone, in Chinese."""

from itertools import pairwise

import pytest

from app.people import People
from app.session import Store
from app.shell.server import PendantServer
from app.texts import TEXTS
from tests.browser.conftest import SCREEN
from tests.browser.operator import SCREENSHOTS
from tests.people.conftest import PASSWORD, PIN

pytestmark = pytest.mark.browser

PHONE = {"width": 390, "height": 844}
LONG_MS = 60_000  # a machine that draws by software and runs other tests beside


@pytest.fixture
def school(tmp_path):
    store = Store(tmp_path)
    people = People(store.database)
    trainer = people.add("tom", "Tom B.", "trainer", PASSWORD)
    people.add("ada", "Ada L.", "administrator", PASSWORD)
    server = PendantServer(store, port=0, people=people, linger=2.0)
    server.people, server.at = people, people.classes.make("Monday", trainer.id)
    yield server
    server.stop()


@pytest.fixture
def pictures():
    """Leaves a screenshot for people to look at."""

    def take(page, name):
        SCREENSHOTS.mkdir(exist_ok=True)
        page.screenshot(path=str(SCREENSHOTS / f"{name}.png"))

    return take


@pytest.fixture
def person(chromium, school):
    """Opens the server's address in a browser of its own."""
    contexts = []

    def open_(screen=SCREEN, **named):
        context = chromium.new_context(viewport=screen, **named)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(LONG_MS)
        page.faults = []
        page.on("pageerror", lambda error: "unsafe-eval" in str(error) or page.faults.append(str(error)))
        page.on("console", lambda said: "Content Security" in said.text and page.faults.append(said.text))
        page.goto(school.address)
        return page

    yield open_
    for context in contexts:
        context.close()


def fits(page):
    """Nothing is wider than the screen, and every key is as high as a finger."""
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    boxes = [one.bounding_box() for one in page.locator("main > *").all()]
    for above, below in pairwise(boxes):
        assert above["y"] + above["height"] <= below["y"], "nothing stands on something else"
    for key in page.locator("button:visible, input:visible, .languages a:visible").all():
        assert key.bounding_box()["height"] >= 44


def test_a_trainee_joins_works_and_leaves_on_a_phone(person, school, pictures):
    page = person(PHONE, has_touch=True, locale="en-GB")
    page.wait_for_url("**/login")
    fits(page)
    pictures(page, "account_login_phone")
    page.get_by_role("link", name="I have a class code").click()
    page.get_by_label("Class code").fill(school.at.code.upper())
    page.get_by_label("Your name").fill("Li Wei")
    page.get_by_label("PIN").fill("1234")
    page.get_by_role("button", name="Join").click()
    assert "six" in page.get_by_text("choose a PIN").inner_text()
    page.get_by_test_id("refused").wait_for()
    assert (
        page.get_by_label("Your name").input_value() == "Li Wei"
        and page.get_by_label("PIN").input_value() == ""
    )
    fits(page)
    pictures(page, "account_join_refused_phone")
    page.get_by_label("PIN").fill(PIN)
    page.get_by_role("button", name="Join").click()
    page.get_by_test_id("status-state").filter(has_text="ready").wait_for()
    pictures(page, "account_pendant_phone")
    page.get_by_test_id("account").click()
    page.wait_for_url("**/account")
    assert page.get_by_test_id("who").inner_text() == "Li Wei" and "Monday · Tom B." in page.content()
    fits(page)
    pictures(page, "account_phone")
    page.get_by_role("button", name="Log out").click()
    page.wait_for_url("**/login")
    page.go_back()
    page.wait_for_url("**/login")
    assert not page.faults


def test_a_trainer_logs_in_by_keyboard_alone_and_in_chinese(person, school, pictures):
    page = person(locale="zh-CN")
    page.get_by_role("heading", name="登录").wait_for()
    pictures(page, "account_login_chinese")
    page.keyboard.type("tom")
    page.keyboard.press("Tab")
    page.keyboard.type(PASSWORD)
    page.keyboard.press("Enter")
    page.get_by_test_id("status-state").filter(has_text=TEXTS.text("status.standing", "zh")).wait_for()
    page.goto(f"{school.address}/account")
    assert school.at.code in page.content() and "教员" in page.content()
    pictures(page, "account_chinese")
    for _ in range(4):
        page.keyboard.press("Tab")
    assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid", "focus is seen"
    assert not page.faults


def test_a_page_whose_person_was_shut_out_shows_the_way_in(person, school, monkeypatch):
    monkeypatch.setattr("app.shell.words._STILL", 0.2)
    li = school.people.join(school.at.code, "Li Wei", PIN, "here")
    page = person(locale="en-GB")
    page.get_by_label("Log-in name").fill(li.login)
    page.get_by_label("Password or PIN").fill(PIN)
    page.get_by_role("button", name="Log in", exact=True).click()
    page.get_by_test_id("status-state").filter(has_text="ready").wait_for()
    school.people.change(li.id, disabled=True)
    page.wait_for_url("**/login?ended=1")
    page.get_by_test_id("ended").wait_for()  # and is told why he stands there
    assert not page.faults
