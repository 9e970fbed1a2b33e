"""A gamepad at the page: what it holds, and everything that lets go of it."""

import pytest

pytestmark = pytest.mark.browser

STOP, SHOULDER, UP, DOWN, LEFT, RIGHT = 1, 5, 12, 13, 14, 15
A_WHILE_MS = 300

PAD = """() => {
    const button = () => ({ pressed: false });
    window.pad = { index: 0, connected: true, axes: [0, 0, 0, 0], buttons: Array.from({ length: 16 }, button) };
    window.padSlots = [window.pad];
    navigator.getGamepads = () => window.padSlots;
    window.dispatchEvent(new Event("gamepadconnected"));
}"""
#: What takes a pad away, while its shoulder button and its cross are held.
GONE = {
    "unplugged": "() => { padSlots = [null]; window.dispatchEvent(new Event('gamepaddisconnected')); }",
    "gone without a word": "() => { padSlots = [null]; }",
    "switched off": "() => { pad.connected = false; }",
    "another pad": "() => { padSlots = [null, { ...pad, index: 1 }]; }",
}
#: What lets go of everything that is held.
LET_GO = {
    "another window": "() => { document.hasFocus = () => false; window.dispatchEvent(new Event('blur')); }",
    "the page is hidden": """() => { Object.defineProperty(document, 'hidden', { get: () => true, configurable: true });
        document.dispatchEvent(new Event('visibilitychange')); }""",
    "another frame": "() => document.querySelector('#frames [data-key=base]').click()",
}
PLUGGED_IN = (
    "() => { pad.connected = true; padSlots = [pad]; window.dispatchEvent(new Event('gamepadconnected')); }"
)
#: The page has looked at its pads since: its own timer, due before this one, has run, however busy the machine is.
LOOKED = "() => new Promise((done) => setTimeout(done, 50))"
BACK = "() => { delete document.hasFocus; delete document.hidden; }"


def presses(person, number, down=True):
    person.page.evaluate("([number, down]) => { pad.buttons[number].pressed = down; }", [number, down])


def pushes(person, across=0.0, along=0.0):
    person.page.evaluate(
        "([across, along]) => { pad.axes[0] = across; pad.axes[1] = along; }", [across, along]
    )


def stands(person):
    """Nothing moves for a while."""
    person.at_rest()
    stood = person.q
    person.page.wait_for_timeout(A_WHILE_MS)
    return bool((person.q == stood).all())


@pytest.fixture
def person(sit_down, brisk):
    person = sit_down("jby50")
    person.page.evaluate(PAD)
    return person


@pytest.fixture
def jogging(person):
    """The first axis is jogged by shoulder button and cross."""
    start = person.q
    presses(person, SHOULDER)
    person.until(lambda: person.context.drive.live, "the shoulder button")
    presses(person, RIGHT)
    person.until(lambda: person.q[0] > start[0] + 0.01, "the first joint")
    return person


def only_pressed_anew(jogging, away, back):
    """What is held is let go of by `away`; after `back` nothing moves until all was let go and is pressed anew."""
    drive = jogging.context.drive
    jogging.page.evaluate(away)
    jogging.until(lambda: not drive.live, "the pad to let go")
    assert stands(jogging)
    jogging.page.evaluate(back)
    assert stands(jogging) and not drive.live
    presses(jogging, RIGHT, False)
    presses(jogging, SHOULDER, False)
    jogging.page.evaluate(LOOKED)
    presses(jogging, SHOULDER)
    jogging.until(lambda: drive.live, "the shoulder button, pressed anew")


