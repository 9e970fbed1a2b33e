"""What is hidden in an exercise is nowhere in what the browser receives before the end: every byte of it is searched.

The search knows the encodings in which viser sends numbers (binary float32 and float64, either byte order, and text).
That it can find something is shown on numbers that are sent, and on the truth itself once the exercise has ended.
"""

import struct
import time

import msgspec
import numpy as np
import pytest

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.pendant.server import PendantServer
from app.session import Store
from app.session.actions import Accept, Calculate, Finish, Record
from app.session.state import as_tuple
from app.training.attempt import last_attempt
from app.training.cell import at_touch, begin, true_tool
from app.training.exercise import exercise
from app.training.score import score
from app.training.tracker import tracker_truth
from app.training.truth import BESIDE, truth_of
from app.units import from_deg
from benchmarks._browser import Browser
from tests.training.trainee import FAR

pytestmark = pytest.mark.xdist_group("pendant_server")

PATIENCE_S = 120.0  # a slow machine goes round the spike slowly
SEED = 271828182845904
TRIED = ("tool_with_axes", "spike_moved", "bent_tip", "wrong_tool_active", "joint_three")
_DIGITS = 3  # digits after the point from which on a number in mm or degrees would give something away


class Tap(Browser):
    """A browser that keeps every byte it receives."""

    def __init__(self, port):
        self.texts, self.buffers = [], []
        super().__init__(port)

    def _text(self, data, unpack):
        text = super()._text(data, unpack)
        self.texts.append(text)
        start = 16 + int.from_bytes(data[8:16], "little")
        self.buffers.append(data[start + -start % 8 :])  # buffers begin at multiples of eight
        return text

    def holds(self, value):
        """How a number was received: the encodings it was found in."""
        everything = b"".join(self.texts) + b"".join(self.buffers)
        return [name for name, code in encodings(value).items() if code in everything]

    def meshes(self):
        """name -> vertices (n, 3), of everything that was drawn."""
        found = {}
        for text, buffer in zip(self.texts, self.buffers, strict=True):
            packet = msgspec.msgpack.decode(text)
            lengths = packet.get("binaryBufferLengths", ())
            starts = np.cumsum([0, *(n + -n % 8 for n in lengths)])
            for message in packet["messages"]:
                if message["type"] == "MeshMessage":
                    k = message["props"]["vertices"]["__binary_index"]
                    part = buffer[starts[k] : starts[k] + lengths[k]]
                    found.setdefault(message["name"], []).append(np.frombuffer(part, "<f4").reshape(-1, 3))
        return {name: np.concatenate(parts) for name, parts in found.items()}


def encodings(value):
    codes = {f"{order}{kind}": struct.pack(order + kind, value) for order in "<>" for kind in "fd"}
    return codes | {"repr": repr(float(value)).encode(), "digits": f"{value:.{_DIGITS + 1}f}".encode()}


def hidden_numbers(chosen):
    """Everything nobody may be told, in SI and in the units of the screen, by name."""
    truth = truth_of(chosen.key, SEED)
    numbers = {}
    for row in (1, 9):
        tool, world = true_tool(truth, row), at_touch(truth, row)
        places = {f"tool{row}": tool.position, f"spike{row}": world.p_base_spike}
        if chosen.hidden.tool_turn_deg:
            places[f"turn{row}"] = np.concatenate([tool.quaternion, tool.rotation.ravel()])
        for name, place in places.items():
            for k, value in enumerate(place):
                numbers |= {f"{name}[{k}]": value, f"{name}[{k}] mm": 1e3 * value}
    for k, value in enumerate(truth.spike_shift):
        numbers |= {f"shift[{k}]": value, f"shift[{k}] mm": 1e3 * value}
    for fault in truth.world.faults:
        for name, value in fault.values.items():
            numbers |= {name: value, f"{name} mm": 1e3 * value, f"{name} deg": np.degrees(value)}
    return {name: float(v) for name, v in numbers.items() if abs(v) > 1e-9}


