"""The tree of widgets: what changed since when, who hears what, and what cannot be meant."""

import math

import msgspec
import pytest

from app.panel import Panel, Row, Widget
from tests.standing_out import standing_out


@pytest.fixture
def panel():
    return Panel()


def test_only_what_changed_is_told_again(panel):
    with panel.add_folder("folder"):
        text, other = panel.add_text("name", "a"), panel.add_check("yes", False)
    revision, all_, _ = panel.since(0)
    assert [w.kind for w in all_] == ["folder", "text", "check"]
    assert panel.since(revision)[1:] == ([], [])
    text.value = "b"
    later, changed, _ = panel.since(revision)
    assert [w.id for w in changed] == [text.data.id] and later > revision
    text.value, other.value = "b", False
    assert panel.since(later)[1] == []


def test_what_is_taken_away_is_told_with_all_that_stands_in_it(panel):
    folder = panel.add_folder("folder")
    with folder:
        inner = panel.add_button("press")
    revision, _, _ = panel.since(0)
    folder.remove()
    _, widgets, removed = panel.since(revision)
    assert widgets == [] and set(removed) == {folder.data.id, inner.data.id}
    assert panel.since(0)[1:] == ([], [])


@pytest.mark.parametrize(
    "make, good, bad",
    [
        (lambda p: p.add_choice("c", ("a", "b")), ["b"], ["x", 1, None, ["a"]]),
        (lambda p: p.add_buttons("c", ("a", "b")), ["b"], ["x", 1, None]),
        (lambda p: p.add_check("c", False), [True], [1, "yes", None]),
        (lambda p: p.add_number("c", 1.0), [2, 2.5], [math.nan, math.inf, "2", True, None]),
        (lambda p: p.add_text("c", ""), ["x"], [1, None, "x" * 3000]),
        (lambda p: p.add_vector("c", (0.0, 0.0, 0.0)), [[1, 2, 3.5]], [[1, 2], [1, 2, math.nan], "123", 5]),
        (lambda p: p.add_rows((Row("r", "row", actions=(("go", "Go"),)),)), ["r/go"], ["r/x", "go", None]),
    ],
)
def test_only_what_can_be_meant_is_heard(panel, make, good, bad):
    handle, heard = make(panel), []
    handle.heard = heard.append
    for value in bad:
        panel.hear(handle.data.id, value)
    assert heard == []
    for value in good:
        panel.hear(handle.data.id, value)
    assert len(heard) == len(good)


def test_numbers_are_kept_within_their_bounds(panel):
    handle, heard = panel.add_number("n", 1.0, low=0.0, high=10.0), []
    handle.heard = heard.append
    for value in (-5, 50, 5):
        panel.hear(handle.data.id, value)
    assert heard == [0.0, 10.0, 5.0] and handle.value == 5.0


def test_what_is_hidden_or_disabled_hears_nothing(panel):
    folder = panel.add_folder("folder", visible=False)
    with folder:
        inside = panel.add_button("inside")
    alone, heard = panel.add_button("alone"), []
    alone.disabled = True
    for handle in (inside, alone):
        handle.heard = heard.append
        panel.hear(handle.data.id, None)
    assert heard == []
    folder.visible = True
    panel.hear(inside.data.id, None)
    assert heard == [None]
    panel.hear(10_000, None)  # nobody of this number


def test_a_refused_value_goes_back_to_what_is_so(panel):
    handle = panel.add_choice("c", ("a", "b"))
    revision = panel.since(0)[0]
    panel.hear(handle.data.id, "b")
    handle.value = "a"
    changed = panel.since(revision)[1]
    assert [w.value for w in changed] == ["a"]


def test_widgets_are_plain_data(panel):
    with panel.add_screen("tool", "Tool"):
        panel.add_rows((Row("t", "Touch 1", "now", "green", "next", (("record", "Record"),)),))
    text = msgspec.json.encode(panel.widgets())
    assert [w.kind for w in msgspec.json.decode(text, type=list[Widget])] == ["screen", "rows"]


def test_of_all_places_at_once_the_uppermost_has_the_key_that_stands_out(panel):
    """After "Accept" in an exercise two keys stood out, and under a score card the wizard's key beside the card's."""
    with panel.add_screen("training", "Training"):
        strip = panel.add_strip()
    with panel.add_screen("tool", "Tool"):
        record = panel.add_button("record")
        panel.add_buttons("then", ("verify", "again"), rank="main", visible=False)
    with strip:
        finish = panel.add_button("finish", rank="plain")
    strip.visible = True
    assert standing_out(panel, "tool") == ["record"]
    revision = panel.since(0)[0]
    finish.rank = "main"
    assert standing_out(panel, "tool") == ["finish"] and record.rank == "main"
    assert record.data.id in [w.id for w in panel.since(revision)[1]]  # the page is told that it is quiet now
    with panel.add_dialog("score") as dialog:
        again = panel.add_button("again")
    assert standing_out(panel, "tool") == ["again"]
    again.disabled = True
    assert standing_out(panel, "tool") == ["finish"]
    again.disabled = False
    dialog.close()
    strip.visible = False
    assert standing_out(panel, "tool") == ["record"]
