"""The frame that nothing hides: hold and release by pointer, key and touch, the stop from everywhere, typed values."""

import time
from itertools import pairwise

import numpy as np
import pytest

from app.session.motion import enabling

TRIES = 30

pytestmark = pytest.mark.browser

#: Whatever lies where the stop is; and every control of the frame whose middle is covered or cut off.
#: The links that somebody with an account has in the top line.
_WITH_ACCOUNT = """() => {
    for (const [key, words] of [["beside", "Lessons"], ["person", "A"]]) {
        const link = document.getElementById(key);
        link.hidden = false;
        link.textContent = words;
    }
}"""
#: Facts of the top line that touch another, or of which, cut off, less than five letters are left.
_ON_EACH_OTHER = """() => {
    const boxes = [...document.querySelectorAll("#facts div")].filter((one) => one.checkVisibility())
        .map((one) => [one.textContent.trim(), one.getBoundingClientRect(),
            [...one.children].some((words) => words.scrollWidth > words.clientWidth)]);
    return boxes.filter(([, box, cut], k) => (cut && box.width < 36) || (k && box.left < boxes[k - 1][1].right))
        .map(([words]) => words);
}"""
_STOP = """() => { const box = document.getElementById('estop').getBoundingClientRect();
    return document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2)?.id; }"""
_HIDDEN = """() => [...document.querySelectorAll('#bar button, #bar dd, #enable')].filter(part => {
    const box = part.getBoundingClientRect();
    if (!part.offsetParent || !box.width) return false;
    const at = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
    return box.right > innerWidth + 1 || !(part.contains(at) || at?.contains(part));
}).map(part => part.id || part.className)"""
#: Buttons that a finger would miss.
_SMALL = """() => [...document.querySelectorAll('button, select')]
    .filter(part => part.offsetParent && part.getBoundingClientRect().height < 43)
    .map(part => part.textContent || part.id)"""


def jog_button(person, name):
    return person.page.get_by_role("button", name=name, exact=True)


def middle(locator):
    box = locator.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_a_button_moves_while_both_are_held_and_stops_with_either(sit_down, monkeypatch):
    monkeypatch.setattr(enabling, "SILENCE", 3.0)
    person = sit_down()
    page, start = person.page, person.q
    jog_button(person, "J1 plus").hover()  # once it stands still: the page may still be coming
    page.mouse.down()
    page.wait_for_timeout(300)
    assert np.array_equal(person.q, start)  # the switch is not held
    person.reads("message-warning", "enabling switch")
    page.mouse.up()
    with person.holding():
        with person.pressing():
            person.until(lambda: person.q[0] > start[0] + 0.02, "axis 1 to move")
            person.picture("jogging")
        person.until(lambda: person.context.drive.how == "standing", "the arm to stand")
    with person.pressing():  # the button first, the switch after it
        with person.holding():
            person.until(lambda: person.context.worker.running("jog"), "axis 1 to move again")
        person.until(lambda: not person.context.worker.running("jog"), "the arm to stand without the switch")
    assert not np.delete(person.q - start, 0).any() and not person.faults


def test_keys_choose_hold_release_and_stop_even_while_a_field_has_the_focus(sit_down, monkeypatch):
    monkeypatch.setattr(enabling, "SILENCE", 3.0)
    person = sit_down()
    page, start = person.page, person.q
    page.keyboard.press("3")
    with person.holding():
        page.keyboard.down("q")
        person.until(lambda: person.q[2] < start[2] - 0.02, "axis 3 to move")
        page.keyboard.up("q")
        person.until(lambda: person.context.drive.how == "standing", "the arm to stand")
    person.screen("training")
    field = page.get_by_label("Your name", exact=True)
    field.fill("")
    field.type("a b")
    assert field.input_value() == "a b" and not person.context.drive.live
    page.keyboard.press("Escape")
    person.until(lambda: person.context.drive.enabling.stopped, "the stop")
    person.reads("status-state", "E-STOP")
    person.reads("message-error", "EMERGENCY STOP")
    stands = person.q
    page.get_by_test_id("estop").click()
    person.until(lambda: not person.context.drive.enabling.stopped, "the release")
    assert np.array_equal(person.q, stands) and not person.faults


