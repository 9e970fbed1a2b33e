"""The two-robot procedure in the session: every point is in the journal, nothing is lost, a replay finds the same."""

import numpy as np
import pytest

from app.errors import ActionRefusedError
from app.session import Store, reduce, replay
from app.session.actions import CloseCell, OpenCell, Tracked, TrackerNext, TrackerUndo, Undo
from app.session.report import report_text
from app.session.state import as_tuple, first_state
from app.session.store import find_recorded
from app.simulation.tracker_cell import make_cell
from app.simulation.tracker_procedure import carry_out
from tests.cli.running import teachframe

OPEN = OpenCell("irb120", "ur10e", 5)


@pytest.fixture(scope="module")
def outcome():
    return carry_out(make_cell("irb120", "ur10e", 5), 3, every=np.radians(20))


def actions(outcome):
    """The whole procedure as the screen writes it down."""
    yield OPEN
    for step in outcome.wizard.steps:
        for r in outcome.wizard.of(step.key):
            x, y, z = as_tuple(r.point)
            yield Tracked((x, y, z), r.angle, r.name, r.sigma)
        yield TrackerNext()


def test_a_restart_in_the_middle_loses_nothing_and_the_end_is_the_same(outcome, tmp_path):
    store, todo = Store(tmp_path), list(actions(outcome))
    session = store.create(robot="ur10e")
    for action in todo[: len(todo) // 2]:
        session.do(action)
    before = session.state.two_robots
    session.close()
    session = store.open(session.name)
    again = session.state.two_robots
    assert again.opened == OPEN and again.wizard.index == before.wizard.index
    assert len(again.wizard.records) == len(before.wizard.records) > 5
    for action in todo[len(todo) // 2 :]:
        session.do(action)
    name = session.name
    session.close()
    x, y, z = 1e3 * outcome.relation.T_base1_base2.position
    said = f"base 2 in base 1: {x:.3f}, {y:.3f}, {z:.3f} mm"
    assert said in report_text(replay(find_recorded(name, tmp_path, None)))
    printed = teachframe("replay", name, "--data", tmp_path)
    assert printed.code == 0 and said in printed.out


def test_before_the_end_a_replay_says_what_comes_next(outcome):
    state = first_state("ur10e")
    for action in list(actions(outcome))[:3]:
        state = reduce(state, action)
    assert "2 points measured" in report_text(state)


def test_the_trackers_undo_takes_a_point_back_and_the_wizards_undo_does_not():
    state = reduce(first_state("ur10e"), OPEN)
    state = reduce(state, Tracked((1.0, 2.0, 3.0), name="N1"))
    with pytest.raises(ActionRefusedError):
        reduce(state, Undo())
    assert len(reduce(state, TrackerUndo()).two_robots.wizard.records) == 0


def test_without_a_cell_nothing_is_measured():
    with pytest.raises(ActionRefusedError):
        reduce(first_state("ur10e"), Tracked((1.0, 2.0, 3.0)))
    closed = reduce(reduce(first_state("ur10e"), OPEN), CloseCell())
    assert closed.two_robots is None
    with pytest.raises(ActionRefusedError):
        reduce(first_state("ur10e"), OpenCell("nobody", "ur10e", 1))
