"""Every message of a bag once: joint states by topic and names, and what else is of use beside them."""

from __future__ import annotations

from array import array
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from app.errors import FileFormatError, InputError
from app.recordings.bags.bounded import BombError, bounded

JOINT_STATE = "sensor_msgs/msg/JointState"
_BESIDE = {
    "sensor_msgs/msg/Temperature": "temperature",
    "geometry_msgs/msg/WrenchStamped": "wrench",
    "geometry_msgs/msg/PointStamped": "point",
    "geometry_msgs/msg/PoseStamped": "pose",
    "geometry_msgs/msg/TransformStamped": "pose",
}
#: Messages of a trajectory controller: joint_names, and positions that are asked for.
_CONTROLLER = ("JointTrajectoryControllerState", "JointControllerState")
_MOST_SETS = 200  # of names: a message that names its joints anew each time is no log
_MOST_JOINTS = 200
_NS = 1e-9


@dataclass(eq=False)
class Series:
    """Messages of one topic that speak of one set of names.

    Args:
        topic: where they were published.
        names: joints, or what else the numbers are of.
        kind: "joints", "commanded", "temperature", "wrench", "point", "pose".
        count: messages.
    """

    topic: str
    names: tuple[str, ...]
    kind: str
    count: int = 0
    _received: array = field(default_factory=lambda: array("d"))
    _stamps: array = field(default_factory=lambda: array("d"))
    _values: dict[str, array] = field(default_factory=dict)

    def add(self, received: float, stamp: float, **values: Any) -> None:
        """One message: arrays of numbers, of the length of `names` or empty."""
        self.count += 1
        self._received.append(received)
        self._stamps.append(stamp)
        for key, numbers in values.items():
            row = np.asarray(numbers, float).ravel()
            width = self.width(key)
            row = row if len(row) == width else np.full(width, np.nan)
            self._values.setdefault(key, array("d")).frombytes(row.tobytes())

    def width(self, key: str) -> int:
        """Numbers a message."""
        return {"wrench": 6, "point": 3, "pose": 7}.get(key, len(self.names))

    def times(self) -> np.ndarray:
        """(m,) [s]: when it was measured; where nobody filled that in, when it arrived."""
        stamps = np.array(self._stamps)
        return stamps if len(stamps) and np.ptp(stamps) > 0 else np.array(self._received)

    def values(self, key: str) -> np.ndarray:
        """(m, width), NaN where a message has none; the numbers as they are kept, not a copy."""
        if not self._values.get(key):
            return np.full((self.count, self.width(key)), np.nan)
        return np.frombuffer(self._values[key]).reshape(self.count, self.width(key))

    def forget(self, key: str) -> None:
        """Lets go of numbers that were taken over; there may be hundreds of megabytes."""
        self._values.pop(key, None)


def collect(path: Path) -> list[Series]:
    """All series of a bag, in the order they first appear.

    Raises:
        FileFormatError: truncated, unreadable, without joint states, or grown beyond all bounds.
    """
    try:
        return _collected(path)
    except InputError:
        raise
    except BombError as error:
        raise FileFormatError(
            f"the bag holds {error}" if str(error).startswith("a ") else f"the bag: {error}",
            file=path,
            expected="a bag as recorders write them",
        ) from None
    # The readers below raise whatever their storage does: struct, sqlite, zstd, key and value errors.
    except Exception as error:
        raise FileFormatError(
            f"the bag cannot be read; truncated or not closed? ({type(error).__name__}: {error})",
            file=path,
            expected="a whole ROS 1 or ROS 2 bag, or MCAP",
        ) from None


def _collected(path: Path) -> list[Series]:
    from rosbags.highlevel import AnyReader  # slow to load, and every file asks this module first
    from rosbags.typesys import Stores, get_typestore

    found: dict[tuple, Series] = {}
    with bounded(_size(path)), AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
        wanted = [c for c in reader.connections if _kind(c.msgtype)]
        if not any(c.msgtype == JOINT_STATE for c in wanted):
            kinds = sorted({c.msgtype for c in reader.connections})
            raise FileFormatError(
                f"no joint states in this bag; it holds {', '.join(kinds[:8]) or 'nothing'}",
                file=path,
                expected=f"a topic of {JOINT_STATE}",
            )
        for connection, received, raw in reader.messages(wanted):
            message: Any = reader.deserialize(raw, connection.msgtype)
            _take(found, connection.topic, _kind(connection.msgtype), message, received * _NS)
            if len(found) > _MOST_SETS:
                raise FileFormatError(
                    f"over {_MOST_SETS} sets of names", file=path, expected="joint states of one robot"
                )
    if not any(s.kind == "joints" and s.names for s in found.values()):
        raise FileFormatError("no joint states with names in this bag", file=path, expected=JOINT_STATE)
    return [s for s in found.values() if s.names]


def _size(path: Path) -> int:
    files = [p for p in path.rglob("*") if p.is_file()] if path.is_dir() else [path]
    return sum(p.stat().st_size for p in files)


def _kind(msgtype: str) -> str:
    if msgtype == JOINT_STATE:
        return "joints"
    if msgtype.endswith(_CONTROLLER):
        return "commanded"
    return _BESIDE.get(msgtype, "")


def _take(found: dict, topic: str, kind: str, message: Any, received: float) -> None:
    header = getattr(message, "header", None)
    stamp = 0.0 if header is None else header.stamp.sec + header.stamp.nanosec * _NS
    if kind in ("joints", "commanded"):
        names = tuple(str(n) for n in (message.name if kind == "joints" else message.joint_names))
        if len(names) > _MOST_JOINTS:
            return
        where = next((s for s in found.values() if s.topic == topic and set(s.names) == set(names)), None)
        key = (topic, where.names if where is not None and len(where.names) == len(names) else names)
        order = [names.index(name) for name in key[1]]
        if kind == "joints":
            values = {"q": message.position, "qd": message.velocity, "tau": message.effort}
        else:
            asked = getattr(message, "reference", None) or getattr(message, "desired", None)
            values = {"q": getattr(asked, "positions", ())}
        rows = {}
        for name, numbers in values.items():
            row = np.asarray(numbers, float)
            rows[name] = row[order] if len(row) == len(names) else row[:0]
    else:
        frame = str(getattr(header, "frame_id", "")) or kind
        key, rows = (topic, (frame,)), {kind: _numbers(kind, message)}
    if key not in found:
        found[key] = Series(topic, key[1], kind)
    found[key].add(received, stamp, **rows)


def _numbers(kind: str, message: Any) -> list[float]:
    if kind == "temperature":
        return [message.temperature]
    if kind == "wrench":
        force, torque = message.wrench.force, message.wrench.torque
        return [force.x, force.y, force.z, torque.x, torque.y, torque.z]
    if kind == "point":
        return [message.point.x, message.point.y, message.point.z]
    held = getattr(message, "pose", None)
    place = held.position if held is not None else message.transform.translation
    turn = held.orientation if held is not None else message.transform.rotation
    return [place.x, place.y, place.z, turn.w, turn.x, turn.y, turn.z]
