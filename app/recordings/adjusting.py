"""What a recording needs before it is taken for its robot's: a stated unit of the effort, whole turns taken off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import polars as pl

from app.errors import InputError
from app.kinematics import RobotModel
from app.phrases import Said
from app.recordings.options import ReadOptions
from app.recordings.table import Table
from app.recordings.wording import phrase

_TURN = 2 * np.pi
_MOST_TURNS = 50  # an endless joint that was turned on and on; beyond, another unit is likelier
_SLACK = 0.05  # rad beyond a limit that a controller may show


def with_effort(table: Table, options: ReadOptions) -> Table:
    """The table with its efforts taken as motor currents, where that was said.

    Raises:
        InputError: nothing is recorded that could be one.
    """
    if options.effort != "A":
        return table
    efforts = table.numbered("tau")
    if efforts:
        renamed = {table.columns[name].name: f"i{name[3:]}_A" for name in efforts}
        table = _renamed(table, renamed)
    elif not table.numbered("i"):
        raise InputError("no efforts in this recording", file=table.path, expected="efforts, for --effort A")
    gains = list(options.drive_gain)
    if not gains:
        return replace(table, notes=(*table.notes, Said(phrase("effort.currents"))))
    count = len(table.numbered("i"))
    if len(gains) not in (1, count):
        raise InputError(
            f"--drive-gain with {len(gains)} values", file=table.path, expected=f"1 or {count}, Nm per ampere"
        )
    keys = {**table.keys, "drive_gain_Nm_per_A": gains * (count if len(gains) == 1 else 1)}
    return replace(table, keys=keys)


def _renamed(table: Table, names: dict[str, str]) -> Table:
    before = {new: old for old, new in names.items()}

    def load() -> tuple[pl.DataFrame, np.ndarray]:
        frame, rows = table.load()
        return frame.rename(names, strict=False), rows

    def written(name: str) -> pl.Series:
        assert table.written is not None
        return table.written(before.get(name, name))

    return replace(
        table,
        names=tuple(names.get(name, name) for name in table.names),
        load=load,
        written=None if table.written is None else written,
    )


def without_whole_turns(table: Table, robot: RobotModel) -> Table:
    """The table with whole turns taken off joints that were recorded turns away from the description's range.

    An endless joint counts on; the arm is the same after each turn. Only where a joint's whole path lies outside its
    limits, and fits within them a number of turns away, is it moved, all rows alike.
    """
    shifts: dict[str, int] = {}
    for number, joint in enumerate(robot.joints, 1):
        name = f"q{number}"
        column = table.columns.get(name)
        if joint.prismatic or column is None or column.unit not in ("rad", "deg"):
            continue
        values = table.tolerant(name)
        values = values[np.isfinite(values)]
        turns = _turns(values, joint.lower, joint.upper) if len(values) else 0
        if turns:
            shifts[name] = turns
    if not shifts or 2 * len(shifts) > robot.joint_count:
        return table
    notes = tuple(Said(phrase("turns", joint=int(name[1:]), turns=turns)) for name, turns in shifts.items())
    for quantity in ("q", "qc", "theta"):
        for name, turns in shifts.items():
            table = _shifted(table, quantity + name[1:], turns)
    return replace(table, notes=(*table.notes, *notes))


def _turns(values: np.ndarray, lower: float, upper: float) -> int:
    """Whole turns to take off so that all values lie within the limits; 0 where they do, or where none does."""
    low, high = float(values.min()), float(values.max())
    if low >= lower - _SLACK and high <= upper + _SLACK:
        return 0
    turns = round((low + high - lower - upper) / (2 * _TURN))
    fits = low - turns * _TURN >= lower - _SLACK and high - turns * _TURN <= upper + _SLACK
    return turns if fits and abs(turns) <= _MOST_TURNS else 0


def _shifted(table: Table, quantity: str, turns: int) -> Table:
    if quantity not in table.columns:
        return table
    column = table.columns[quantity]
    away = turns * _TURN / column.factor

    def load() -> tuple[pl.DataFrame, np.ndarray]:
        frame, rows = table.load()
        numbers = pl.col(column.name).cast(pl.Float64, strict=False) - away
        return frame.with_columns(numbers), rows

    return replace(table, load=load, written=None)