def test_a_button_that_is_replaced_under_the_finger_is_let_go(sit_down, monkeypatch):
    """Another frame makes other buttons: the one that was held stayed held for ever, and the arm went on."""
    monkeypatch.setattr(enabling, "SILENCE", 3.0)
    person = sit_down()
    page, start = person.page, person.q
    jog_button(person, "J1 plus").hover()  # once it stands still: the page may still be coming
    with person.holding():
        page.mouse.down()
        person.until(lambda: person.q[0] > start[0] + 0.02, "axis 1 to move")
        page.evaluate("document.querySelector('#frames [data-key=base]').click()")
        jog_button(person, "X plus").wait_for()
        page.mouse.move(*middle(page.locator("#bar")))
        page.mouse.up()
        page.wait_for_timeout(400)
        stood = person.q
        page.wait_for_timeout(400)
        assert np.array_equal(person.q, stood) and page.locator(".jk.down").count() == 0
        assert person.context.drive.live


def test_two_fingers_hold_the_switch_and_a_button(sit_down, monkeypatch):
    monkeypatch.setattr(enabling, "SILENCE", 3.0)
    person = sit_down(touch=True)
    start = person.q
    fingers = [middle(person.page.get_by_test_id("enable")), middle(jog_button(person, "J2 minus"))]
    touch = person.page.context.new_cdp_session(person.page)
    points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(fingers)]
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": points[:1]})
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": points})
    person.until(lambda: person.q[1] < start[1] - 0.02, "axis 2 to move")
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    person.until(lambda: person.context.drive.how == "standing", "the arm to stand")


def test_a_page_that_freezes_stops_the_arm_within_a_fifth_of_a_second(sit_down):
    person = sit_down()
    page, show, shown = person.page, person.context.drive.show, []

    def seen(q):
        show(q)
        shown.append(time.monotonic())

    person.context.drive.show = seen
    heard, beat = [], person.context.drive.enabling.beat

    def word(held, **rest):
        heard.append(time.monotonic())
        return beat(held, **rest)

    person.context.drive.enabling.beat = word
    for _ in range(TRIES):  # on a busy machine the page falls silent by itself
        page.keyboard.down("Space")
        page.keyboard.down("w")
        page.wait_for_timeout(300)
        if person.context.drive.live and shown:
            break
        page.keyboard.up("w")
        page.keyboard.up("Space")
        page.wait_for_timeout(100)
    page.evaluate("() => { const end = performance.now() + 700; while (performance.now() < end); }")
    page.keyboard.up("w")
    page.keyboard.up("Space")
    person.until(lambda: not person.context.worker.running("jog"), "the stand-still")
    gaps = [(b - a, a) for a, b in pairwise(heard) if b - a > 0.3]
    assert gaps, "the page did not freeze"
    silent_from = gaps[-1][1]
    assert max(t for t in shown if t < silent_from + 0.6) - silent_from <= 0.2


def test_a_typed_value_waits_for_the_switch_and_the_arm_goes_there(sit_down, brisk):
    person = sit_down()
    person.page.get_by_role("button", name="Type a value for J1", exact=True).click()
    field = person.page.get_by_role("spinbutton", name="Type a value for J1", exact=True)
    field.fill("12.5")
    field.press("Enter")
    person.until(lambda: person.context.drive.how == "waiting", "the motion that waits")
    person.page.locator("#errand-said").filter(has_text="axis 1").wait_for()
    with person.holding():
        person.at_rest()
    assert np.degrees(person.q[0]) == pytest.approx(12.5, abs=1e-6)
    person.page.get_by_text("12.50°", exact=True).wait_for()


def test_a_reload_and_a_second_tab(sit_down):
    person = sit_down()
    person.click("Record Touch 1")
    person.until(lambda: "touch1" in person.state.captures, "the first point")
    live = person.live
    person.page.reload()
    person.page.locator(".done[data-testid=row-touch1]").wait_for()
    person.come_back()
    assert person.live is live
    second = sit_down(robot=None, context=person.page.context)
    assert second.live is live
    person.page.get_by_text("This session goes on in another tab.", exact=False).wait_for()
    second.click("Record Touch 2")
    second.until(lambda: "touch2" in second.state.captures, "the second point")
    person.click("Continue here")
    person.page.locator(".done[data-testid=row-touch2]").wait_for()
    second.page.get_by_text("This session goes on in another tab.", exact=False).wait_for()


