"""What a table says was measured at its poses: contacts, points of reflectors, lengths, orientations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.observations.pose_data import Mode
from app.diagnosis.thresholds.rows import FINE
from app.diagnosis.wording import note
from app.errors import CellValueError
from app.geometry import rotation_from_quaternion
from app.recordings import Table


@dataclass(frozen=True, eq=False)
class Measured:
    """What was measured, a row a pose; NaN where nothing was.

    Args:
        mode: "points", "length" or "targets".
        points: (m, reflectors, 3), m.
        orientations: (m, 3, 3) rotations, of reflectors that show them.
        lengths: (m,), m, of one wire or beam.
        target: (m,), number of the spike that was touched.
        names: of the spikes.
    """

    mode: Mode
    points: np.ndarray | None = None
    orientations: np.ndarray | None = None
    lengths: np.ndarray | None = None
    target: np.ndarray | None = None
    names: tuple[str, ...] = ()


def touched(table: Table, notes: list[str]) -> Measured:
    """Contacts with spikes, whose places are known or the same one each time."""
    names = table.text("target")
    labels, target = np.unique(names, return_inverse=True)
    known = [f"target_{c}" for c in "xyz"]
    if table.has(*known):
        points = table.numbers(known, missing=True)
        if np.isfinite(points).all():
            return Measured("points", points=points[:, None], target=target, names=tuple(labels))
        notes.append(note("targets_unknown"))
    return Measured("targets", target=target, names=tuple(labels))


def tracked(table: Table, notes: list[str]) -> Measured:
    """Points, a length, or points with orientation.

    Raises:
        CellValueError: a quaternion that is none.
    """
    if not table.has("x") and table.has("length"):
        return Measured("length", lengths=table.number("length", missing=True))
    reflectors = [table.numbers(["x", "y", "z"], missing=True)]
    more = [[c + number for c in "xyz"] for number in ("2", "3")]
    reflectors += [table.numbers(names, missing=True) for names in more if table.has(*names)]
    points = np.stack(reflectors, axis=1)
    for r in range(points.shape[1]):
        lost = ~np.isfinite(points[:, r]).all(axis=1)
        points[lost, r] = np.nan
        if lost.any():
            notes.append(note("reflector_lost", number=r + 1, count=int(lost.sum()), total=len(points)))
    orientations = None
    if table.has("qw", "qx", "qy", "qz"):
        quaternion = table.numbers(["qw", "qx", "qy", "qz"], missing=True)
        length = np.linalg.norm(quaternion, axis=1)
        wrong = np.flatnonzero(np.abs(length - 1.0) > 0.01)
        if len(wrong):
            raise CellValueError(
                f"the quaternion's length is {length[wrong[0]]:.3g}",
                file=table.path,
                row=int(table.rows[wrong[0]]),
                column="qw",
                expected="1",
            )
        seen = np.isfinite(length)
        orientations = np.full((len(points), 3, 3), np.nan)
        orientations[seen] = rotation_from_quaternion(quaternion[seen] / length[seen, None])
    return Measured("points", points=points, orientations=orientations)


def distinct(
    q: np.ndarray, measured: Measured, time: np.ndarray | None, digits: float, notes: list[str]
) -> np.ndarray:
    """Rows that say something a row before did not: exact copies are no second measurement, whatever their time.

    Where a file's measured digits are coarse, two measurements may well read alike: there only copies in time count.
    """
    parts = [q]
    if measured.mode == "targets":
        parts.append(measured.target[:, None])  # type: ignore[index]
    elif measured.points is not None:
        parts.append(np.nan_to_num(measured.points.reshape(len(q), -1), nan=-1e9))
    if measured.lengths is not None:
        parts.append(np.nan_to_num(measured.lengths[:, None], nan=-1e9))
    if time is not None and digits > FINE:
        parts.append(time[:, None])
    _, first = np.unique(np.concatenate(parts, axis=1), axis=0, return_index=True)
    keep = np.zeros(len(q), bool)
    keep[first] = True
    if not keep.all():
        notes.append(note("copies", count=int((~keep).sum())))
    return keep


def useless(measured: Measured, session: np.ndarray) -> list[tuple[np.ndarray, str]]:
    """Rows that say nothing, as masks (m,), each with the key of the note that says why."""
    out = []
    if measured.mode == "targets":
        count = np.bincount(measured.target)  # type: ignore[arg-type]
        out.append((count[measured.target] < 2, "touched_once"))
    if measured.points is not None:
        lost = ~np.isfinite(measured.points).any(axis=(1, 2))
        if measured.orientations is not None:
            lost &= ~np.isfinite(measured.orientations).all(axis=(1, 2))
        out.append((lost, "no_measurement"))
    if measured.lengths is not None:
        out.append((~np.isfinite(measured.lengths), "no_measurement"))
    size = np.bincount(session)
    out.append((size[session] < 4, "short_sessions"))
    return out


def length_resolution(table: Table, measured: Measured) -> float:
    """The last digit of what was measured, m; 0 where nothing was."""
    if measured.mode == "length":
        return table.resolution("length")
    if measured.mode == "points" and table.has("x"):
        return max(table.resolution(c) for c in "xyz")
    return 0.0
