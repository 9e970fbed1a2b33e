"""For who does not see or point: every control has a name, every reference leads somewhere, the focus is seen."""

import pytest

from tests.browser.test_looks import seen_tabs

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]

#: What a reader would stumble over: [what is wrong, where].
_FAULTS = """() => {
    const found = [], seen = (one) => one.checkVisibility() && !one.closest("[aria-hidden=true]");
    const where = (one) => one.outerHTML.slice(0, 90);
    const of = (ids) => (ids ?? "").split(/\\s+/).filter(Boolean);
    const name = (one) => [
        of(one.getAttribute("aria-labelledby")).map((id) => document.getElementById(id)?.textContent ?? "").join(" "),
        one.getAttribute("aria-label"), [...(one.labels ?? [])].map((label) => label.textContent).join(" "),
        ["BUTTON", "A", "SUMMARY"].includes(one.tagName) ? one.textContent : "", one.title, one.getAttribute("alt"),
    ].find((words) => words?.trim()) ?? "";
    const named = "button,select,input,textarea,summary,a[href],iframe,progress,img,dialog,[role=radiogroup]," +
        "[role=tablist],[role=tabpanel],[role=dialog],[role=group],nav,main>section";
    for (const one of document.querySelectorAll(named))
        if (seen(one) && !name(one)) found.push(["no name", where(one)]);
    for (const one of document.querySelectorAll("svg"))
        if (seen(one) && !name(one) && !one.querySelector("title") && !one.closest("figure:has(figcaption)"))
            found.push(["a picture without words", where(one)]);
    for (const key of ["aria-controls", "aria-labelledby", "aria-describedby"])
        for (const one of document.querySelectorAll(`[${key}]`))
            if (of(one.getAttribute(key)).some((id) => !document.getElementById(id)))
                found.push([key + " leads nowhere", where(one)]);
    const ids = [...document.querySelectorAll("[id]")].map((one) => one.id);
    for (const id of new Set(ids.filter((id, k) => ids.indexOf(id) !== k))) found.push(["twice the same id", id]);
    for (const one of document.querySelectorAll("[role=radio]"))
        if (!one.closest("[role=radiogroup]") || !one.hasAttribute("aria-checked"))
            found.push(["a radio alone", where(one)]);
    for (const group of document.querySelectorAll("[role=radiogroup]"))
        if (group.querySelectorAll("[aria-checked=true]").length > 1)
            found.push(["two chosen of one", where(group)]);
    for (const one of document.querySelectorAll("[role=tab]"))
        if (!one.closest("[role=tablist]") || !one.hasAttribute("aria-selected"))
            found.push(["a tab alone", where(one)]);
    const told = new Map();
    for (const one of document.querySelectorAll("button,a[href]")) {
        if (!seen(one)) continue;
        const words = `${one.getAttribute("role") ?? one.tagName} ${name(one).trim()}`;
        if (told.has(words)) found.push(["two controls of one name", words]);
        told.set(words, one);
    }
    if (!document.documentElement.lang) found.push(["no language", "html"]);
    if (!document.title) found.push(["no title", "head"]);
    return found;
}"""

#: What has the focus, and whether that is seen: [name, width of the ring in px].
_RING = """() => {
    const one = document.activeElement, look = getComputedStyle(one);
    if (one === document.body || one.tagName === "IFRAME") return [one.tagName, 9];
    return [one.id || one.getAttribute("aria-label") || one.textContent.slice(0, 30),
        look.outlineStyle === "none" ? 0 : parseFloat(look.outlineWidth)];
}"""
_RING_PX, _STEPS = 2.0, 90


@pytest.mark.parametrize("language", ["en", "zh"])
def test_everything_has_a_name_and_no_reference_leads_nowhere(sit_down, brisk, language):
    person = sit_down("jby50")
    person.live.choose("language", language)
    person.page.locator(f"html[lang^={language}]").wait_for(state="attached")
    person.until(lambda: bool(person.context.views) and person._idle(), "the language")
    found = {key: person.page.evaluate(_FAULTS) for key in seen_tabs(person)}
    assert not any(found.values()), found


def test_the_focus_is_seen_wherever_it_goes_and_reaches_switch_keys_and_stop(sit_down, brisk):
    person = sit_down("jby50")
    been = []
    for _ in range(_STEPS):
        person.page.keyboard.press("Tab")
        been.append(tuple(person.page.evaluate(_RING)))
    assert not [name for name, width in been if width < _RING_PX]
    names = {name for name, _ in been}
    assert {"estop", "enable", "J1 plus", "J6 minus", "override", "home"} <= names, names


def test_the_arm_is_jogged_without_a_pointer(sit_down, brisk):
    person = sit_down("jby50")
    start = person.q
    person.page.get_by_role("button", name="J2 plus", exact=True).focus()
    person.page.keyboard.down("Enter")
    person.page.wait_for_timeout(200)
    assert (person.q == start).all()  # the switch is not held
    person.page.keyboard.up("Enter")
    with person.holding():
        person.until(lambda: person.context.drive.live, "the switch")
        person.page.keyboard.down("Enter")
        person.until(lambda: person.q[1] > start[1] + 0.01, "the second joint")
        person.page.keyboard.up("Enter")
        person.at_rest()
        stood = person.q
        person.page.wait_for_timeout(200)
        assert (person.q == stood).all()
    assert not person.faults
