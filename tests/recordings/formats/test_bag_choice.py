"""Bags with more than one arm, topic or joint set: joints by name, what was read and left, a choice where two fit."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from app.errors import InputError
from app.recordings.arm import read_with_arm
from app.recordings.formats.rosbag import _without_repeats
from app.recordings.options import ReadOptions
from tests.kinematics.description.making import line, written

COUNT = 60
STATES = "/joint_states"
STORE = get_typestore(Stores.ROS2_HUMBLE)


def header(i, frame=""):
    stamp = STORE.types["builtin_interfaces/msg/Time"](sec=10, nanosec=i * 10_000_000)
    return STORE.types["std_msgs/msg/Header"](stamp=stamp, frame_id=frame)


def state(i, names, scale=1.0):
    q = np.sin(0.1 * i + np.arange(len(names))) * scale
    return STORE.types["sensor_msgs/msg/JointState"](
        header=header(i), name=list(names), position=q, velocity=q * 0, effort=q * 10
    )


def point(i):
    place = STORE.types["geometry_msgs/msg/Point"](x=0.1 * i, y=1.0, z=2.0)
    return STORE.types["geometry_msgs/msg/PointStamped"](header=header(i, "tracker"), point=place)


def bag(folder, *series, repeats=1):
    """Series of (topic, message of a row number), written row by row in the order given."""
    path = folder / "bag"
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        topics = {}
        for i in range(COUNT):
            for topic, make in series:
                message = make(i)
                kind = message.__msgtype__
                if topic not in topics:
                    topics[topic] = writer.add_connection(topic, kind, typestore=STORE)
                for _ in range(repeats):
                    writer.write(topics[topic], 10**9 + i * 10**7, STORE.serialize_cdr(message, kind))
    return path


@pytest.fixture
def robot(tmp_path):
    return str(written(tmp_path, line(2)))


def arm(i):
    return state(i, ("j1", "j2"))


def said(table):
    return " ".join(table.notes)


@pytest.mark.parametrize(
    "series",
    [
        [(STATES, lambda i: state(i, ("knuckle",), 0.1)), (STATES, arm)],
        [("/gripper", lambda i: state(i, ("knuckle",), 0.1))] * 3 + [(STATES, arm)],
        [(STATES, lambda i: state(i, ("j2", "j1")))],
        [(STATES, lambda i: state(i, ("wheel", "j1", "j2", "drive")))],
    ],
    ids=["gripper first", "fast gripper", "other order", "extra joints"],
)
def test_joints_are_found_by_name_wherever_they_stand(tmp_path, robot, series):
    table, _ = read_with_arm(bag(tmp_path, *series), robot)
    names = series[-1][1](0).name
    expected = np.array([series[-1][1](i).position for i in range(COUNT)])
    assert np.allclose(table.numbers(["q1", "q2"]), expected[:, [names.index("j1"), names.index("j2")]])
    assert f"{STATES}: j1, j2 ({COUNT} messages)" in said(table)
    if len(series) > 1 or len(names) > 2:
        assert "Left out" in said(table) and ("knuckle" in said(table) or "wheel, drive" in said(table))


def two(i, side):
    return state(i, (f"{side}_j1", f"{side}_j2"), 1.0 if side == "left" else 0.5)


def test_of_two_arms_one_is_asked_for_and_chosen_by_its_prefix(tmp_path, robot):
    path = bag(tmp_path, (STATES, lambda i: two(i, "right")), (STATES, lambda i: two(i, "left")))
    with pytest.raises(InputError) as caught:
        read_with_arm(path, robot)
    assert "2 sets of joint states fit" in str(caught.value)
    assert "--prefix right_ or --prefix left_" in str(caught.value)
    for side, most in (("left", 1.0), ("right", 0.5)):
        table, _ = read_with_arm(path, robot, ReadOptions(prefix=f"{side}_"))
        assert np.abs(table.numbers(["q1", "q2"])).max() == pytest.approx(most, abs=0.01)


def test_of_two_topics_the_measured_one_is_read_and_the_desired_one_is_what_was_commanded(tmp_path, robot):
    path = bag(tmp_path, ("/joint_states_desired", lambda i: state(i, ("j1", "j2"), 2.0)), (STATES, arm))
    table, _ = read_with_arm(path, robot)
    assert np.allclose(table.numbers(["qc1", "qc2"]), 2 * table.numbers(["q1", "q2"]))
    assert f"Read from {STATES}" in said(table) and "Beside it from /joint_states_desired" in said(table)
    other, _ = read_with_arm(path, robot, ReadOptions(topic="/joint_states_desired"))
    assert np.abs(other.number("q1")).max() > 1.5


def test_two_topics_of_measured_states_are_asked_for(tmp_path, robot):
    path = bag(tmp_path, ("/a/joint_states", arm), ("/b/joint_states", arm))
    with pytest.raises(InputError, match="--topic /a/joint_states or --topic /b/joint_states"):
        read_with_arm(path, robot)
    with pytest.raises(InputError, match="unknown topic"):
        read_with_arm(path, robot, ReadOptions(topic="/c"))


def test_messages_recorded_twice_count_once(tmp_path, robot):
    table, _ = read_with_arm(bag(tmp_path, (STATES, arm), repeats=2), robot)
    assert len(table) == COUNT and np.all(np.diff(table.number("t")) > 0)
    assert f"{COUNT} messages that repeat another" in said(table)


def test_an_arm_that_is_not_in_the_bag_is_answered_with_what_is(tmp_path, robot):
    path = bag(tmp_path, (STATES, lambda i: state(i, ("a", "b", "c"))))
    with pytest.raises(InputError, match="no joint states of this arm; there are /joint_states: a, b, c"):
        read_with_arm(path, robot)


def test_joints_of_other_names_but_the_same_number_are_taken_in_their_order_and_that_is_said(tmp_path, robot):
    table, _ = read_with_arm(bag(tmp_path, (STATES, lambda i: state(i, ("pan", "lift")))), robot)
    assert "No joint bears the description's names" in said(table)


def test_tracked_points_become_a_tracker_recording_with_the_joints_at_their_stamps(tmp_path, robot):
    path = bag(tmp_path, (STATES, arm), ("/points", point))
    table, _ = read_with_arm(path, robot, ReadOptions(mapping={"points": "/points"}))
    assert table.kind == "tracker" and table.number("x")[5] == pytest.approx(0.5)
    assert np.allclose(table.number("q1"), [arm(i).position[0] for i in range(COUNT)])
    motion, _ = read_with_arm(path, robot)
    assert motion.kind == "motion" and "/points" in said(motion)


def test_efforts_stated_as_currents_become_currents_with_their_gains(tmp_path, robot):
    path = bag(tmp_path, (STATES, arm))
    table, _ = read_with_arm(path, robot, ReadOptions(effort="A", drive_gain=(12.0, 10.0)))
    assert table.has("i1", "i2") and not table.has("tau1")
    assert table.keys["drive_gain_Nm_per_A"] == [12.0, 10.0]
    alone, _ = read_with_arm(path, robot, ReadOptions(effort="A"))
    assert "drive_gain_Nm_per_A" not in alone.keys and "motor currents" in said(alone)
    with pytest.raises(InputError, match="--drive-gain with 3 values"):
        read_with_arm(path, robot, ReadOptions(effort="A", drive_gain=(1.0, 2.0, 3.0)))


def test_a_piece_that_unpacks_to_gigabytes_is_refused(tmp_path, monkeypatch):
    from app.recordings.bags import bounded

    path = tmp_path / "bag"
    writer = Writer(path, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        topic = writer.add_connection(STATES, "sensor_msgs/msg/JointState", typestore=STORE)
        writer.write(
            topic, 10**9, STORE.serialize_cdr(state(0, ["x" * 200_000]), "sensor_msgs/msg/JointState")
        )
    monkeypatch.setattr(bounded, "MOST_IN_CHUNK", 100_000)
    with pytest.raises(InputError, match="the bag holds a compressed piece"):
        read_with_arm(path, "ur10e")


def test_temperatures_of_the_joints_become_columns_of_theirs(tmp_path, robot):
    """A message of a topic speaks of one joint, which its frame names; slow ones are brought to the arm's times."""

    def warm(joint):
        kind = STORE.types["sensor_msgs/msg/Temperature"]
        return lambda i: kind(header=header(i, joint), temperature=30.0 + i * int(joint[1:]), variance=0.0)

    path = bag(tmp_path, (STATES, arm), ("/temperature/two", warm("j2")), ("/temperature/one", warm("j1")))
    table, _ = read_with_arm(path, robot)
    assert table.number("temperature1") == pytest.approx(30.0 + np.arange(COUNT))
    assert table.number("temperature2") == pytest.approx(30.0 + 2 * np.arange(COUNT))