@pytest.fixture
def served(tmp_path, brisk):
    server = PendantServer(Store(tmp_path), port=0, robot="jby50")
    tap = Tap(server.port)
    until(lambda: server.pendants and hasattr(server.pendants[0], "page"), "the pendant")
    pendant = server.pendants[0]
    pendant.rng = np.random.default_rng(5)
    done(pendant)
    yield tap, pendant
    tap.close()
    server.stop()


def until(true, what):
    end = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < end, f"waited {PATIENCE_S:g} s for {what}"
        time.sleep(0.01)


def done(pendant, job=None):
    if job is not None:
        pendant.post(job)
    assert pendant.worker.idle(PATIENCE_S)


def work(pendant, chosen):
    """Everything the page offers: touches, a result, the turn, the proposed touch, views, a drag."""
    done(pendant, lambda: pendant.do(begin(chosen, SEED, time.time())))
    robot = pendant.model
    upright = pendant.world.hand(robot.home).rotation
    origin = robot.home
    for number, step in enumerate(pendant.session.state.steps):
        world, touched = pendant.world, None
        if "touch" in step.roles:
            for tilt in FAR[number:] + FAR:
                aim = Pose.of(upright @ exp_so3(from_deg(np.array(tilt, float))), world.p_base_spike_drawn)
                near = solve_ik(robot, aim, robot.home, T_flange_tool=world.T_flange_tool_hand, max_steps=300)
                touched = world.touch(near.q, pendant.rng)
                if touched.reached:
                    break
        else:
            touched = world.stroke(origin, "xyz".index(step.role), 0.12, pendant.rng)
        assert touched is not None and touched.reached
        origin = touched.q
        done(pendant, lambda q=touched.q: pendant.go(q))
        done(pendant, lambda key=step.key: pendant.do(Record(key, as_tuple(pendant.q))))
    for name in ("close", "side", "front", "whole"):
        done(pendant, lambda name=name: pendant.stage.view(name))
    if chosen.goal == "tool":
        done(pendant, lambda: pendant.do(Calculate()))
        done(pendant, lambda: pendant.do(Accept()))
        view = next(v for v in pendant.page.views if hasattr(v, "deciding"))
        done(pendant, view.deciding.verifying.run)
        until(lambda: view.deciding.verifying.found is not None, "the turn")
        done(pendant)
    aim = pendant.world.hand(pendant.q)
    above = Pose.of(aim.rotation, aim.position + np.array([0.0, 0.0, 0.03]))
    pendant.dragging.event("update", above)
    pendant.dragging.event("end", above)
    done(pendant)
    time.sleep(0.5)  # what is still under way


@pytest.mark.parametrize("key", TRIED)
def test_nothing_hidden_is_received_before_the_end(served, key):
    tap, pendant = served
    chosen = exercise(key)
    work(pendant, chosen)
    found = {name: how for name, v in hidden_numbers(chosen).items() if (how := tap.holds(v))}
    assert not found, found
    assert str(SEED).encode() not in b"".join(tap.texts)
    assert struct.pack(">Q", SEED) not in b"".join(tap.texts)
    right = truth_of(key, SEED)
    if right.number:  # nor what is wrong, in its own words
        assert right.world.faults == () or right.world.faults[0].effect.encode() not in b"".join(tap.texts)

    meshes = tap.meshes()
    tool = np.concatenate([v for name, v in meshes.items() if "/flange/tool" in name])
    spike = np.concatenate([v for name, v in meshes.items() if name.startswith("/cell/")])
    for row in (1, 9):  # what is drawn is near, for people to see, and beside it on purpose
        drawn = np.linalg.norm(tool - truth_of(key, SEED).world.T_flange_tool_true.position, axis=1).min()
        assert 0.5 * BESIDE < drawn < 4.0 * BESIDE
        assert np.linalg.norm(spike - at_touch(right, row).p_base_spike, axis=1).min() > 0.5 * BESIDE


