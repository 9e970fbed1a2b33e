"""What is hidden in an exercise is nowhere in what the page receives before the end: every byte of both its sockets
is searched.

The search knows the encodings in which numbers are sent (binary float32 and float64, either byte order, and text).
That it can find something is shown on numbers that are sent, and on the truth itself once the exercise has ended.
"""

import struct
import time

import msgspec
import numpy as np
import pytest
import zstandard

from app.geometry import Pose, exp_so3
from app.kinematics import solve_ik
from app.session import Store
from app.session.actions import Accept, Calculate, Finish, Record
from app.session.state import as_tuple
from app.shell.server import PendantServer
from app.training.attempt import last_attempt
from app.training.cell import at_touch, begin, true_tool
from app.training.exercise import exercise
from app.training.score import score
from app.training.tracker import tracker_truth
from app.training.truth import BESIDE, truth_of
from app.units import from_deg
from tests.desk import Desk, until
from tests.shell.hand import Hand
from tests.training.trainee import FAR

pytestmark = pytest.mark.xdist_group("pendant_server")

PATIENCE_S = 120.0  # a slow machine goes round the spike slowly
SEED = 271828182845904
TRIED = ("tool_with_axes", "spike_moved", "bent_tip", "wrong_tool_active", "joint_three")
_DIGITS = 3  # digits after the point from which on a number in mm or degrees would give something away


class Tap(Hand):
    """A page that keeps every byte it receives."""

    def __init__(self, port):
        self.texts, self.buffers, self.packets = [], [], []
        self._unpack = zstandard.ZstdDecompressor()
        super().__init__(port, scene=True)

    def heard(self, text):
        self.texts.append(text.encode())

    def framed(self, frame):
        size, packed = int.from_bytes(frame[:8], "little"), int.from_bytes(frame[8:16], "little")
        text = self._unpack.decompress(frame[16 : 16 + packed], max_output_size=size)
        start = 16 + packed
        buffer = frame[start + -start % 8 :]  # buffers begin at multiples of eight
        self.texts.append(text)
        self.buffers.append(buffer)
        self.packets.append((text, buffer))

    def holds(self, value):
        """How a number was received: the encodings it was found in."""
        everything = b"".join(self.texts) + b"".join(self.buffers)
        return [name for name, code in encodings(value).items() if code in everything]

    def meshes(self):
        """name -> vertices (n, 3), of everything that was drawn."""
        found = {}
        for text, buffer in self.packets:
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
    # As many digits in all for metres as for millimetres: four of them stand in any long stream by chance.
    decimals = _DIGITS + 1 + 3 * (abs(value) < 2.0)
    return codes | {"repr": repr(float(value)).encode(), "digits": f"{value:.{decimals}f}".encode()}


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
def served(tmp_path, brisk, patient):
    server = PendantServer(Store(tmp_path), port=0, robot="jby50")
    tap = Tap(server.port)
    until(lambda: server.lives and tap.widgets and tap.buffers, "the page")
    desk = Desk(server.lives[0])
    desk.drive.override = 1.0
    desk.idle()
    desk.context.rng = np.random.default_rng(5)
    yield tap, desk
    tap.close()
    server.stop()


def work(desk, chosen):
    """Everything the page offers: touches, a result, the turn, the proposed touch, views, a drag."""
    desk.does(lambda: desk.context.do(begin(chosen, SEED, time.time())))
    context = desk.context
    robot = context.model
    upright = desk.context.world.hand(robot.home).rotation
    origin = robot.home
    for number, step in enumerate(desk.context.session.state.steps):
        world, touched = desk.context.world, None
        if "touch" in step.roles:
            for tilt in FAR[number:] + FAR:
                aim = Pose.of(upright @ exp_so3(from_deg(np.array(tilt, float))), world.p_base_spike_drawn)
                near = solve_ik(robot, aim, robot.home, T_flange_tool=world.T_flange_tool_hand, max_steps=300)
                touched = world.touch(near.q, desk.context.rng)
                if touched.reached:
                    break
        else:
            touched = world.stroke(origin, "xyz".index(step.role), 0.12, desk.context.rng)
        assert touched is not None and touched.reached
        origin = touched.q
        desk.moves(lambda q=touched.q: context.go(q))
        desk.does(lambda key=step.key: desk.context.do(Record(key, as_tuple(desk.context.q))))
    for name in ("close", "side", "front", "whole"):
        desk.does(lambda name=name: desk.context.stage.view(name))
    if chosen.goal == "tool":
        desk.does(lambda: desk.context.do(Calculate()))
        desk.does(lambda: desk.context.do(Accept()))
        view = desk.view("deciding")
        desk.does(view.deciding.verifying.run)
        with desk.holding():
            until(lambda: view.deciding.verifying._done, "the turn", PATIENCE_S)
            desk.rests()
    aim = desk.context.world.hand(desk.context.q)
    above = Pose.of(aim.rotation, aim.position + np.array([0.0, 0.0, 0.03]))
    with desk.holding():
        context.following.event("update", above)
        time.sleep(0.3)
        context.following.event("end", above)
        desk.rests()
    time.sleep(0.5)  # what is still under way


@pytest.mark.parametrize("key", TRIED)
def test_nothing_hidden_is_received_before_the_end(served, key):
    tap, desk = served
    chosen = exercise(key)
    work(desk, chosen)
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
    tap, desk = served
    chosen = exercise("tool_with_axes")
    work(desk, chosen)
    world = desk.context.world
    hand = world.hand(desk.context.q)
    assert "<f" not in tap.holds(hand.position[0]) and tap.holds(hand.position[0])  # the handle
    picture = truth_of(chosen.key, SEED).world.picture
    assert picture is not None
    drawn = picture.T_flange_tool.position
    tool = np.concatenate([v for name, v in tap.meshes().items() if "/flange/tool" in name])
    assert np.linalg.norm(tool - drawn, axis=1).min() < 2.0 * BESIDE

    numbers = true_tool(truth_of(chosen.key, SEED), 9).position * 1e3
    told = ", ".join(f"{v:.2f}" for v in numbers).encode()
    assert told not in b"".join(tap.texts)
    desk.finish()
    until(lambda: told in b"".join(tap.texts), "the score card")


def test_a_session_in_an_exercise_is_not_exported(served):
    tap, desk = served
    chosen = exercise("tool_with_axes")
    desk.does(lambda: desk.context.do(begin(chosen, SEED, time.time())))
    view = desk.view("_export")
    desk.does(view._fill)
    desk.does(view._export)
    assert desk.context.log[-1][1] == "warning"
    time.sleep(0.3)
    assert str(SEED).encode() not in b"".join(tap.texts) + b"".join(tap.buffers)
    desk.does(lambda: desk.context.do(Finish()))
    assert score(chosen, last_attempt(desk.context.session.entries)).total == 0.0


def test_the_second_robots_place_is_received_nowhere_before_the_end(served):
    tap, desk = served
    chosen = exercise("tracker_was_moved")
    desk.does(lambda: desk.context.do(begin(chosen, SEED, time.time())))
    view = desk.view("run")
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
                    run.pose(arm, run.now.posture(arm, step.axis, float(angle)))
                    run.measure()
            run.leave()
            view.show()
        view.finish(run)

    desk.does(measure)
    desk.moves(view._meet)
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
    desk.finish()
    told = ", ".join(f"{v:.2f}" for v in truth.cell.T_base1_base2.position * 1e3).encode()
    until(lambda: told in b"".join(tap.texts), "the score card")
