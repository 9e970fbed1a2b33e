"""ROS bags without ROS: what was written comes back, and what is no bag of joint states is refused in one line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from app.errors import InputError
from app.recordings import read_table
from tests.data_folder import data_folder

COUNT = 40
NAMES = ["elbow", "shoulder", "gripper_finger"]
ROUNDED = 1e-4  # the CSV of the same messages is written with four to six digits


def _message(store, i, *, ros1=False, effort=True):
    stamp = store.types["builtin_interfaces/msg/Time"](sec=10 + i // 100, nanosec=(i % 100) * 10_000_000)
    extra = {"seq": i} if ros1 else {}
    header = store.types["std_msgs/msg/Header"](stamp=stamp, frame_id="", **extra)
    q = np.array([0.01 * i, -0.02 * i, 0.5])
    return store.types["sensor_msgs/msg/JointState"](
        header=header, name=NAMES, position=q, velocity=q * 0 + 1.0, effort=q * 10 if effort else np.zeros(0)
    )


def _ros2(path, storage, *, kind="sensor_msgs/msg/JointState", effort=True):
    store = get_typestore(Stores.ROS2_HUMBLE)
    with Writer(path, version=9, storage_plugin=storage) as writer:
        topic = writer.add_connection("/states", kind, typestore=store)
        for i in range(COUNT):
            if kind.endswith("JointState"):
                message = _message(store, i, effort=effort)
            else:
                message = store.types[kind](data="nothing")
            writer.write(topic, 10**9 + i * 10**7, store.serialize_cdr(message, kind))
    return path


def _ros1(path):
    store = get_typestore(Stores.ROS1_NOETIC)
    with Writer1(path) as writer:
        topic = writer.add_connection("/states", "sensor_msgs/msg/JointState", typestore=store)
        for i in range(COUNT):
            raw = store.serialize_ros1(_message(store, i, ros1=True), "sensor_msgs/msg/JointState")
            writer.write(topic, 10**9 + i * 10**7, raw)
    return path


@pytest.fixture
def bags(tmp_path):
    sqlite = _ros2(tmp_path / "sqlite", StoragePlugin.SQLITE3)
    mcap = _ros2(tmp_path / "mcap", StoragePlugin.MCAP)
    return {
        "folder": sqlite,
        "db3": next(sqlite.glob("*.db3")),
        "mcap": next(mcap.glob("*.mcap")),
        "ros1": _ros1(tmp_path / "one.bag"),
    }


@pytest.mark.parametrize("kind", ["folder", "db3", "mcap", "ros1"])
def test_joint_states_come_back_from_every_kind_of_bag(bags, kind):
    table = read_table(bags[kind])
    assert table.kind == "motion" and len(table) == COUNT
    assert table.keys["joint_names"] == ["elbow", "shoulder"], "the gripper is not the arm"
    np.testing.assert_allclose(table.number("t"), 0.01 * np.arange(COUNT), atol=1e-6)
    np.testing.assert_allclose(table.number("q2"), -0.02 * np.arange(COUNT), atol=1e-12)
    np.testing.assert_allclose(table.number("tau1"), 0.1 * np.arange(COUNT), atol=1e-12)


def test_a_bag_without_efforts_has_no_torque_columns(tmp_path):
    table = read_table(_ros2(tmp_path / "bag", StoragePlugin.SQLITE3, effort=False))
    assert table.has("q1", "qd1") and not table.has("tau1")


def test_a_bag_without_joint_states_says_what_it_holds(tmp_path):
    path = _ros2(tmp_path / "bag", StoragePlugin.SQLITE3, kind="std_msgs/msg/String")
    with pytest.raises(InputError, match=r"no joint states.*std_msgs/msg/String"):
        read_table(path)


@pytest.mark.parametrize("kind", ["db3", "mcap", "ros1"])
@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(share=st.floats(0.02, 0.98), flip=st.integers(0, 2**16))
def test_a_truncated_or_damaged_bag_is_one_line_or_still_a_table(bags, kind, share, flip):
    data = bytearray(bags[kind].read_bytes())
    if flip % 2:
        data[flip % len(data)] ^= 0xFF
    else:
        data = data[: max(int(len(data) * share), 40)]
    broken = bags[kind].with_name(f"broken{bags[kind].suffix}")
    broken.write_bytes(bytes(data))
    try:
        table = read_table(broken)
        len(table)
    except InputError as error:
        assert "\n" not in str(error) and "broken" in str(error)


def test_a_bag_and_the_csv_of_its_messages_are_the_same_recording():
    folder = data_folder() / "ur10_motion"
    bag, csv = read_table(folder / "ur10_exciting_trajectory.db3"), read_table(folder / "run_a.csv")
    for quantity in ("t", "q1", "q6", "qd3", "tau2"):
        np.testing.assert_allclose(bag.number(quantity), csv.number(quantity), atol=ROUNDED)
