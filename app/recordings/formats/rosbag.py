"""ROS bags: ROS 1 (.bag), ROS 2 (sqlite3 .db3, .mcap, or the folder with metadata.yaml).

Positions are radians, efforts newton-metres, by the message's own definition; UR's drivers put motor currents there,
which `--effort A` says. Joints are looked for by name, see bags/choosing.py; what is read and what is left is said.
With `--map points=TOPIC` the points or poses of a topic become a tracker recording, the joints interpolated to their
stamps.
No ROS is needed.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from app.errors import FileFormatError, UnknownNameError
from app.phrases import Said
from app.recordings.bags.beside import commanded, temperatures, tracked, wrenches
from app.recordings.bags.choosing import Fit, choose
from app.recordings.bags.collecting import Series, collect
from app.recordings.formats._frames import table_of
from app.recordings.options import ReadOptions
from app.recordings.table import Table
from app.recordings.wording import phrase

_MAGIC = (b"#ROSBAG", b"SQLite format 3\x00", b"\x89MCAP0")
_MOST_METADATA = 2_000_000  # bytes
_MOST_NAMED = 12
_ODD = 0x9E3779B97F4A7C15  # any large odd number: every bit of a row counts in its sum


class RosBag:
    key = "rosbag"
    title = "ROS 1 and ROS 2 bags and MCAP with sensor_msgs/JointState"

    def matches(self, path: Path, head: bytes) -> bool:
        if path.is_dir():
            return (path / "metadata.yaml").is_file()
        return head.startswith(_MAGIC)

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads the arm's joint states, with what is of use beside them.

        Raises:
            FileFormatError: truncated or unreadable, or a bag without JointState of this arm.
            InputError: several sets fit; says how to choose.
        """
        options = options or ReadOptions()
        metadata = path / "metadata.yaml"
        if path.is_dir() and metadata.stat().st_size > _MOST_METADATA:
            raise FileFormatError("too large", file=metadata, expected="the metadata of a bag")
        found = collect(path)
        arm, asked = choose(found, options, path)
        names = tuple(arm.series.names[k] for k in arm.columns)
        slides = options.slides if len(options.slides) == len(names) else (False,) * len(names)
        keys: dict[str, Any] = {"kind": "motion", "joint_names": list(names)}
        if arm.by_name and options.joint_names:
            keys["joint_names"] = list(options.joint_names)
        if "points" in options.mapping:
            series = _points(found, options.mapping["points"], path)
            times, columns = tracked(series, arm, slides)
            if not len(times):
                raise FileFormatError("no point while joints were recorded", file=path, expected="one clock")
            keys["kind"] = "tracker"
            table = table_of(path, keys, {"t_s": times - times[0], **columns})
            return _with_notes(table, found, [arm.series, series], arm, 0)
        t = arm.series.times()
        columns, kept = _joint_columns(arm, t, slides, keep=asked is not None and asked.series is arm.series)
        t = t[kept]
        used = [arm.series]
        if asked is not None:
            columns |= commanded(asked, t, slides)
            used.append(asked.series)
        columns |= temperatures(found, names, t) | wrenches(found, t)
        columns = {"t_s": t - t[0], **columns}
        table = table_of(path, keys, columns)
        return _with_notes(table, found, used, arm, arm.series.count - len(t))


def _joint_columns(
    arm: Fit, t: np.ndarray, slides: tuple[bool, ...], *, keep: bool
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Columns without exact repeats, and which messages they are. Unless told to keep them, the series lets go of its
    numbers: both together may be a gigabyte."""
    kinds = ("q", "rad", "m"), ("qd", "rad_s", "m_s"), ("tau", "Nm", "Nm")
    kept = _without_repeats(t, [arm.series.values(key)[:, k] for key, _, _ in kinds for k in arm.columns])
    columns: dict[str, np.ndarray] = {}
    for key, turning, sliding in kinds:
        values = arm.series.values(key)
        chosen = [np.ascontiguousarray(values[:, k][kept]) for k in arm.columns]
        if any(np.isfinite(column).any() for column in chosen):
            for j, column in enumerate(chosen):
                columns[f"{key}{j + 1}_{sliding if slides[j] else turning}"] = column
        del values, chosen
        if not keep:
            arm.series.forget(key)
    return columns, kept


def _without_repeats(t: np.ndarray, columns: list[np.ndarray]) -> np.ndarray:
    """(m,) True for every message but those that repeat an earlier one: its time and all its numbers.

    Rows of one time are put beside each other by a sum over the bits of their numbers; rows that are equal have the
    same sum, and only neighbours are compared.
    """
    kept = np.ones(len(t), bool)
    if len(np.unique(t)) == len(t):
        return kept
    sums = np.zeros(len(t), np.uint64)
    for column in columns:
        sums = sums * np.uint64(_ODD) + np.ascontiguousarray(column).view(np.uint64)
    order = np.lexsort((sums, t))
    first, second = order[:-1], order[1:]
    same = (t[first] == t[second]) & (sums[first] == sums[second])
    for column in columns:
        a, b = column[first], column[second]
        same &= (a == b) | (np.isnan(a) & np.isnan(b))
    kept[second[same]] = False
    return kept


def _points(found: list[Series], topic: str, path: Path) -> Series:
    series = [s for s in found if s.kind in ("point", "pose")]
    chosen = [s for s in series if s.topic == topic]
    if not chosen:
        raise UnknownNameError(
            topic, available={s.topic for s in series}, what="topic of points or poses", file=path
        )
    return max(chosen, key=lambda s: s.count)


def _with_notes(table: Table, found: list[Series], used: list[Series], arm: Fit, repeats: int) -> Table:
    names = ", ".join(arm.series.names[k] for k in arm.columns)
    notes = [phrase("bag.read", topic=arm.series.topic, names=names, count=arm.series.count)]
    if not arm.by_name and len(used):
        notes.append(phrase("bag.order", names=names))
    if repeats:
        notes.append(phrase("bag.repeats", count=repeats))
    notes += [phrase("bag.beside", topic=s.topic, count=s.count) for s in used[1:]]
    left = [
        s
        for s in found
        if all(s is not u for u in used) and s.kind in ("joints", "commanded", "point", "pose")
    ]
    other = [n for k, n in enumerate(arm.series.names) if k not in arm.columns]
    parts = [f"{s.topic} ({', '.join(s.names[:_MOST_NAMED])}; {s.count})" for s in left[:_MOST_NAMED]]
    if other:
        parts.append(", ".join(other[:_MOST_NAMED]))
    if parts:
        notes.append(phrase("bag.left", parts=tuple(parts)))
    return replace(table, notes=tuple(Said(note) for note in notes))


FORMAT = RosBag()
