"""The key that is pressed next stands out: to the ghost, to the spike, record; then the strokes; then calculate."""

import dataclasses

from app.screens.aids import Aids
from app.session.actions import ChooseMode
from app.units import from_mm
from tests.desk import until


def standing_out(desk):
    """Which keys of the wizard are of the first rank."""
    tool = desk.tool
    keys = {
        "ghost": tool._next_touch.go_button,
        "hand": tool._assist,
        "record": tool._record,
        "calculate": tool._calculate,
    }
    desk.idle()
    return [name for name, key in keys.items() if key.visible and key.rank == "main"]


def proposed(desk):
    until(lambda: desk.tool._next_touch.proposal is not None, "the proposal")
    desk.idle()


def test_one_key_after_the_other_stands_out_to_the_end(desk):
    desk.fresh(robot="ur10e")
    desk.does(lambda: desk.context.do(ChooseMode("touch_zx", 4)))
    for _ in range(4):
        proposed(desk)
        assert standing_out(desk) == ["ghost"]
        desk.moves(desk.tool._next_touch.go)
        assert standing_out(desk) == ["hand"]
        assert desk.said[1].endswith(f"Touch the spike and record {desk.state.missing[0].title}.")
        desk.moves(desk.tool._help)
        assert standing_out(desk) == ["record"]
        desk.does(desk.tool._record_next)
    while desk.state.missing:
        assert standing_out(desk) == ["hand"]
        desk.moves(desk.tool._help)
        assert standing_out(desk) == ["record"], desk.said
        desk.does(desk.tool._record_next)
    assert standing_out(desk) == ["calculate"]
    # Who presses what stands out touches as a hand does: a tool of 0.00 mm came of poses that were worked out.
    desk.does(desk.tool._compute)
    assert desk.state.result.result.mean > from_mm(0.02)


def test_without_help_the_record_key_stands_out_and_tells_nothing_of_contact(desk):
    desk.fresh(robot="ur10e")
    bare = dataclasses.replace(desk.context.aids, touch=False, next_touch=False, light=False, distance=False)
    desk.does(lambda: desk.context.allow(bare))
    assert standing_out(desk) == ["record"]


def test_what_is_brought_there_by_hand_is_recorded_where_it_touches_and_not_in_the_air(desk):
    """In an exercise without help the key stood out 269 mm from the spike, and again where a touch had been taken."""
    desk.fresh(robot="ur10e")
    desk.does(lambda: desk.context.do(ChooseMode("touch", 4)))
    desk.does(lambda: desk.context.allow(Aids(touch=False, next_touch=False)))
    assert standing_out(desk) == []
    world = desk.context.world
    desk.place(world.touch(desk.q, desk.context.rng).q)
    assert standing_out(desk) == ["record"]
    desk.does(desk.tool._record_next)
    assert standing_out(desk) == []
    desk.place(desk.context.model.home)
    assert standing_out(desk) == []
    desk.does(lambda: desk.context.allow(Aids()))
