"""Before a capture: what it would bring, as numbers and as a ghost; after accepting: the turn about the tool point."""

import threading
import time

import numpy as np

from app.calibration.modes import mode
from app.calibration.next_touch import predicted_error, propose
from app.kinematics import load_robot
from app.pendant.aids import Aids
from app.pendant.guarding import hit
from app.pendant.screens._tool import next_touch, verifying
from app.session.actions import Accept, Calculate, Cancel, ChooseMode, Enter, Move, Record
from app.session.state import as_tuple
from app.simulation.guard import Stop
from app.simulation.world import default_world
from app.units import from_mm, mm
from tests.pendant.test_server import pytestmark, until  # noqa: F401  (same worker)
from tests.pendant.tool.conftest import plain
from tests.session.wizard import wizard_actions

AT_SPIKE = from_mm(0.05)
SEARCH_S, PROMPT_S = 20.0, 10.0  # a busy machine may be slow, but not as slow as the search


def touches(desk, count):
    """The first touches of a wizard's work, recorded."""
    actions = wizard_actions("ur10e", world=desk.pendant.world)[0]
    stands = [action.q for action in actions if isinstance(action, Move)]
    for number, q in enumerate(stands[:count], 1):
        record = Record(f"touch{number}", q)
        desk.does(lambda record=record: desk.pendant.do(record))


def proposal(desk):
    until(lambda: desk.view._next_touch.proposal is not None, "the proposal")
    assert desk.pendant.worker.idle()
    return desk.view._next_touch.proposal


def test_the_ghost_is_reachable_free_of_collision_and_at_the_spike_and_the_arm_goes_there(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.pendant.do(ChooseMode("touch", 4)))
    touches(desk, 2)
    found, pendant = proposal(desk), desk.pendant
    assert pendant.model.within_limits(found.q)
    assert hit(pendant.world, found.q) is None
    assert pendant.world.distance(found.q) < AT_SPIKE
    assert pendant.stage.next_arm.visible and not desk.view._next_touch._go.disabled
    desk.does(desk.view._next_touch.go)
    until(lambda: np.allclose(pendant.q, found.q), "the arm where the ghost stands")
    assert pendant.worker.idle()
    assert not pendant.stage.next_arm.visible  # it would only blur the arm


def test_the_lines_say_now_here_and_at_the_ghost(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.pendant.do(ChooseMode("touch", 5)))
    touches(desk, 3)
    found = proposal(desk)
    made = np.array([c.T_base_flange.rotation for c in desk.state.ordered])
    here = predicted_error(np.concatenate([made, desk.pendant.model.forward(desk.pendant.q).rotation[None]]))
    said = plain(desk.view._next_touch._lines.content)
    for value in (found.now, here, found.after, found.at_end):
        assert f"± {mm(value):.2f} mm" in said
    assert found.at_end < found.after < found.now
    q = desk.pendant.q.copy()
    q[5] += 1.0
    desk.does(lambda: desk.pendant.place(q))
    assert (
        plain(desk.view._next_touch._lines.content) != said
    )  # what a touch here would bring follows the arm


def test_a_slow_search_does_not_hold_the_pendant_up_and_a_late_answer_is_not_shown(desk, monkeypatch):
    gate, asked = threading.Event(), []

    def slow(rotations, **rest):
        asked.append(len(rotations))
        if len(rotations) == 1:
            gate.wait(SEARCH_S)
        return propose(rotations, **rest)

    desk.fresh(robot="ur10e").does(lambda: desk.pendant.do(ChooseMode("touch", 4)))
    monkeypatch.setattr(next_touch, "propose", slow)
    touches(desk, 1)
    until(lambda: 1 in asked, "the slow search")
    start = time.monotonic()
    q = as_tuple(desk.pendant.q + 0.2)
    desk.does(lambda: desk.pendant.do(Record("touch2", q)))
    assert time.monotonic() - start < PROMPT_S
    newest = proposal(desk)
    gate.set()
    time.sleep(0.5)
    assert desk.pendant.worker.idle()
    assert desk.view._next_touch.proposal is newest