def test_temperatures_of_other_things_are_no_joints(tmp_path, robot):
    kind = STORE.types["sensor_msgs/msg/Temperature"]
    path = bag(
        tmp_path,
        (STATES, arm),
        ("/cabinet", lambda i: kind(header=header(i, "cabinet"), temperature=25.0, variance=0.0)),
    )
    table, _ = read_with_arm(path, robot)
    assert not table.has("temperature1")


def test_a_wrench_stands_beside_the_joints(tmp_path, robot):
    def wrench(i):
        three = STORE.types["geometry_msgs/msg/Vector3"]
        both = STORE.types["geometry_msgs/msg/Wrench"](
            force=three(x=0.5 * i, y=1.0, z=2.0), torque=three(x=3.0, y=4.0, z=-0.25 * i)
        )
        return STORE.types["geometry_msgs/msg/WrenchStamped"](header=header(i, "tool"), wrench=both)

    table, _ = read_with_arm(bag(tmp_path, (STATES, arm), ("/wrench", wrench)), robot)
    body = table.body
    assert {"force_x_N", "force_y_N", "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm"} <= set(
        body.columns
    )
    assert body["force_x_N"].to_numpy() == pytest.approx(0.5 * np.arange(COUNT))
    assert body["torque_z_Nm"].to_numpy() == pytest.approx(-0.25 * np.arange(COUNT))


def test_repeats_are_exact_and_not_only_neighbours():
    """One time may hold several messages: of A, B, A, A the last two say nothing new; a missing number is one too."""
    t = np.array([1.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0])
    first = np.array([5.0, 5.0, 6.0, 5.0, 5.0, 7.0, 7.0, 0.0, -0.0])
    second = np.array([1.0, 1.0, 1.0, 1.0, 1.0, np.nan, np.nan, 2.0, 2.5])
    kept = _without_repeats(t, [first, second])
    assert kept.tolist() == [True, True, True, False, False, True, False, True, True]
    assert _without_repeats(np.arange(3.0), [np.zeros(3)]).all()
