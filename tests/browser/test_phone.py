"""On a phone: every key of the top line has a place, and the key that is pressed next is in view."""

import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.scene.camera import whole
from app.units import from_deg
from tests.browser.test_training import TILTS

pytestmark = pytest.mark.browser

PHONE, SMALL = {"width": 390, "height": 844}, {"width": 1024, "height": 768}
TARGET_PX = 44.0
APART_DEG = 20.0  # between two points of an arc: few, for what is not about them

#: The first main key of the open screen, where it does not stand wholly in the work's window, below its tabs.
_HIDDEN = """() => {
    const work = document.getElementById("work").getBoundingClientRect();
    const tabs = document.getElementById("tabs").getBoundingClientRect();
    return [...document.querySelectorAll("#screens .w button.main")].filter((one) => one.checkVisibility())
        .slice(0, 1).map((one) => [one.textContent, one.getBoundingClientRect()])
        .filter(([, box]) => box.top < tabs.bottom || box.bottom > work.bottom + 0.5)
        .map(([words, box]) => [words, box.top, box.bottom, work.bottom]);
}"""


def what_hides(page):
    """What `_HIDDEN` finds once the page has come to rest: it scrolls there, on a busy machine not at once."""
    for _ in range(50):
        if not (found := page.evaluate(_HIDDEN)):
            break
        page.wait_for_timeout(100)
    return found


def test_theme_and_sound_have_keys_beside_home(sit_down, brisk):
    person = sit_down("jby50", screen=PHONE, touch=True)
    page = person.page
    for key in ("theme", "sound"):
        box = page.locator(f"#jog #{key}").bounding_box()
        assert min(box["width"], box["height"]) >= TARGET_PX, (key, box)
    page.locator("#theme").click()
    page.locator("html[data-theme=dark]").wait_for(state="attached")
    page.locator("#sound").click()
    assert page.locator("#sound").get_attribute("aria-pressed") == "true"
    page.set_viewport_size(SMALL)
    page.locator("#bar #theme").wait_for()
    assert page.locator("#bar #sound").is_visible()


def test_the_scene_knows_how_large_its_window_is(sit_down, brisk):
    """viser counts the pixels it draws; words that are to be read are laid out for those a person sees."""
    person = sit_down("jby50", screen=PHONE, touch=True)
    server = person.context.stage._server
    size = (
        "(({ clientWidth, clientHeight }) => [clientWidth, clientHeight])(document.getElementById('scene'))"
    )
    for screen in (PHONE, SMALL):
        person.page.set_viewport_size(screen)
        person.until(lambda: server.window == tuple(person.page.evaluate(size)), f"{screen}")


def test_the_key_that_is_pressed_next_comes_into_view(sit_down, brisk):
    person = sit_down("jby50", screen=PHONE, touch=True)
    person.page.locator("#switch button[data-part=work]").click()
    first, second = person.state.steps[:2]
    person.takes(first)
    person.until(lambda: person.view("deciding")._next_touch.proposal is not None, "the proposal")
    person.moves("Go to the ghost")
    person.moves("Touch the spike")
    person.page.locator("#screens .w button.main", has_text=f"Record {second.title}").wait_for()
    assert what_hides(person.page) == []


def test_an_exercise_is_begun_without_scrolling(sit_down, brisk):
    person = sit_down("jby50", screen=PHONE, touch=True)
    person.page.locator("#switch button[data-part=work]").click()
    person.screen("training")
    person.page.get_by_role("button", name="Begin", exact=True).wait_for()
    assert person.page.evaluate(_HIDDEN) == []


def at_two_robots(sit_down):
    """Somebody with a phone who has opened the cell of two robots."""
    person = sit_down("irb120", screen=PHONE, touch=True)
    person.page.locator("#switch button[data-part=work]").click()
    person.screen("base")
    person.click("Open the cell")
    person.reads("base-plan", "Robot 1")
    return person


def test_what_two_robots_give_is_in_view_with_what_is_done_next(sit_down, brisk):
    """Verdict and key stand above the procedure, which was looked at: the page stayed at the procedure's end."""
    person = at_two_robots(sit_down)
    view = person.view("run")
    person.does(lambda: setattr(view._every, "value", APART_DEG))
    person.click("Run the whole procedure")
    with person.holding():
        person.until(lambda: view.run.relation is not None, "the relation")
        person.at_rest()
    person.page.locator("#screens .w button.main", has_text="Send both tools to one point").wait_for()
    assert what_hides(person.page) == []
    verdict, tabs = (
        place.bounding_box()
        for place in (person.page.get_by_test_id("base-light"), person.page.locator("#tabs"))
    )
    assert verdict["y"] >= tabs["y"] + tabs["height"]