def test_the_search_finds_what_is_sent_and_the_truth_after_the_end(served):
    tap, pendant = served
    chosen = exercise("tool_with_axes")
    work(pendant, chosen)
    world = pendant.world
    hand = world.hand(pendant.q)
    assert "<f" not in tap.holds(hand.position[0]) and tap.holds(hand.position[0])  # the handle
    picture = truth_of(chosen.key, SEED).world.picture
    assert picture is not None
    drawn = picture.T_flange_tool.position
    tool = np.concatenate([v for name, v in tap.meshes().items() if "/flange/tool" in name])
    assert np.linalg.norm(tool - drawn, axis=1).min() < 2.0 * BESIDE

    numbers = true_tool(truth_of(chosen.key, SEED), 9).position * 1e3
    told = ", ".join(f"{v:.2f}" for v in numbers).encode()
    assert told not in b"".join(tap.texts)
    view = next(v for v in pendant.page.views if hasattr(v, "showing"))
    done(pendant, view._finish)
    until(lambda: told in b"".join(tap.texts), "the score card")


def test_a_session_in_an_exercise_is_not_exported(served):
    tap, pendant = served
    chosen = exercise("tool_with_axes")
    done(pendant, lambda: pendant.do(begin(chosen, SEED, time.time())))
    view = next(v for v in pendant.page.views if hasattr(v, "_export"))
    done(pendant, view._fill)
    done(pendant, view._export)
    assert pendant.log[-1][1] == "warning"
    time.sleep(0.3)
    assert str(SEED).encode() not in b"".join(tap.texts) + b"".join(tap.buffers)
    done(pendant, lambda: pendant.do(Finish()))
    assert score(chosen, last_attempt(pendant.session.entries)).total == 0.0


def test_the_second_robots_place_is_received_nowhere_before_the_end(served):
    tap, pendant = served
    chosen = exercise("tracker_was_moved")
    done(pendant, lambda: pendant.do(begin(chosen, SEED, time.time())))
    view = next(v for v in pendant.page.views if hasattr(v, "run"))
    run, truth = view.run, tracker_truth(chosen.key, SEED)

    def measure():
        while (step := run.wizard.step) is not None:
            arm = step.robot - 1
            if step.kind == "nests":
                for _ in run.cell.nests:
                    run.measure()
            elif step.kind == "zero":
                run.pose(arm, run.now.arms[arm].rest)
                run.measure()
            else:
                for angle in run.now.visible_angles(arm, step.axis, from_deg(20.0), from_deg(60.0)):
                    run.turn_to(float(angle))
                    run.measure()
            run.leave()
            view._show()
        view._finish(run)

    done(pendant, measure)
    done(pendant, view._meet)
    assert run.meeting is not None and run.relation.warnings[0].code == "tracker_moved"
    time.sleep(0.5)
    assert truth.pushed is not None
    secret = {"relation": truth.cell.T_base1_base2.position, "push": truth.pushed.position}
    secret |= {f"robot{k}": arm.T_world_base.position for k, arm in enumerate(truth.cell.arms, 1)}
    secret |= {f"turn{k}": arm.T_world_base.quaternion for k, arm in enumerate(truth.cell.arms, 1)}
    secret |= {"tracker": truth.cell.tracker.T_world_tracker.position, "tips": run.meeting.tips.ravel()}
    found = {
        (name, float(v) * scale): how
        for name, values in secret.items()
        for v in values
        for scale in (1.0, 1e3)
        if abs(v) > 1e-9 and (how := tap.holds(float(v) * scale))
    }
    assert not found, found
    training = next(v for v in pendant.page.views if hasattr(v, "showing"))
    done(pendant, training._finish)
    told = ", ".join(f"{v:.2f}" for v in truth.cell.T_base1_base2.position * 1e3).encode()
    until(lambda: told in b"".join(tap.texts), "the score card")
