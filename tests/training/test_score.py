"""What a score is made of, one thing at a time."""

from dataclasses import replace

import msgspec
import numpy as np
import pytest

from app.errors import FileFormatError, InputError
from app.session import Session, Store
from app.session.actions import Finish, Move
from app.session.state import as_tuple
from app.training.attempt import last_attempt
from app.training.cell import at_touch, begin, true_tool, world_of
from app.training.exercise import exercise, exercises, read_exercise
from app.training.records import Records, best_of
from app.training.score import score
from app.training.travel import travel
from app.training.truth import draw
from app.units import from_mm
from tests.training.trainee import ALIKE, GOOD

TOOL = exercise("first_tool")
BENT = exercise("bent_tip")


def part(card, key):
    return next(p.value for p in card.parts if p.key == key)


def test_the_tool_error_is_the_distance_to_the_hidden_tool_point():
    session = GOOD.does(TOOL, 3)
    card = score(TOOL, session.entries[1:])
    truth = draw(TOOL, 3).world.T_flange_tool_true.position
    expected = np.linalg.norm(session.state.tool.T_flange_tool.position - truth)
    assert card.figures["tool_mm"] == pytest.approx(expected * 1e3, abs=1e-3)
    assert card.truth["tool_z_mm"] == pytest.approx(truth[2] * 1e3, abs=1e-3)


def test_a_tool_taught_before_the_tip_bent_is_judged_by_the_bent_tip():
    bent = GOOD.scores(BENT, 3)
    before = replace(GOOD, again=False).scores(BENT, 3)
    assert bent.figures["tool_mm"] < 1.0 < before.figures["tool_mm"]


def test_slower_is_worse_and_never_better():
    totals = [replace(GOOD, seconds=s).scores(TOOL, 3).total for s in (5.0, 40.0, 80.0, 400.0)]
    assert totals == sorted(totals, reverse=True) and totals[0] > totals[-1]
    assert part(replace(GOOD, seconds=400.0).scores(TOOL, 3), "time") == 0.0


def test_the_right_fault_at_the_wrong_touch_is_worth_a_part():
    entries = GOOD.does(BENT, 3).entries[1:]
    last = entries[-1]
    values = []
    for answer, number in (
        ("bent_tip", last.action.number),
        ("bent_tip", 9),
        ("nothing", last.action.number),
    ):
        ended = msgspec.structs.replace(last, action=Finish(answer, number))
        values.append(part(score(BENT, (*entries[:-1], ended)), "answer"))
    assert values == [1.0, pytest.approx(0.7), 0.0]


def test_doing_nothing_is_worth_nothing_however_quick():
    for chosen in exercises().values():
        session = Session()
        session.do(begin(chosen, 3, 0.0))
        session.do(Finish())
        if not draw_answers_nothing(chosen):
            assert score(chosen, session.entries[1:]).total == 0.0, chosen.key


def draw_answers_nothing(chosen):
    """An active tool that is there from the start is a result of its own."""
    return chosen.hidden.active == "right"


def test_giving_up_scores_nothing_and_says_so():
    session = Session()
    session.do(begin(TOOL, 3, 0.0))
    session.do(Finish(given_up=True))
    card = score(TOOL, session.entries[1:])
    assert card.given_up and card.total == 0.0 and card.advice == ()


def test_an_unfinished_attempt_has_no_score():
    session = Session()
    session.do(begin(TOOL, 3, 0.0))
    with pytest.raises(InputError, match="not finished"):
        score(TOOL, last_attempt(session.entries))
    assert last_attempt(session.entries[:1]) == ()
    with pytest.raises(InputError):
        score(TOOL, ())


def test_only_the_newest_attempt_counts():
    session = GOOD.does(TOOL, 1)
    session.do(begin(TOOL, 2, 5.0))
    session.do(Finish())
    attempt = last_attempt(session.entries)
    assert attempt[0].action.seed == 2 and len(attempt) == 2


def test_the_way_counts_what_lies_between_two_rests():
    session = Session()
    session.do(begin(TOOL, 3, 0.0))
    q = np.array(session.state.q)
    there = q + 0.3
    session.do(Move(as_tuple(q + 0.01), path=(as_tuple(there), as_tuple(q))))
    session.do(Finish())
    long = score(TOOL, session.entries[1:]).figures["travel_m"]
    direct = travel(draw(TOOL, 3).world, np.array([q, q + 0.01])).length
    assert long > 5 * direct


