"""A tracker's list beside a list of joint angles of the same poses: one recording, row by row."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.errors import FileFormatError, InputError, MissingColumnError
from app.phrases import Said
from app.recordings.point_lists import KIND
from app.recordings.table import Table
from app.recordings.wording import phrase


def paired(points: Table, joints: Table) -> Table:
    """A recording of kind `tracker`: the joints' columns and keys, the points' coordinates.

    Args:
        points: a list of tracked points.
        joints: a table with q1… of the same poses in the same order; its further columns are taken along.

    Raises:
        InputError: not a list of points, or another number of rows.
        MissingColumnError: no joint columns.
    """
    if points.kind != KIND:
        raise InputError(
            "--joints goes with a list of tracked points",
            file=points.path,
            expected="a tracker program's export",
        )
    if not joints.numbered("q"):
        raise MissingColumnError(
            "no joint columns",
            file=joints.path,
            row=joints.header_row,
            column="q1_deg",
            expected="q1_deg, q2_deg, …",
        )
    if len(points) != len(joints):
        raise FileFormatError(
            f"{len(joints)} rows of joints",
            file=joints.path,
            expected=f"{len(points)}, as {points.path.name} has",
        )
    points.numbers("xyz")  # a cell that is no number, or a missing unit, is named by its own file
    kept = [name for name in joints.names if name not in points.names]
    frame = pl.concat([joints.body.select(kept), points.body], how="horizontal")
    keys: dict[str, Any] = {**points.keys, **joints.keys, "kind": "tracker"}
    keys["__header_row__"] = points.header_row
    said = Said(phrase("paired", points=points.path.name, joints=Path(joints.path).name, count=len(points)))
    rows = np.asarray(points.rows)
    return Table(
        points.path,
        keys,
        (*kept, *points.names),
        lambda: (frame, rows),
        notes=(*points.notes, *joints.notes, said),
    )