@pytest.mark.parametrize(
    "size", [(1280, 800), (1024, 768), (820, 1180), (390, 844)], ids=lambda s: f"{s[0]}x{s[1]}"
)
@pytest.mark.parametrize("language", ["en", "zh"])
def test_nothing_of_the_frame_is_hidden_or_cut_off(sit_down, size, language):
    person = sit_down("jby50", screen={"width": size[0], "height": size[1]})
    if language == "zh":
        person.live.choose("language", "zh")
        person.page.get_by_text("使能", exact=True).first.wait_for()
    person.picture(f"size_{size[0]}_{language}")
    assert person.page.evaluate(_STOP) == "estop"
    assert person.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    person.until(lambda: person.page.evaluate(_HIDDEN) == [], "nothing to be hidden")
    small = person.page.evaluate(_SMALL)
    assert small == []
    assert not person.faults


@pytest.mark.parametrize("size", [(1280, 800), (1024, 768), (820, 1180), (390, 844)], ids=lambda s: f"{s[0]}")
def test_with_an_account_the_facts_still_stand_beside_each_other(sit_down, size):
    person = sit_down("jby50", screen={"width": size[0], "height": size[1]})
    person.page.evaluate(_WITH_ACCOUNT)
    person.page.wait_for_timeout(100)
    person.picture(f"account_bar_{size[0]}")
    assert person.page.evaluate(_ON_EACH_OTHER) == []
    assert person.page.evaluate(_STOP) == "estop"
    assert person.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    if size[0] == 1280:  # the two columns beside the scene are as high as the window
        home, enable = (person.page.locator(what).bounding_box() for what in ("#home", "#enable"))
        assert home["y"] + home["height"] <= enable["y"], "Home stands above ENABLING, not under it"


@pytest.mark.parametrize("language", ["en", "zh"])
def test_on_a_phone_the_word_that_releases_the_stop_is_not_cut_off(sit_down, language):
    person = sit_down("jby50", screen={"width": 390, "height": 844}, touch=True)
    person.live.choose("language", language)
    person.page.locator(f"html[lang^={language}]").wait_for(state="attached")
    person.page.get_by_test_id("estop").click()
    person.page.locator("#estop.latched").wait_for()
    within, words = person.page.evaluate(
        """() => { const key = document.getElementById("estop"), text = document.createRange();
            text.selectNodeContents(key);
            return [key, text].map((one) => one.getBoundingClientRect()).map((box) => [box.left, box.right]); }"""
    )
    assert within[0] + 4 <= words[0] and words[1] <= within[1] - 4 and within[1] <= 390


def test_dark_and_light_are_remembered_by_the_browser(sit_down):
    person = sit_down()
    assert person.page.evaluate("document.documentElement.dataset.theme") == "light"
    person.page.locator("#theme").click()
    person.until(lambda: person.context.look.dark, "the dark page")
    person.page.locator("html[data-theme=dark]").wait_for()
    again = sit_down(robot=None, context=person.page.context)
    again.page.locator("html[data-theme=dark]").wait_for()


#: A timer of the page is what it is, whatever frames are given up; of frames only the one that was given up stays out.
_GIVEN_UP = """async () => {
    const inner = document.getElementById('scene').contentWindow, came = [];
    const rests = new Promise((done) => inner.cancelAnimationFrame(inner.setTimeout(done, 50, true)));
    const frames = Array.from({ length: 20 }, (_, n) => inner.requestAnimationFrame(() => came.push(n)));
    frames.filter((_, n) => n % 2).forEach((frame) => inner.cancelAnimationFrame(frame));
    const soon = new Promise((done) => setTimeout(done, 20000, false));
    const timed = await Promise.race([rests, soon]);
    while (came.length < 10) await new Promise((done) => setTimeout(done, 20));
    return [timed, came];
}"""


def test_the_scene_goes_on_drawing_whatever_is_given_up(sit_down):
    """The numbers of timers and frames were mixed up: after a change of the window's size the scene stayed white."""
    person = sit_down()
    person.scene_is_there()
    timed, came = person.page.evaluate(_GIVEN_UP)
    assert timed and came == list(range(0, 20, 2))


def test_on_a_phone_what_waits_for_the_switch_leaves_the_message_no_column_of_letters(sit_down):
    person = sit_down(screen={"width": 390, "height": 844})
    person.page.locator("#home").click()
    person.live.joint(0, 20.0)
    person.until(lambda: person.context.drive.how == "waiting", "the errand")
    person.page.locator("#errand-said").filter(has_text="axis 1").wait_for()
    for words in (person.page.locator("#message"), person.page.locator("#errand")):
        box = words.bounding_box() if words.is_visible() else None
        assert box is None or box["width"] > 300, box
    assert person.page.locator("#line").bounding_box()["height"] < 100
