"""How the page looks and is reached: contrast, sizes of targets, focus, the first paint, its weight."""

import pytest

from tests.desk import until

pytestmark = pytest.mark.browser

TABS = ("tool", "compare", "base", "load", "training", "sessions", "cell", "log")
SIZES = {"desk": (1280, 800), "small": (1024, 768), "tablet": (820, 1180), "phone": (390, 844)}
TARGET_PX = 44.0
AA, AA_LARGE = 4.5, 3.0  # WCAG 2.1, 1.4.3
FIRST_PAINT_MS = 1000.0
WEIGHT = 200_000  # bytes, without viser's client

#: Every text that is seen with less contrast than it needs: [words, contrast, needed].
_FAINT = """() => {
    const linear = (v) => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
    const bright = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    const rgba = (text) => { const n = text.match(/[\\d.]+/g).map(Number); return n.length < 4 ? [...n, 1] : n; };
    const over = (top, below) => [0, 1, 2].map((k) => top[3] * top[k] + (1 - top[3]) * below[k]);
    const behind = (element) => {
        const layers = [];
        for (let at = element; at; at = at.parentElement) layers.push(rgba(getComputedStyle(at).backgroundColor));
        return layers.reverse().reduce((below, top) => over(top, below), [255, 255, 255]);
    };
    const found = [];
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) {
        const words = walk.currentNode.textContent.trim(), element = walk.currentNode.parentElement;
        if (!words || !element.checkVisibility() || element.closest("svg,script,option,:disabled")) continue;
        const look = getComputedStyle(element), below = behind(element);
        const ink = over([...rgba(look.color).slice(0, 3), rgba(look.color)[3] * look.opacity], below);
        const [a, b] = [bright(ink), bright(below)];
        const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        const size = parseFloat(look.fontSize), bold = Number(look.fontWeight) >= 700;
        const needed = size >= 24 || (bold && size >= 18.66) ? LARGE : SMALL;
        if (contrast < needed) found.push([words.slice(0, 30), contrast.toFixed(2), needed]);
    }
    return found;
}""".replace("LARGE", str(AA_LARGE)).replace("SMALL", str(AA))

#: Everything that can be pressed and is smaller than it must be: [what, width, height].
_SMALL = """(least) => [...document.querySelectorAll("button,select,input,summary")]
    .filter((one) => one.checkVisibility())
    .map((one) => [one, ["checkbox", "range", "file"].includes(one.type) ? one.closest("label") ?? one : one])
    .map(([one, held]) => [one, held.getBoundingClientRect()])
    .filter(([, box]) => box.width > 0 && (box.width < least - 0.5 || box.height < least - 0.5))
    .map(([one, box]) => [one.outerHTML.slice(0, 80), box.width, box.height])"""


def seen_tabs(person):
    """Each tab with what is folded in it open."""
    for key in TABS:
        # The tabs come with the panel, after the page: on a busy machine a moment later.
        person.page.locator(f"#tabs button[data-key={key}]").wait_for(state="attached", timeout=60_000)
        person.page.evaluate("key => document.querySelector(`#tabs button[data-key=${key}]`).click()", key)
        person.page.evaluate(
            "() => document.querySelectorAll('details').forEach((one) => { one.open = true; })"
        )
        person.page.wait_for_timeout(40)
        yield key


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_text_has_the_contrast_it_needs(sit_down, brisk, dark, language):
    person = sit_down("jby50")
    person.live.choose("dark", dark)
    person.live.choose("language", language)
    person.until(lambda: person._idle(), "the language")
    theme = "dark" if dark else "light"
    person.page.locator(f"html[data-theme={theme}][lang^={language}]").wait_for(state="attached")
    person.page.wait_for_timeout(300)
    found = {key: person.page.evaluate(_FAINT) for key in seen_tabs(person)}
    assert not any(found.values()), found


def test_a_result_a_stop_and_an_exercise_have_it_too(sit_down, brisk):
    from app.screens._tool.paper import play_paper_table

    person = sit_down("jby50")
    with person.holding():
        person.does(lambda: play_paper_table(person.context))
        person.until(lambda: person.state.result is not None, "the result")
        person.at_rest()
    for dark in (False, True):
        person.live.choose("dark", dark)
        person.page.locator(f"html[data-theme={'dark' if dark else 'light'}]").wait_for(state="attached")
        assert person.page.evaluate(_FAINT) == []
        person.page.get_by_test_id("estop").click()
        person.until(lambda: person.context.drive.how == "stopped", "the stop")
        person.page.locator("#estop.latched").wait_for()
        assert person.page.evaluate(_FAINT) == []
        person.page.get_by_test_id("estop").click()
        person.until(lambda: person.context.drive.how != "stopped", "the release")
        person.page.locator("#estop:not(.latched)").wait_for()


@pytest.mark.parametrize("size", SIZES)
def test_what_is_pressed_is_as_large_as_a_finger_on_every_screen(sit_down, brisk, size):
    width, height = SIZES[size]
    person = sit_down("jby50", screen={"width": width, "height": height}, touch=size in ("tablet", "phone"))
    found = set()
    for part in ("jog", "work") if size == "phone" else ("",):
        if part:
            person.page.locator(f"#switch button[data-part={part}]").click()
        for _ in seen_tabs(person):
            found |= {tuple(small) for small in person.page.evaluate(_SMALL, TARGET_PX)}
    assert not found, sorted(found)
    assert person.page.evaluate("document.documentElement.scrollWidth") <= width


