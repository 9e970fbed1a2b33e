"""What an exercise takes away is gone from the page."""

import re

from app.screens.aids import Aids

MILLIMETRES = re.compile(r"\d mm")
NEARBY = {"Show handle", "Go to the ghost", "Touch the spike"}
VIEWS = {"close", "side", "front"}


def test_without_aids_no_distance_no_near_view_no_proposal_and_no_handle(desk):
    assert desk.shown() >= NEARBY and desk.context.stage.handle.visible
    assert set(desk.live.choices()["views"]) > VIEWS
    assert MILLIMETRES.search(desk.live.read().touch)
    desk.does(lambda: desk.context.allow(Aids(False, False, False, False, False)))
    assert not NEARBY & desk.shown() and desk.live.choices()["views"] == ["whole"]
    assert not desk.context.stage.handle.visible and not desk.live.read().handle
    assert desk.live.read().touch == "no contact"
    assert not desk.live.choose("view", "close")
    desk.does(lambda: desk.context.allow(Aids()))
    assert desk.shown() >= NEARBY


def test_without_the_distance_a_far_record_is_warned_of_without_a_number(desk):
    desk.does(lambda: desk.context.allow(Aids(distance=False)))
    desk.press("Record Touch 1")
    level, words = desk.said
    assert level == "warning" and not MILLIMETRES.search(words)
