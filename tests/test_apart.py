"""A job in a process of its own: what it may use is bounded, and what it says comes back whole."""

import ctypes
import os
import threading
import time

import numpy as np
import pytest

from app.apart import Bounds, GivenUpError, apart
from app.errors import DegenerateGeometryError, InputError, UnknownNameError
from app.kinematics import load_robot
from app.session.refusals import refusal

GIB = 1 << 30
SOON_S = 20.0  # a busy machine starts a process slowly
WIDE = Bounds(seconds=60, patience=60.0, memory=GIB, seats=2)


def say_and_add(first, second, say):
    say(0.25, "one")
    say(0.75, "two")
    return first + second


def raise_unknown():
    raise UnknownNameError("ur10x", available=["ur10e"], what="robot", file="a.csv", row=3)


def raise_degenerate():
    raise DegenerateGeometryError("flat", rank=2, needed=3, advice="tilt")


def refuse():
    raise refusal("touches", mode="touch", least=3, most=9, given=2)


def turn_for_ever():
    while True:
        pass


def take_memory(size):
    return len(bytearray(size))


def crash():
    ctypes.string_at(0)


def fault():
    raise KeyError("inside")


def note_and_sleep(path):
    path.write_text(str(os.getpid()))
    time.sleep(600.0)


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_it_says_how_far_it_is_and_gives_its_result_back():
    said = []
    assert apart(say_and_add, 2, 3, bounds=WIDE, say=lambda *what: said.append(what)) == 5
    assert said == [(0.25, "one"), (0.75, "two")]


def test_errors_come_back_with_all_they_carry():
    with pytest.raises(UnknownNameError) as found:
        apart(raise_unknown, bounds=WIDE)
    assert found.value.available == ["ur10e"] and found.value.row == 3
    assert (
        str(found.value) == "a.csv, row 3: unknown robot 'ur10x' (did you mean ur10e?); expected one of ur10e"
    )
    with pytest.raises(DegenerateGeometryError) as flat:
        apart(raise_degenerate, bounds=WIDE)
    assert (flat.value.rank, flat.value.needed, flat.value.advice) == (2, 3, "tilt")
    with pytest.raises(Exception, match="takes 3 to 9 touches") as refused:
        apart(refuse, bounds=WIDE)
    assert refused.value.code == "touches" and refused.value.details["least"] == 3


def test_a_fault_that_is_no_persons_is_no_persons_error():
    with pytest.raises(RuntimeError, match="KeyError: 'inside'"):
        apart(fault, bounds=WIDE)


def test_what_turns_for_ever_is_ended_by_the_kernel():
    begun = time.monotonic()
    with pytest.raises(InputError, match="longer than 1 s of the processor"):
        apart(turn_for_ever, bounds=Bounds(seconds=1, patience=120.0, memory=GIB, seats=1))
    assert time.monotonic() - begun < SOON_S


def test_what_sleeps_for_ever_is_ended_by_the_clock(tmp_path):
    with pytest.raises(InputError, match="longer than"):
        apart(note_and_sleep, tmp_path / "pid", bounds=Bounds(9, patience=3.0, memory=GIB, seats=1))
    assert not alive(int((tmp_path / "pid").read_text()))


def test_what_wants_more_memory_than_it_may_have_is_told_so():
    assert apart(take_memory, GIB // 4, bounds=WIDE) == GIB // 4
    with pytest.raises(InputError, match="more than 1 GB of memory"):
        apart(take_memory, 3 * GIB, bounds=WIDE)


def test_what_ends_its_process_ends_nothing_else():
    with pytest.raises(InputError, match="the process that read it died"):
        apart(crash, bounds=WIDE)
    assert apart(take_memory, 8, bounds=WIDE) == 8


def test_what_is_given_up_is_gone_when_the_caller_hears_of_it(tmp_path):
    stop, note = threading.Event(), tmp_path / "pid"

    def give_up():
        while not (note.exists() and note.read_text()):
            time.sleep(0.01)
        stop.set()

    threading.Thread(target=give_up).start()
    with pytest.raises(GivenUpError):
        apart(note_and_sleep, note, bounds=WIDE, stop=stop)
    assert not alive(int(note.read_text()))


def test_what_waits_for_a_seat_can_be_given_up(tmp_path):
    narrow, first, second = Bounds(9, 60.0, GIB, seats=1), threading.Event(), threading.Event()
    holder = threading.Thread(target=_quietly, args=(narrow, tmp_path / "pid", first))
    holder.start()
    while not (tmp_path / "pid").exists():
        time.sleep(0.01)
    second.set()
    with pytest.raises(GivenUpError):
        apart(take_memory, 8, bounds=narrow, stop=second)
    first.set()
    holder.join()
    assert apart(take_memory, 8, bounds=narrow) == 8


def _quietly(bounds, note, stop):
    with pytest.raises(GivenUpError):
        apart(note_and_sleep, note, bounds=bounds, stop=stop)


def test_a_robot_is_the_same_robot_there_and_back():
    robot = load_robot("ur10e")
    back = apart(_same, robot, bounds=WIDE)
    assert np.array_equal(back.forward(robot.home).matrix, robot.forward(robot.home).matrix)
    assert back.name == robot.name and back.address == robot.address


def _same(robot):
    return robot