def test_whatever_has_the_focus_has_a_ring(sit_down, brisk):
    person = sit_down("jby50")
    reached = set()
    for _ in range(40):
        person.page.keyboard.press("Tab")
        what, style, width = person.page.evaluate(
            """() => { const one = document.activeElement, look = getComputedStyle(one);
                return [one.id || one.outerHTML.slice(0, 60), look.outlineStyle, parseFloat(look.outlineWidth)]; }"""
        )
        if what in ("scene",) or what.startswith("<body"):
            continue
        reached.add(what)
        assert style != "none" and width >= 2.0, what
    assert {"estop", "language", "theme", "home"} <= reached and len(reached) > 20


#: What is read from where a person stands who holds the pendant of a real arm: [what, size in px].
_READ_FAR = """() => ["#state", "#enabled", "#tool", "#speed", "#touch", "#axes .val", "#message", ".next b", "#estop",
    "#enable b"].map((what) => [what, parseFloat(getComputedStyle(document.querySelector(what)).fontSize)])"""
#: 17 px at 96 dpi are capitals of 3.3 mm: 11 minutes of arc at one metre, twice what an eye of 20/20 tells apart.
FAR_PX = 17.0


@pytest.mark.parametrize("size", ["desk", "small", "tablet"])
def test_what_is_read_at_one_metre_is_large_enough(sit_down, brisk, size):
    width, height = SIZES[size]
    person = sit_down("jby50", screen={"width": width, "height": height})
    person.page.locator(".next b").first.wait_for()
    found = person.page.evaluate(_READ_FAR)
    assert not [small for small in found if small[1] < FAR_PX], found


def test_on_a_phone_the_switch_is_there_beside_the_work_and_no_axis_is_under_it(sit_down, brisk):
    width, height = SIZES["phone"]
    person = sit_down("jby50", screen={"width": width, "height": height}, touch=True)
    box = "document.querySelector(what).getBoundingClientRect()"
    place = f"(what) => {{ const box = {box}; return [box.top, box.bottom]; }}"
    last = person.page.evaluate(place, "#axes .ax:last-child .jk")
    assert last[1] <= person.page.evaluate(place, "#enable")[0]
    person.page.locator("#switch button[data-part=work]").click()
    assert person.page.locator("#enable").is_visible()
    assert person.page.evaluate(place, "#work")[1] <= person.page.evaluate(place, "#enable")[0] + 1


def test_the_first_paint_comes_soon_and_the_page_is_light(chromium, served):
    """The best of three: what is measured is the page, not what else the machine does."""
    paints, weight = [], 0
    for _ in range(3):
        context = chromium.new_context(viewport={"width": 1280, "height": 800})
        page = context.new_page()
        page.goto(served.address)
        # asked from here: a predicate that waits within the page is evaluated there, which the page's policy forbids
        until(
            lambda page=page: page.evaluate(
                "performance.getEntriesByName('first-contentful-paint').length > 0"
            ),
            "the first paint",
        )
        paints.append(page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime"))
        weight = page.evaluate(
            """() => [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')]
                .filter((one) => !new URL(one.name).pathname.startsWith('/scene'))
                .reduce((sum, one) => sum + one.decodedBodySize, 0)"""
        )
        context.close()
    print(f"first paint {min(paints):.0f} ms of {[round(p) for p in paints]}, page {weight} bytes")
    assert min(paints) < FIRST_PAINT_MS
    assert 20_000 < weight < WEIGHT


#: What another language brings: the screens anew, and the first of them alone for a moment.
_ANEW = """async () => {
    const { update } = await import('./static/panel.js');
    const screen = (key, id) => ({ id, kind: 'screen', key, label: key, order: id, visible: true });
    const open = () => document.querySelector('#tabs [aria-selected=true]').dataset.key;
    const seen = [];
    update({ whole: true, removed: [], widgets: [screen('tool', 900)] });
    seen.push(open());
    update({ whole: false, removed: [], widgets: [screen('sessions', 901)] });
    seen.push(open());
    return seen;
}"""


def test_the_open_screen_stays_open_while_screens_are_made_anew(sit_down, brisk):
    person = sit_down("jby50")
    person.screen("sessions")
    assert person.page.evaluate(_ANEW) == ["tool", "sessions"]


def test_every_fact_of_the_top_line_that_is_shown_says_something(sit_down, brisk):
    person = sit_down("ur10e")
    person.page.evaluate("() => { document.getElementById('touch').textContent = ''; }")
    shown = person.page.evaluate(
        """() => [...document.querySelectorAll('#facts div')].filter((one) => one.checkVisibility())
            .map((one) => one.querySelector('dd').textContent)"""
    )
    assert len(shown) >= 5 and all(shown)
    robot = person.page.locator("#robot")
    assert robot.evaluate("one => one.scrollHeight <= one.clientHeight + 1"), "maker and type are cut off"


@pytest.mark.parametrize("size", list(SIZES))
def test_each_tab_has_one_line_also_when_it_is_open(sit_down, size):
    """The open one is bold, and "Two robots" broke over two lines beside seven others."""
    width, height = SIZES[size]
    person = sit_down("jby50", screen={"width": width, "height": height}, touch=size in ("tablet", "phone"))
    if size == "phone":
        person.page.locator("#switch button[data-part=work]").click()
    for key in TABS:
        person.screen(key)
        tab = person.page.locator(f"#tabs button[data-key={key}][aria-selected=true]")
        tab.wait_for()
        lines, cut = tab.evaluate(
            """one => {
                const words = document.createRange();
                words.selectNodeContents(one);
                const tops = new Set([...words.getClientRects()].map((box) => Math.round(box.top)));
                return [tops.size, one.scrollWidth - one.clientWidth];
            }"""
        )
        assert lines == 1 and cut <= 0, (key, lines, cut)
