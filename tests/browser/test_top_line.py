"""The line on top: what it says is there and is not cut off, on every screen, in every language, in a lesson too."""

import pytest

pytestmark = pytest.mark.browser

SIZES = {"desk": (1280, 800), "small": (1024, 768), "tablet": (820, 1180)}
ALWAYS = {"mode", "robot", "tool", "base", "speed", "touch"}

#: With the widest words of state, switch and stop: what is shown, and what is cut off or stands outside its line.
_FACTS = """([state, enabled, stop]) => {
    const put = (id, words) => { document.getElementById(id).textContent = words; };
    put("state", state); put("enabled", enabled); put("estop", stop);
    const facts = document.getElementById("facts"), line = facts.getBoundingClientRect();
    const bar = document.getElementById("bar").getBoundingClientRect();
    const seen = [...facts.querySelectorAll("dd")].filter((one) => one.checkVisibility() && one.textContent);
    const wrong = seen.filter((one) => {
        const box = one.getBoundingClientRect();
        return one.scrollWidth > one.clientWidth + 1 || one.scrollHeight > one.clientHeight + 2
            || box.right > line.right + 1 || box.bottom > bar.bottom || box.top < bar.top;
    });
    wrong.push(...[...facts.querySelectorAll("dt")].filter((one) => one.checkVisibility()
        && !one.nextElementSibling.textContent));
    const keys = [...document.querySelectorAll("#bar > :not(#facts)")].filter((one) => one.checkVisibility());
    wrong.push(...keys.filter((one) => {
        const box = one.getBoundingClientRect();
        return box.right > innerWidth + 0.5 || box.left < 0 || one.scrollWidth > one.clientWidth + 1;
    }));
    return [seen.map((one) => one.id || "mode"), wrong.map((one) => one.id + ": " + one.textContent)];
}"""


def looks(person, language, dark):
    person.live.choose("language", language)
    person.live.choose("dark", dark)
    theme = "dark" if dark else "light"
    person.page.locator(f"html[data-theme={theme}][lang^={language}]").wait_for(state="attached")
    person.page.wait_for_timeout(200)


@pytest.mark.parametrize("robot", ["ur10e", "jby50"])
@pytest.mark.parametrize("lesson", [False, True], ids=["free", "lesson"])
def test_mode_tool_base_and_all_the_rest_are_there_and_whole(sit_down, brisk, robot, lesson):
    person = sit_down(robot)
    if lesson:
        person.screen("training")
        person.click("Begin")
        person.until(lambda: person.state.running is not None, "the exercise")
        person.page.get_by_test_id("status-clock").filter(has_text="/").wait_for()
    for language, dark in (("en", False), ("zh", True)):
        looks(person, language, dark)
        t = person.context.t
        for how in ("standing", "measuring"):
            words = [t(f"status.{how}"), t("page.enabled"), t("page.release")]
            for name, (width, height) in SIZES.items():
                person.page.set_viewport_size({"width": width, "height": height})
                person.page.wait_for_timeout(120)
                shown, wrong = person.page.evaluate(_FACTS, words)
                assert set(shown) >= ALWAYS | {"clock" if lesson else "points"}, (name, language, shown)
                assert not wrong, (name, language, how, wrong)


def test_what_has_nothing_to_say_is_not_there(sit_down, brisk):
    """Beside two robots there is no spike: its name stood there with nothing behind it."""
    person = sit_down("irb120")
    person.screen("base")
    person.click("Open the cell")
    person.page.locator("#touch:empty").wait_for(state="attached")
    for name, (width, height) in SIZES.items():
        person.page.set_viewport_size({"width": width, "height": height})
        person.page.wait_for_timeout(120)
        shown, wrong = person.page.evaluate(_FACTS, ["READY", "LOCKED", "STOP"])
        assert {"mode", "robot", "tool", "base", "speed"} == set(shown) and not wrong, (name, shown, wrong)


def test_the_lesson_that_runs_is_named_with_its_time_wherever_the_work_is_scrolled(sit_down, brisk):
    """The task stands above the work and goes up with it; its name went under the top line."""
    person = sit_down("jby50")
    assert not person.page.get_by_test_id("status-task").is_visible()
    person.screen("training")
    person.click("Begin")
    person.until(lambda: person.state.running is not None, "the exercise")
    person.reads("status-clock", " / ")
    task = person.page.locator("#strip .next b").first.inner_text()
    person.page.evaluate("() => { document.getElementById('work').scrollTop = 600; }")
    assert person.seen("status-task") == task
    assert person.page.get_by_test_id("status-points").is_hidden()  # they stand beside the task
    person.click("Give up")
    person.until(lambda: person.state.running is None, "the end")
    person.page.locator("#clock:empty").wait_for(state="attached")
    assert not person.page.get_by_test_id("status-task").is_visible()
