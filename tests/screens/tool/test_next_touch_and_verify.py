"""Before a capture: what it would bring, as numbers and as a ghost; after accepting: the turn about the tool point."""

import threading
import time
from dataclasses import replace

import numpy as np

from app.calibration.modes import mode
from app.calibration.next_touch import predicted_error, propose
from app.geometry import Pose
from app.kinematics import load_robot
from app.screens._tool import next_touch, verifying
from app.screens.aids import Aids
from app.session.actions import Accept, Calculate, Cancel, ChooseMode, Enter, Move, Record
from app.session.motion.guarding import hit
from app.session.state import as_tuple
from app.simulation.guard import Stop
from app.simulation.route import route
from app.simulation.world import default_world
from app.units import from_mm, mm
from tests.desk import plain, until
from tests.session.wizard import wizard_actions

AT_SPIKE = from_mm(0.05)
SEARCH_S, PROMPT_S = 20.0, 10.0  # a busy machine may be slow, but not as slow as the search


def touches(desk, count):
    """The first touches of a wizard's work, recorded."""
    actions = wizard_actions("ur10e", world=desk.context.world)[0]
    stands = [action.q for action in actions if isinstance(action, Move)]
    for number, q in enumerate(stands[:count], 1):
        record = Record(f"touch{number}", q)
        desk.does(lambda record=record: desk.context.do(record))


def proposal(desk):
    until(lambda: desk.tool._next_touch.proposal is not None, "the proposal")
    desk.idle()
    return desk.tool._next_touch.proposal


def test_the_ghost_is_reachable_free_of_collision_and_at_the_spike_and_the_arm_goes_there(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    touches(desk, 2)
    found, context = proposal(desk), desk.context
    assert context.model.within_limits(found.q)
    assert hit(context.world, found.q) is None
    assert context.world.distance(found.q) < AT_SPIKE
    assert context.stage.next_arm.visible and not desk.tool._next_touch.go_button.disabled
    desk.live.choose("screen", "sessions")  # where nothing is touched, no ghost stands about
    desk.idle()
    assert not context.stage.next_arm.visible
    desk.live.choose("screen", "tool")
    desk.idle()
    assert context.stage.next_arm.visible
    desk.moves(desk.tool._next_touch.go)
    assert np.allclose(desk.q, found.q)
    assert context.worker.idle()
    assert not context.stage.next_arm.visible  # it would only blur the arm


def test_a_ghost_within_the_spike_is_gone_to_as_near_as_the_way_is_free(desk):
    """One exercise in twenty ended here: no way there was free, and the key to the ghost stood out again and again."""
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    found, context, view = proposal(desk), desk.context, desk.tool._next_touch
    tip = context.world.tip(found.q)
    deep = Pose.of(tip.rotation, tip.position + 0.012 * tip.rotation[:, 2])
    within = context.world.bring(found.q, deep).q
    assert route(context.world, context.drive.guard, context.q, within).kind == "press"
    desk.does(lambda: (setattr(view, "proposal", replace(found, q=within)), setattr(view, "goal", within)))
    desk.moves(view.go)
    assert 0.005 < context.world.distance(desk.q) < 0.05 and "just before the ghost" in desk.said[1]
    assert desk.tool._assist.rank == "main" and view.go_button.rank == "plain"
    desk.moves(desk.tool._help)
    assert context.world.touching(desk.q) and desk.tool._record.rank == "main"


def test_the_lines_say_now_here_and_at_the_ghost(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 5)))
    touches(desk, 3)
    found = proposal(desk)
    made = np.array([c.T_base_flange.rotation for c in desk.state.ordered])
    here = predicted_error(np.concatenate([made, desk.context.model.forward(desk.context.q).rotation[None]]))
    said = plain(desk.tool._next_touch._lines.content)
    for value in (found.now, here, found.after, found.at_end):
        assert f"± {mm(value):.2f} mm" in said
    assert found.at_end < found.after < found.now
    q = desk.context.q.copy()
    q[5] += 1.0
    desk.place(q)
    assert (
        plain(desk.tool._next_touch._lines.content) != said
    )  # what a touch here would bring follows the arm


def test_a_slow_search_does_not_hold_the_pendant_up_and_a_late_answer_is_not_shown(desk, monkeypatch):
    gate, asked = threading.Event(), []

    def slow(rotations, **rest):
        asked.append(len(rotations))
        if len(rotations) == 1:
            gate.wait(SEARCH_S)
        return propose(rotations, **rest)

    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    monkeypatch.setattr(next_touch, "propose", slow)
    touches(desk, 1)
    until(lambda: 1 in asked, "the slow search")
    start = time.monotonic()
    q = as_tuple(desk.context.q + 0.2)
    desk.does(lambda: desk.context.do(Record("touch2", q)))
    assert time.monotonic() - start < PROMPT_S
    newest = proposal(desk)
    gate.set()
    time.sleep(0.5)
    desk.idle()
    assert desk.tool._next_touch.proposal is newest