def test_a_gamepad_enables_chooses_jogs_and_stops(person):
    drive, start = person.context.drive, person.q
    presses(person, RIGHT)  # the cross, without the shoulder button
    pushes(person, across=0.9)
    assert stands(person) and (person.q == start).all()
    presses(person, RIGHT, False)
    pushes(person)
    presses(person, DOWN)  # the next axis
    person.page.locator("#axes .ax.chosen").nth(0).filter(has_text="J2").wait_for()
    presses(person, DOWN, False)
    presses(person, SHOULDER)
    person.until(lambda: drive.live, "the shoulder button")
    presses(person, RIGHT)
    person.until(lambda: abs(person.q[1] - start[1]) > 0.01, "the second joint")
    assert person.q[1] > start[1] and person.q[0] == start[0]
    presses(person, SHOULDER, False)
    person.until(lambda: not drive.live, "letting go")
    assert stands(person)
    presses(person, STOP)
    person.until(lambda: drive.how == "stopped", "the round button")
    presses(person, STOP, False)


def test_a_stick_chooses_and_jogs_and_back_in_the_middle_the_arm_stands(jogging):
    presses(jogging, RIGHT, False)
    assert stands(jogging)
    start = jogging.q
    pushes(jogging, across=0.9)
    jogging.until(lambda: jogging.q[0] > start[0] + 0.01, "the first joint")
    pushes(jogging, across=0.9, along=0.9)  # a thumb is not exact: the axis that moves stays the chosen one
    jogging.page.wait_for_timeout(A_WHILE_MS)
    assert jogging.page.locator("#axes .ax.chosen").inner_text().startswith("J1")
    pushes(jogging, across=0.05, along=0.05)
    assert stands(jogging) and jogging.context.drive.live
    before = jogging.q
    pushes(jogging, along=0.9)
    jogging.page.locator("#axes .ax.chosen").filter(has_text="J2").wait_for()
    assert (jogging.q == before).all()
    pushes(jogging, across=-0.9)
    jogging.until(lambda: jogging.q[1] < before[1] - 0.01, "the second joint, the other way")


def test_with_frames_that_do_not_come_a_pad_that_is_let_go_is_let_go(jogging):
    """The words of what is held came from a timer, what is held from the drawing: it could stay held for ever."""
    jogging.page.evaluate("() => { window.requestAnimationFrame = () => 0; }")
    jogging.page.wait_for_timeout(100)
    presses(jogging, RIGHT, False)
    presses(jogging, SHOULDER, False)
    jogging.until(lambda: not jogging.context.drive.live, "letting go")
    assert stands(jogging)


@pytest.mark.parametrize("how", GONE)
def test_a_pad_that_is_gone_stops_the_arm_and_moves_nothing_when_it_is_back(jogging, how):
    only_pressed_anew(jogging, GONE[how], PLUGGED_IN)


@pytest.mark.parametrize("how", LET_GO)
def test_what_lets_go_of_keys_lets_go_of_a_pad_until_it_is_pressed_anew(jogging, how):
    """It was let go and, a frame later, held again: the arm went on in a window nobody looked at."""
    only_pressed_anew(jogging, LET_GO[how], BACK)


def test_after_a_stop_is_released_a_held_pad_moves_nothing(jogging):
    presses(jogging, STOP)
    jogging.until(lambda: jogging.context.drive.how == "stopped", "the round button")
    jogging.until(lambda: jogging.context.log[-1][1] == "error", "what is said of it")
    said = len(jogging.context.log)
    jogging.page.wait_for_timeout(A_WHILE_MS)
    assert len(jogging.context.log) == said, "one press is one stop"
    presses(jogging, STOP, False)
    jogging.page.get_by_test_id("estop").click()
    jogging.until(lambda: jogging.context.drive.how != "stopped", "the release")
    assert stands(jogging) and not jogging.context.drive.live


def test_only_an_axis_that_is_there_is_chosen(person):
    for _ in range(8):
        presses(person, DOWN)
        person.page.wait_for_timeout(60)
        presses(person, DOWN, False)
        person.page.wait_for_timeout(60)
    assert person.page.locator("#axes .ax.chosen").inner_text().startswith("J6")
    person.page.keyboard.press("7")
    assert person.page.locator("#axes .ax.chosen").inner_text().startswith("J6")
    person.page.locator("#help").click()
    assert "shoulder button" in person.page.locator("#keys").inner_text()