def test_an_exercise_without_the_aid_shows_no_ghost(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.pendant.allow(Aids(next_touch=False)))
    assert not desk.pendant.stage.next_arm.visible and not desk.view._next_touch._go.visible
    desk.does(lambda: desk.pendant.allow(Aids()))


def test_verifying_draws_the_trace_says_the_wander_and_gives_way_when_the_arm_is_moved(desk, brisk):
    desk.fresh(robot="ur10e").does(lambda: desk.pendant.do(ChooseMode("touch", 4)))
    touches(desk, 4)
    desk.does(lambda: desk.pendant.do(Calculate()))
    desk.does(lambda: desk.pendant.do(Accept("torch")))
    desk.does(desk.view.deciding.verifying.run)
    until(lambda: desk.view.deciding.verifying._done, "the turn")
    assert desk.pendant.worker.idle(30.0)
    found, stage = desk.view.deciding.verifying.found, desk.pendant.stage
    assert stage.trace.drawn and not stage.handle.visible
    off = np.linalg.norm(desk.state.result.result.tool_point - desk.pendant.world.T_flange_tool_true.position)
    assert 0.0 < found.wander <= 2.0 * np.sin(np.radians(45.0) / 2) * off + from_mm(0.01)
    assert f"{mm(found.wander):.2f} mm" in plain(desk.view.deciding.verifying._text.content)
    desk.does(lambda: desk.pendant.place(desk.pendant.q + 0.1))
    assert not stage.trace.drawn and stage.handle.visible


def test_a_pose_in_the_fence_is_neither_proposed_nor_turned_at():
    world = default_world(load_robot("ur10e"))
    assert hit(world, world.robot.home) is None
    stretched = (np.array([turn, -0.6, 0.1, 0.0, 0.0, 0.0]) for turn in np.linspace(-np.pi, np.pi, 30))
    assert any(stop and stop.b == "fence" for q in stretched for stop in [hit(world, q)])


def test_a_turn_that_would_hit_something_is_not_made_and_what_is_said(desk, monkeypatch):
    desk.fresh(robot="ur10e").does(lambda: desk.pendant.do(ChooseMode("touch", 4)))
    touches(desk, 4)
    desk.does(lambda: desk.pendant.do(Calculate()))
    desk.does(lambda: desk.pendant.do(Accept("torch")))
    stands = desk.pendant.q.copy()
    monkeypatch.setattr(verifying, "hit", lambda world, q: Stop("hit", q, "forearm", "fence"))
    desk.does(desk.view.deciding.verifying.run)
    until(lambda: "the forearm would hit the fence" in desk.pendant.log[-1][2], "the refusal")
    assert desk.view.deciding.verifying.found is None and np.array_equal(desk.pendant.q, stands)


def test_a_typed_tool_is_verified_without_a_prediction(desk, brisk):
    desk.fresh(robot="ur10e").does(lambda: desk.pendant.do(ChooseMode("direct")))
    true = desk.pendant.world.T_flange_tool_true
    wrong = as_tuple(true.position + np.array([0.0, 0.0, from_mm(3.0)]))
    desk.does(lambda: desk.pendant.do(Enter(wrong, as_tuple(true.quaternion), "quaternion")))
    desk.does(lambda: desk.pendant.do(Calculate()))
    desk.does(lambda: desk.pendant.do(Accept("drawn")))
    desk.does(desk.view.deciding.verifying.run)
    until(lambda: desk.view.deciding.verifying._done, "the turn")
    said = plain(desk.view.deciding.verifying._text.content)
    assert "wandered" in said and "predicted (" not in said and "nan" not in said
    assert desk.view.deciding.verifying.found.wander > from_mm(1.0)
    desk.does(lambda: desk.pendant.do(Cancel()))
    assert mode("direct").default_touches == 0 and not desk.pendant.stage.trace.drawn