def test_an_exercise_without_the_aid_shows_no_ghost(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.context.allow(Aids(next_touch=False)))
    assert not desk.context.stage.next_arm.visible and not desk.tool._next_touch.go_button.visible
    desk.does(lambda: desk.context.allow(Aids()))


def test_verifying_draws_the_trace_says_the_wander_and_gives_way_when_the_arm_is_moved(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    touches(desk, 4)
    desk.does(lambda: desk.context.do(Calculate()))
    desk.does(lambda: desk.context.do(Accept("torch")))
    desk.does(desk.tool.deciding.verifying.run)
    with desk.holding():
        until(lambda: desk.tool.deciding.verifying._done, "the turn")
    desk.rests()
    found, stage = desk.tool.deciding.verifying.found, desk.context.stage
    assert stage.trace.drawn and not stage.handle.visible
    off = np.linalg.norm(desk.state.result.result.tool_point - desk.context.world.T_flange_tool_true.position)
    assert 0.0 < found.wander <= 2.0 * np.sin(np.radians(45.0) / 2) * off + from_mm(0.01)
    assert f"{mm(found.wander):.2f} mm" in plain(desk.tool.deciding.verifying._text.content)
    assert "Accepted and verified: the tool can be used" in desk.read()
    assert desk.tool.deciding._again.rank == "plain"  # what was done is not what is next
    desk.place(desk.q + 0.1)
    assert not stage.trace.drawn and not stage.handle.visible  # the view is a near one
    desk.does(lambda: stage.view("whole"))
    assert stage.handle.visible


def test_the_light_says_what_is_next_and_not_what_was_done(desk):
    """'Accept, then verify' stood beside the tool that was accepted, also where an exercise waited to be finished."""
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    touches(desk, 4)
    desk.does(lambda: desk.context.do(Calculate()))
    assert "Accept, then verify." in desk.read()
    desk.does(lambda: desk.context.do(Accept("torch")))
    assert "Accept, then" not in desk.read() and "Accepted: now verify by turning" in desk.read()
    desk.does(lambda: desk.context.do(Record("touch1", as_tuple(desk.q))))
    desk.does(lambda: desk.context.do(Calculate()))
    assert "Accepted" not in desk.read()  # another result, which nobody has accepted


def test_a_pose_in_the_fence_is_neither_proposed_nor_turned_at():
    world = default_world(load_robot("ur10e"))
    assert hit(world, world.robot.home) is None
    stretched = (np.array([turn, -0.6, 0.1, 0.0, 0.0, 0.0]) for turn in np.linspace(-np.pi, np.pi, 30))
    assert any(stop and stop.b == "fence" for q in stretched for stop in [hit(world, q)])


def test_a_turn_that_would_hit_something_is_not_made_and_what_is_said(desk, monkeypatch):
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("touch", 4)))
    touches(desk, 4)
    desk.does(lambda: desk.context.do(Calculate()))
    desk.does(lambda: desk.context.do(Accept("torch")))
    stands = desk.context.q.copy()
    monkeypatch.setattr(verifying, "hit", lambda world, q: Stop("hit", q, "forearm", "fence"))
    desk.does(desk.tool.deciding.verifying.run)
    until(lambda: "the forearm would hit the fence" in desk.context.log[-1][2], "the refusal")
    assert desk.tool.deciding.verifying.found is None and np.array_equal(desk.context.q, stands)


def test_a_typed_tool_that_is_off_is_sent_back_though_nothing_was_predicted(desk):
    desk.fresh(robot="ur10e").does(lambda: desk.context.do(ChooseMode("direct")))
    true = desk.context.world.T_flange_tool_true
    wrong = as_tuple(true.position + np.array([0.0, 0.0, from_mm(3.0)]))
    desk.does(lambda: desk.context.do(Enter(wrong, as_tuple(true.quaternion), "quaternion")))
    desk.does(lambda: desk.context.do(Calculate()))
    desk.does(lambda: desk.context.do(Accept("drawn")))
    desk.does(desk.tool.deciding.verifying.run)
    with desk.holding():
        until(lambda: desk.tool.deciding.verifying._done, "the turn")
    said = plain(desk.tool.deciding.verifying._text.content)
    assert "wandered" in said and "nan" not in said
    assert "MORE than 0.75 mm. Teach again" in said and desk.said[0] == "warning"
    assert desk.tool.deciding.verifying.found.wander > from_mm(1.0)
    assert "The turn did not confirm it: teach again" in desk.read()
    again = desk.tool.deciding._again
    assert again.rank == "main" and again.options == ("Teach again", "Verify")
    desk.does(lambda: desk.context.do(Cancel()))
    assert mode("direct").default_touches == 0 and not desk.context.stage.trace.drawn