def test_neither_the_keys_of_the_views_nor_the_two_robots_hide_each_other(sit_down, brisk):
    """The keys stood over the first robot: in a scene so low there is no corner that is free in every view."""
    person = at_two_robots(sit_down)
    person.scene_is_there()
    scene, keys = (person.page.locator(place).bounding_box() for place in ("#scene", "#views"))
    assert keys["x"] + keys["width"] <= scene["x"]
    for key in person.page.locator("#views button").all():
        assert min(key.bounding_box()["width"], key.bounding_box()["height"]) >= TARGET_PX
    run = person.view("run").run
    arms = [arm.T_world_base.apply(arm.robot.chain.frames(q[None]).joint_positions[0])
            for arm, q in zip(run.cell.arms, run.postures, strict=True)]  # fmt: skip
    left, right = scene["x"], scene["x"] + scene["width"]

    def seen():
        at = [person.on_page(point) for point in np.vstack(arms)]
        return all(left < x < right and scene["y"] < y < scene["y"] + scene["height"] for x, y in at)

    person.until(seen, "both arms between the edges of the scene")


def touch(context, tilt):
    """The arm stands at the spike, tilted so, without a way."""
    world, home = context.world, context.model.home
    turned = world.hand(home).rotation @ exp_so3(from_deg(np.array(tilt, float)))
    near = Pose.of(turned, world.p_base_spike_drawn + np.array([0.0, 0.0, 0.03]))
    q = solve_ik(context.model, near, home, T_flange_tool=world.T_flange_tool_hand, max_steps=300).q
    context.drive.show(world.touch(q, context.rng).q)
    context.drive.settle()
    context.refresh()


def test_under_an_exercises_task_too_the_result_is_decided_without_scrolling(sit_down, brisk):
    person = sit_down("jby50", screen=PHONE, touch=True)
    person.page.locator("#switch button[data-part=work]").click()
    person.screen("training")
    person.choose(
        "Exercise", next(t for t, e in person.view("showing")._titles.items() if e.key == "first_tool")
    )
    person.until(lambda: person.context.exercise == "first_tool", "the choice")
    person.click("Begin")
    person.until(lambda: person.state.running is not None and person._idle(), "the exercise")
    for tilt in TILTS:
        person.does(lambda tilt=tilt: touch(person.context, tilt))
        person.does(lambda: person.view("deciding")._record_next())
    person.click("Calculate")
    person.page.get_by_role("button", name="Accept", exact=True).wait_for()
    assert what_hides(person.page) == []


def test_of_several_keys_that_appear_the_one_that_is_pressed_first_comes_into_view(sit_down, brisk):
    """A recording that was searched brings a switch under its verdict, and a report far below."""
    person = sit_down("ur10e", screen=PHONE, touch=True)
    person.page.locator("#switch button[data-part=work]").click()
    person.context.rng = np.random.default_rng(4)
    person.screen("compare")
    person.click("Record with a hidden fault")
    person.page.get_by_role("button", name="Find what is missing", exact=True).wait_for(timeout=60_000)
    person.click("Find what is missing")
    switch = person.page.get_by_role("button", name="Put it into the simulation", exact=True)
    switch.wait_for(timeout=60_000)
    assert what_hides(person.page) == []
    light, tabs = person.page.get_by_test_id("compare-verdict"), person.page.locator("#tabs")
    assert light.bounding_box()["y"] >= tabs.bounding_box()["y"] + tabs.bounding_box()["height"]


def test_the_scene_is_framed_for_the_window_it_begins_in(sit_down, brisk):
    person = sit_down("jby50", screen=SMALL)
    person.scene_is_there()
    stage = person.context.stage
    eye, centre = whole(person.context.world)

    def away():
        looks = stage._server.initial_camera
        return np.linalg.norm(np.subtract(looks.position, looks.look_at)) / np.linalg.norm(eye - centre)

    assert stage.eyes.aspect < 0.75
    person.until(
        lambda: abs(away() - 0.8 / stage.eyes.aspect) < 0.01, f"the eye farther away than {away():.2f}"
    )
