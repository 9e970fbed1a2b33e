"""ROS bags: ROS 1 (.bag), ROS 2 (sqlite3 .db3, .mcap, or the folder with metadata.yaml); JointState only.

Positions are radians, efforts newton-metres, by the message's own definition. Joints keep the message's
order; their names stand in the key `joint_names`, by which the diagnosis puts them in the robot's order.
No ROS is needed.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from app.errors import FileFormatError
from app.recordings.formats._frames import table_of
from app.recordings.table import Table

MESSAGE = "sensor_msgs/msg/JointState"
#: Joints of what the arm carries, by parts of their names.
NOT_ARM = ("finger", "gripper", "robotiq", "knuckle", "hand_")
_MAGIC = (b"#ROSBAG", b"SQLite format 3\x00", b"\x89MCAP0")


class RosBag:
    key = "rosbag"
    title = "ROS 1 and ROS 2 bags and MCAP with sensor_msgs/JointState"

    def matches(self, path: Path, head: bytes) -> bool:
        if path.is_dir():
            return (path / "metadata.yaml").is_file()
        return head.startswith(_MAGIC)

    def read(self, path: Path) -> Table:
        """Reads the joint states of the topic that has most of them.

        Raises:
            FileFormatError: truncated or unreadable, or a bag without JointState.
        """
        try:
            times, names, values = _messages(path)
        except FileFormatError:
            raise
        # The readers below raise whatever their storage does: struct, sqlite, zstd, key and value errors.
        except Exception as error:
            raise FileFormatError(
                f"the bag cannot be read; truncated or not closed? ({type(error).__name__}: {error})",
                file=path,
                expected="a whole ROS 1 or ROS 2 bag, or MCAP",
            ) from None
        arm = [k for k, name in enumerate(names) if not any(part in name.lower() for part in NOT_ARM)]
        columns = {"t_s": times}
        for prefix, unit in (("q", "rad"), ("qd", "rad_s"), ("tau", "Nm")):
            data = values[prefix]
            if np.isfinite(data).any():
                columns |= {f"{prefix}{i + 1}_{unit}": data[:, k] for i, k in enumerate(arm)}
        keys: dict[str, Any] = {"kind": "motion", "joint_names": [names[k] for k in arm]}
        return table_of(path, keys, columns)


def _messages(path: Path) -> tuple[np.ndarray, list[str], dict[str, np.ndarray]]:
    """Times [s] (m,), joint names, and position, speed, effort (m, n) with NaN where a message has none."""
    from rosbags.highlevel import AnyReader  # slow to load, and every file asks this module first
    from rosbags.typesys import Stores, get_typestore

    with AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
        wanted = [c for c in reader.connections if c.msgtype == MESSAGE]
        if not wanted:
            kinds = sorted({c.msgtype for c in reader.connections})
            raise FileFormatError(
                f"no joint states in this bag; it holds {', '.join(kinds[:8]) or 'nothing'}",
                file=path,
                expected=f"a topic of {MESSAGE}",
            )
        topic = max(wanted, key=lambda c: c.msgcount).topic
        times, stamps, names = [], [], []
        rows: dict[str, list[np.ndarray]] = {"q": [], "qd": [], "tau": []}
        for connection, received, raw in reader.messages([c for c in wanted if c.topic == topic]):
            message: Any = reader.deserialize(raw, connection.msgtype)
            if not names:
                names = [str(name) for name in message.name]
            order = _order(names, [str(name) for name in message.name])
            if order is None:
                continue  # another device on the same topic
            times.append(received * 1e-9)
            stamps.append(message.header.stamp.sec + message.header.stamp.nanosec * 1e-9)
            for key, part in (("q", message.position), ("qd", message.velocity), ("tau", message.effort)):
                part = np.asarray(part, float)
                rows[key].append(part[order] if len(part) == len(names) else np.full(len(names), np.nan))
    if not times or not names:
        raise FileFormatError("no joint states with names in this bag", file=path, expected=MESSAGE)
    stamped = np.array(stamps)
    # The stamp is when it was measured; where nobody filled it in, the time of arrival serves.
    t = stamped if np.ptp(stamped) > 0 else np.array(times)
    return t - t[0], names, {key: np.array(part) for key, part in rows.items()}


def _order(names: list[str], here: list[str]) -> list[int] | None:
    if here == names:
        return list(range(len(names)))
    if set(here) == set(names):
        return [here.index(name) for name in names]
    return None


FORMAT = RosBag()
