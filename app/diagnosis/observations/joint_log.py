"""A joint log as arrays: rows that cannot be used are set aside and counted, never repaired."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from scipy.ndimage import uniform_filter1d

from app.diagnosis.observations.clock import going_on
from app.diagnosis.observations.effort import effort_of
from app.diagnosis.observations.joint_log_checks import (
    backwards_rows,
    check_moves,
    check_units,
    spikes,
    torque_spikes,
)
from app.diagnosis.observations.thinning import STRETCH, stretches
from app.diagnosis.thresholds.rows import FEWEST, GAP, MOST_BROKEN, WARMING
from app.diagnosis.wording import note
from app.errors import CellValueError, InputError
from app.kinematics import RobotModel
from app.recordings import Table
from app.steps import done

STRETCHES = "stretches"


@dataclass(frozen=True, eq=False)
class Log:
    """Usable samples of a motion recording, in SI units.

    Args:
        t: (m,) [s], rising.
        q: (m, n) [rad or m].
        qd: (m, n) recorded speed, or None.
        y: (m, n) torque [Nm]; current [A] or servo error [rad or m] while its factor is unknown.
        lacking: header key of that factor, see effort.py; "" where `y` is a torque.
        temperature: (m, n) [degC] or None.
        commanded: (m, n) [rad or m] or None.
        motor: (m, n) angles of the motors, seen behind the gear [rad or m], q where one is not recorded; or None.
        rows: (m,) line numbers.
        segments: runs without a gap.
        step: usual sampling step [s].
        dropped: line numbers of rows set aside.
        spiked: (m, n) True where a torque stood alone above its neighbours; it carries their median and counts nowhere.
        notes: what a person should know of it.
    """

    t: np.ndarray
    q: np.ndarray
    qd: np.ndarray | None
    y: np.ndarray
    lacking: str
    temperature: np.ndarray | None
    commanded: np.ndarray | None
    rows: np.ndarray
    segments: list[slice]
    step: float
    total: int
    dropped: np.ndarray
    stated_noise: np.ndarray | None = None
    notes: tuple[str, ...] = field(default=())
    spiked: np.ndarray = field(default_factory=lambda: np.zeros((0, 0), bool))
    stiffness: np.ndarray | None = None
    motor: np.ndarray | None = None


def read_log(table: Table, robot: RobotModel) -> Log:
    """Reads and checks a motion recording.

    Raises:
        InputError: names file, row and column of what cannot be used.
    """
    n = robot.joint_count
    joints = range(1, n + 1)
    if f"q{n + 1}" in table.columns:
        raise InputError(
            f"there are more joint columns than the robot's {n} joints",
            file=table.path,
            row=table.header_row,
            column=f"q{n + 1}",
            expected=f"q1 to q{n} for {robot.name}",
        )
    table.require(["t", *[f"q{j}" for j in joints]])
    notes: list[str] = []
    table, borders = _worked_on(table, notes)
    order = joint_order(table, robot, notes)
    t, turned_back = going_on(table.tolerant("t"))
    if turned_back:
        notes.append(note("clock_back", count=turned_back))
    q = _columns(table, "q", order)
    qd = temperature = commanded = None
    if table.has(*[f"qd{j}" for j in joints]):
        qd = _columns(table, "qd", order)
    elif any(table.has(f"qd{j}") for j in joints):
        notes.append(note("speed_partly"))
    if table.has(*[f"temperature{j}" for j in joints]):
        temperature = np.stack([table.tolerant(f"temperature{j}") for j in joints], axis=1)
    if table.has(*[f"qc{j}" for j in joints]):
        commanded = np.stack([table.tolerant(f"qc{j}") for j in joints], axis=1)[:, order]
    motor = _motor_side(table, q, order)
    straight = order == list(range(n))
    as_recorded = q if straight else q[:, np.argsort(order)]
    effort = effort_of(table, n, as_recorded, _unordered(commanded, order), notes)
    y = effort.y if straight else effort.y[:, order]
    rows = np.asarray(table.rows)
    done(0.5)
    total = len(t)
    good = np.isfinite(t) & np.isfinite(q).all(axis=1) & np.isfinite(y).all(axis=1)
    if qd is not None and good.any() and np.mean(np.isfinite(qd[good])) < 0.5:
        notes.append(note("speed_missing"))
        qd = None
    if qd is not None:
        good &= np.isfinite(qd).all(1)
    _refuse_if_few(good, rows, table)
    left = np.flatnonzero(good)
    back = backwards_rows(t[left], rows[left], table)
    good[left[back]] = False
    left = np.flatnonzero(good)
    usable = slice(None) if good.all() else left  # a slice copies nothing
    wild = spikes(t[usable], q[usable], qd[usable] if qd is not None else None, y[usable], robot)
    good[left[wild]] = False
    _refuse_if_few(good, rows, table)
    dropped = rows[~good]
    if len(dropped):
        notes.append(note("rows_dropped", count=len(dropped), total=total, share=len(dropped) / total))
    if not good.all():
        t, q, y, rows = t[good], q[good], y[good], rows[good]
        qd = None if qd is None else qd[good]
    step = float(np.median(np.diff(t)))
    qd = check_units(t, q, qd, rows, table, robot, notes)
    check_moves(q, y, table, notes)
    done(0.8)
    spiked, y = torque_spikes(y)
    if spiked.any():
        notes.append(note("torque_spikes", count=int(spiked.sum())))
    cuts = np.flatnonzero(np.diff(t) > GAP * step) + 1
    edges = [0, *cuts.tolist(), len(t)]
    segments = [slice(a, b) for a, b in pairwise(edges) if b - a >= 8]
    if not segments:
        raise InputError(
            "the log is nothing but gaps", file=table.path, column="t_s", expected="even sampling"
        )
    if len(cuts) > borders:
        notes.append(note("gaps", count=len(cuts) - borders))
    kept = np.zeros(len(t), bool)
    for part in segments:
        kept[part] = True
    temperature = _slow(_filled(temperature, good), step)
    commanded, motor = _filled(commanded, good), _filled(motor, good)
    if not kept.all():
        index = np.flatnonzero(kept)
        t, q, y, rows, spiked = t[index], q[index], y[index], rows[index], spiked[index]
        qd = None if qd is None else qd[index]
        temperature = None if temperature is None else temperature[index]
        commanded = None if commanded is None else commanded[index]
        motor = None if motor is None else motor[index]
        sizes = np.cumsum([0, *[s.stop - s.start for s in segments]])
        segments = [slice(int(a), int(b)) for a, b in pairwise(sizes)]
    return Log(
        t, q, qd, y, effort.lacking, temperature, commanded, rows, segments, step, total, dropped,
        _stated_noise(table, n), tuple(notes), spiked,
        None if effort.stiffness is None else effort.stiffness[order], motor,
    )  # fmt: skip


def _worked_on(table: Table, notes: list[str]) -> tuple[Table, int]:
    """The log, or stretches of it where it is very long; and how many borders are between them."""
    if STRETCHES not in table.kept:
        total = len(table)
        first = stretches(total)
        if not len(first):
            return table, 0
        table.kept[STRETCHES] = table.some(first, STRETCH), len(first), total
        table.forget()  # both together would take gigabytes
    part, count, total = table.kept[STRETCHES]
    seconds = STRETCH * float(np.median(np.diff(part.tolerant("t")[:STRETCH])))
    notes.append(note("stretches", used=count * STRETCH, total=total, count=count, seconds=f"{seconds:.3g}"))
    return part, count - 1


def _columns(table: Table, prefix: str, order: list[int]) -> np.ndarray:
    """(m, n) of the columns PREFIX1 …, in the joints' order."""
    out = np.empty((len(table), len(order)))  # column by column: a long log's fill gigabytes twice
    for j, k in enumerate(order):
        out[:, j] = table.tolerant(f"{prefix}{k + 1}")
    return out