def test_coming_near_the_table_is_a_near_miss_each_time():
    world = draw(TOOL, 3).world
    above = world.touch(world.robot.home, np.random.default_rng(0)).q
    from app.geometry import Pose

    def at(height):
        tip = world.tip(above)
        down = np.array([0.12, 0.12, height + world.table_height - tip.position[2]])
        return world._go(above, Pose.of(tip.rotation, tip.position + down)).q

    high, low = at(from_mm(150.0)), at(from_mm(4.0))
    assert travel(world, np.array([high, high])).near == 0
    found = travel(world, np.array([high, low, high, low, low]))
    assert found.near == 2 and found.closest < from_mm(10.0)


def test_a_spike_is_pushed_before_its_touch_and_stays_there():
    chosen = exercise("spike_moved")
    truth = draw(chosen, 3)
    places = [at_touch(truth, n).p_base_spike for n in range(1, 8)]
    moved = [not np.array_equal(places[0], p) for p in places]
    assert moved == [n >= truth.number for n in range(1, 8)]
    assert np.isclose(np.linalg.norm(places[-1] - places[0]), from_mm(3.5))


def test_the_true_tool_of_a_faulty_arm_is_the_tool_and_not_the_fault():
    truth = draw(exercise("joint_three"), 3)
    assert np.allclose(true_tool(truth, 5).matrix, truth.world.T_flange_tool_true.matrix, atol=1e-12)
    bent = draw(BENT, 3)
    moved = true_tool(bent, 9).position - true_tool(bent, 1).position
    assert from_mm(2.5) < np.linalg.norm(moved) < from_mm(4.0)


def test_the_controller_reckons_with_the_wrong_tool_until_another_is_accepted():
    chosen = exercise("wrong_tool_active")
    session = Session()
    session.do(begin(chosen, 3, 0.0))
    world = world_of(session.state)
    off = np.linalg.norm(world.T_flange_tool_hand.position - world.T_flange_tool_true.position)
    assert np.isclose(off, from_mm(14.0))
    session = GOOD.does(chosen, 3)
    assert world_of(session.state) is None


def test_advice_names_what_was_done_badly():
    alike = replace(GOOD, tilts=ALIKE).scores(TOOL, 2)
    assert "tilt" in [a.code for a in alike.advice]
    short = replace(GOOD, stroke=0.012).scores(exercise("tool_with_axes"), 2)
    assert "stroke" in [a.code for a in short.advice]
    assert [a.code for a in GOOD.scores(TOOL, 2).advice] == ["well"]


def test_history_is_kept_by_trainee_and_exercise_in_its_order(tmp_path):
    store = Store(tmp_path)
    records = Records(store.database)
    cards = [replace(GOOD, seconds=s).scores(TOOL, 3) for s in (300.0, 5.0)]
    for card in cards:
        records.add("Ada", "s", card)
    records.add("Bob", "s", GOOD.scores(BENT, 1))
    again = Records(Store(tmp_path).database)
    assert again.history("Ada", "first_tool") == cards and again.history("Ada", "bent_tip") == []
    assert best_of(again.history("Ada")) == {"first_tool": max(c.total for c in cards)}
    assert len(again.history("Bob")) == 1
    assert (again.trainee_of("s"), again.trainee_of("t")) == ("Bob", "")


@pytest.mark.parametrize(
    "change, words",
    [
        (("difficulty = 3", "difficulty = 9"), "1 to 5"),
        (('robot = "jby50"', 'robot = "jby5"'), "jby50"),
        (("touches = 6", "touches = 99"), "99 touches"),
        (('answer = "bent_tip"', 'answer = "gremlins"'), "gremlins"),
        (("[words.zh]", "[words.de]"), "words.zh"),
        (("touches = 6", "touche = 6"), "touche"),
        (("[words.en]", "[words.en"), "not an exercise"),
    ],
)
def test_a_file_that_cannot_be_is_named_in_one_line(tmp_path, change, words):
    from app.training.exercise import FOLDER

    text = (FOLDER / "bent_tip.toml").read_text(encoding="utf-8")
    assert change[0] in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(*change), encoding="utf-8")
    with pytest.raises(FileFormatError, match=words) as caught:
        read_exercise(path)
    assert str(path) in str(caught.value) and "\n" not in str(caught.value)
