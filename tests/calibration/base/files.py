"""Arc files written by hand for the tests: one cell, anything in it can be made wrong."""

from pathlib import Path

import numpy as np

from tests.calibration.base.cells import random_cells


def cell(seed=3, **options):
    """Points of one random cell: (first, second, T_tracker_base, towards), lengths in mm."""
    cells = random_cells(seed, 1, **options)
    truth = cells.truth[0].copy()
    truth[:3, 3] *= 1000.0
    return cells.first[0] * 1000.0, cells.second[0] * 1000.0, truth, cells.towards[0] * 1000.0


def write(
    path: Path, first, second, *, keys=(), angles=None, axes=(1, 2), extra=(), columns="axis,x_mm,y_mm,z_mm"
):
    """An arcs file; `angles` is a pair of lists in degrees, `extra` further lines. Returns the path."""
    with_angle = angles is not None
    lines = ["# kind: arcs", *[f"# {key}" for key in keys], columns + (",angle_deg" if with_angle else "")]
    for k, (axis, points) in enumerate(zip(axes, (first, second), strict=True)):
        for i, (x, y, z) in enumerate(points):
            tail = f",{angles[k][i]:.4f}" if with_angle else ""
            lines.append(f"{axis},{x:.4f},{y:.4f},{z:.4f}{tail}")
    path.write_text("\n".join([*lines, *extra]) + "\n", encoding="utf-8")
    return path


def first_row(keys=0):
    """Line number of the first data row of such a file."""
    return 3 + keys


def codes(result):
    """Codes of all warnings."""
    return {w["code"] for w in result.to_json()["warnings"]}


def turn_error(found, wanted):
    """Angle [rad] and distance [mm] between two 4x4 in mm."""
    relative = np.asarray(found)[:3, :3].T @ np.asarray(wanted)[:3, :3]
    angle = np.arccos(np.clip((np.trace(relative) - 1) / 2, -1, 1))
    return float(angle), float(np.linalg.norm(np.asarray(found)[:3, 3] - np.asarray(wanted)[:3, 3]))
