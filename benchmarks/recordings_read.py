"""Large recordings: time beside polars alone, and the memory a reading process comes to.

The CSV has a million rows of 19 columns, as a minute and a half of six joints at 10 kHz or half an hour at 500 Hz; ours
counts until every column is an array. The bags have a gigabyte: pictures, as robots record them, and joint states; and
joint states alone, which is an hour and a half at 500 Hz.
"""

from __future__ import annotations

import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import polars as pl

from app.recordings import read_table
from benchmarks.rows import Row, quickest

ROWS = 1_000_000
PICTURES, PICTURE_BYTES = 1000, 1_000_000
ALONE = 2_750_000  # joint states of six joints: 363 bytes each, as they are recorded
STATES = 50_000
#: The kernel's own mark: `ru_maxrss` would hold the memory of whoever started the process too.
_READ = """
import sys
from pathlib import Path
from app.recordings.arm import read_with_arm
table, _ = read_with_arm(sys.argv[1], "ur10e")
most = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
print(len(table), int(most.split()[1]) / 1e3)
"""


def run() -> list[Row]:
    """Measures and gives the rows."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        csv = _csv(folder / "log.csv")
        ours, peer = quickest(lambda: _ours(csv), 2), quickest(lambda: _polars(csv), 2)
        rows = [Row("1,000,000 rows of CSV, all columns", ours, peer, "polars read_csv to arrays", aim=6.0)]
        rows.append(Row("memory of that process", _memory(csv, ROWS), None, unit="MB", aim=1000.0))
        csv.unlink()
        bag = _bag(folder / "bag")
        rows.append(
            Row("a bag of 1 GB: memory of the process", _memory(bag, STATES), None, unit="MB", aim=1000.0)
        )
        shutil.rmtree(bag)
        bag = _bag_of_states(folder / "states")
        rows.append(
            Row("1 GB of joint states alone: memory", _memory(bag, ALONE), None, unit="MB", aim=1000.0)
        )
    return rows


def _csv(path: Path) -> Path:
    rng = np.random.default_rng(0)
    columns = {"t_s": np.arange(ROWS) * 0.002}
    for prefix, unit, places in (("q", "rad", 7), ("qd", "rad_s", 6), ("tau", "Nm", 4)):
        columns |= {f"{prefix}{j}_{unit}": np.round(rng.normal(size=ROWS), places) for j in range(1, 7)}
    with path.open("wb") as file:
        file.write(b"# kind: motion\n# robot: ur10e\n")
        pl.DataFrame(columns).write_csv(file)
    return path


def _ours(path: Path) -> None:
    table = read_table(path)
    for quantity in table.columns:
        table.number(quantity)


def _polars(path: Path) -> None:
    frame = pl.read_csv(path, skip_lines=2)
    for name in frame.columns:
        frame[name].to_numpy()


def _memory(path: Path, rows: int) -> float:
    """Most memory [MB] that a process of its own came to; it must have read `rows` rows."""
    done = subprocess.run(
        [sys.executable, "-c", _READ, str(path)], capture_output=True, text=True, check=True
    )
    count, memory = done.stdout.split()
    assert int(count) == rows
    return float(memory)


def _bag(path: Path) -> Path:
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    from app.kinematics import load_robot

    store = get_typestore(Stores.ROS2_HUMBLE)
    names = [joint.name for joint in load_robot("ur10e").joints]
    kinds = store.types
    picture = np.random.default_rng(0).integers(0, 255, PICTURE_BYTES, dtype=np.uint8)
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        states = writer.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store)
        camera = writer.add_connection("/camera", "sensor_msgs/msg/CompressedImage", typestore=store)
        every = STATES // PICTURES
        for i in range(STATES):
            stamp = kinds["builtin_interfaces/msg/Time"](sec=10 + i // 500, nanosec=i % 500 * 2_000_000)
            head = kinds["std_msgs/msg/Header"](stamp=stamp, frame_id="")
            q = np.sin(0.001 * i + np.arange(6))
            message = kinds["sensor_msgs/msg/JointState"](
                header=head, name=names, position=q, velocity=q * 0, effort=q * 100
            )
            time = 10**10 + i * 2_000_000
            writer.write(states, time, store.serialize_cdr(message, "sensor_msgs/msg/JointState"))
            if i % every == 0:
                seen = kinds["sensor_msgs/msg/CompressedImage"](header=head, format="jpeg", data=picture)
                writer.write(camera, time, store.serialize_cdr(seen, "sensor_msgs/msg/CompressedImage"))
    return path


def _bag_of_states(path: Path) -> Path:
    """Each message is the one before with another time and other angles: written as fast as the disk takes them."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    from app.kinematics import load_robot

    store = get_typestore(Stores.ROS2_HUMBLE)
    names, kinds, zeros = [joint.name for joint in load_robot("ur10e").joints], store.types, np.zeros(6)
    head = kinds["std_msgs/msg/Header"](kinds["builtin_interfaces/msg/Time"](1, 2), "")
    message = kinds["sensor_msgs/msg/JointState"](head, names, zeros, zeros, zeros)
    raw = bytearray(store.serialize_cdr(message, "sensor_msgs/msg/JointState"))
    angles = len(raw) - 3 * 48 - 2 * 8  # three sequences of six stand at the end, each behind its length
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        states = writer.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store)
        for i in range(ALONE):
            struct.pack_into("<iI", raw, 4, 10 + i // 500, i % 500 * 2_000_000)
            struct.pack_into("<6d", raw, angles, *np.sin(0.001 * i + np.arange(6)))
            writer.write(states, 10**10 + i * 2_000_000, bytes(raw))
    return path