def joint_order(table: Table, robot: RobotModel, notes: list[str]) -> list[int]:
    """Which column belongs to each of the robot's joints, by the names a bag gives."""
    n = robot.joint_count
    names = table.keys.get("joint_names")
    if not isinstance(names, list):
        return list(range(n))
    wanted = [joint.name for joint in robot.joints]
    # Prefixes and suffixes differ from driver to driver: the longest common part decides.
    found = [
        next((k for k, name in enumerate(names) if str(name).endswith(w) or w.endswith(str(name))), None)
        for w in wanted
    ]
    if None in found or len(set(found)) != n:
        notes.append(note("bag_unnamed", names=tuple(map(str, names))))
        return list(range(n))
    order = [int(k) for k in found if k is not None]
    if order != list(range(n)):
        notes.append(note("bag_ordered", names=tuple(str(names[k]) for k in order)))
    return order


def _motor_side(table: Table, q: np.ndarray, order: list[int]) -> np.ndarray | None:
    """(m, n) of the columns theta1 …, in the joints' order; q where a joint has none, None where all have none."""
    names = [f"theta{k + 1}" for k in order]
    if not any(table.has(name) for name in names):
        return None
    return np.stack([table.tolerant(n) if table.has(n) else q[:, j] for j, n in enumerate(names)], axis=1)


def _unordered(values: np.ndarray | None, order: list[int]) -> np.ndarray | None:
    return None if values is None else values[:, np.argsort(order)]


def _stated_noise(table: Table, n: int) -> np.ndarray | None:
    """(n,) stated one-sigma noise of the torques [Nm], where the header has a usable one."""
    stated = table.keys.get("noise_Nm")
    if stated is None:
        return None
    try:
        noise = np.broadcast_to(np.array(stated, float).reshape(-1), (n,)).astype(float)
    except (TypeError, ValueError):
        noise = np.full(n, np.nan)
    if not np.all(np.isfinite(noise)) or np.any(noise < 0):
        raise CellValueError(
            f"found {str(stated)[:60]!r}",
            file=table.path,
            column="noise_Nm",
            expected=f"one positive number, or {n} of them",
        )
    return noise if np.all(noise > 0) else None


def _refuse_if_few(good: np.ndarray, rows: np.ndarray, table: Table) -> None:
    """Raises InputError where too few rows can be used."""
    if good.sum() >= max(FEWEST, (1.0 - MOST_BROKEN) * len(good)):
        return
    first = int(rows[np.flatnonzero(~good)[0]]) if not good.all() else None
    raise InputError(
        f"{int((~good).sum())} of {len(good)} rows are broken and {int(good.sum())} are left",
        file=table.path,
        row=first,
        expected=f"at least {FEWEST} usable rows, and most of the file",
    )


def _slow(temperature: np.ndarray | None, step: float) -> np.ndarray | None:
    """Averaged over some seconds: a gear's temperature moves slower than its sensor's noise and digits."""
    if temperature is None:
        return None
    width = int(np.clip(WARMING / step, 1, len(temperature) // 10 + 1))
    return uniform_filter1d(temperature, width, axis=0, mode="nearest")


def _filled(values: np.ndarray | None, good: np.ndarray) -> np.ndarray | None:
    """Missing values carried over from their neighbours; None where there are hardly any."""
    if values is None:
        return None
    values = values[good]
    known = np.isfinite(values)
    if np.any(known.mean(0) < 0.2):
        return None
    index = np.arange(len(values))
    return np.stack(
        [np.interp(index, index[k], v[k]) for v, k in zip(values.T, known.T, strict=True)], axis=1
    )
