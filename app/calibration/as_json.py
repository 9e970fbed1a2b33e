"""A tool frame as JSON: teachframe.tool/1, millimetres and degrees, plain lists.

The first fields are the contract's; behind them stands everything that the page of text says, so that a program sees
the light and its reason and not the numbers alone.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from app.calibration.next_touch.advised import advised_touch
from app.calibration.quality.region import ellipsoid
from app.calibration.result import ToolCalibration
from app.calibration.solving import Solved
from app.errors import DegenerateGeometryError
from app.units import deg, mm

FORMAT = "teachframe.tool/1"


def tool_json(result: ToolCalibration) -> dict[str, Any]:
    """The contract's object, and what else the result itself holds."""
    matrix = np.array(result.T_flange_tool.matrix)
    matrix[:3, 3] = mm(matrix[:3, 3])
    return {
        "format": FORMAT,
        "T_flange_tool": matrix.tolist(),
        "tool_mm": mm(result.tool_point).tolist(),
        "quaternion_wxyz": result.T_flange_tool.quaternion.tolist(),
        "delta_mm": mm(result.delta),
        "per_point_mm": mm(result.per_point).tolist(),
        "mean_mm": mm(result.mean),
        "max_mm": mm(result.max),
        "rms_mm": mm(result.rms),
        "sigma_tool_mm": mm(result.sigma_tool).tolist(),
        "condition": result.condition,
        "warnings": [
            {
                "code": w.code,
                "message": str(w),
                "severity": "severe" if w.severe else "note" if w.note else "look",
            }
            for w in result.warnings
        ],
        "method": result.method,
        "orientation": result.orientation,
        "touched_mm": mm(result.p_base).tolist(),
        "sigma_touch_mm": mm(result.sigma),
        "dof": result.dof,
        "rows": list(result.rows),
        "weights": result.weights.tolist(),
        "region_mm": _region(result),
        "axes": [
            {
                "axis": cone.axis,
                "stroke_mm": mm(cone.stroke),
                "sigma_deg": deg(cone.sigma),
                "cone_95_deg": deg(cone.half_angle),
            }
            for cone in result.cones
        ],
    }


def solved_json(solved: Solved) -> dict[str, Any]:
    """The same with what was made of the file it came from."""
    result, points, light = solved.result, solved.points, solved.light
    return {
        **tool_json(result),
        "file": points.path.name,
        "title": points.title,
        "note": points.note,
        "robot": None if points.robot is None else points.robot.name,
        "flange": None if points.robot is None else points.robot.flange,
        "light": {"colour": light.colour, "reason": light.reason, "action": light.action},
        "rounding": {
            "sigma_tool_mm": mm(solved.rounding.sigma_tool).tolist(),
            "touch_mm": mm(solved.rounding.touch),
            "columns": list(solved.rounding.columns),
        },
        "gaps": [
            {
                "name": gap.name,
                "gap_mm": mm(gap.gap).tolist(),
                "sigmas": [float(v) if np.isfinite(v) else None for v in gap.sigmas],
                "explained_by": gap.explained_by,
                "p_value": gap.p_value,
                "sentence": gap.sentence(),
            }
            for gap in solved.gaps
        ],
        "left_out": [
            {"touch": left.index + 1, "shift_mm": mm(left.shift), "heldout_mm": mm(left.heldout)}
            for left in solved.left_out
        ],
        "next_touch": _next_touch(solved),
    }


def _region(result: ToolCalibration) -> dict[str, Any] | None:
    """Half axes of the 95% region and where its longest one points in the flange."""
    if result.dof <= 0 or not len(result.residual_vectors):
        return None
    region = ellipsoid(result)
    return {"semi_axes": mm(region.semi_axes).tolist(), "longest_along": region.directions[:, 0].tolist()}


def _next_touch(solved: Solved) -> dict[str, Any] | None:
    found = advised_touch(solved)
    if found is None:
        return None
    if isinstance(found, DegenerateGeometryError):
        return {"none_because": str(found)}
    matrix = np.array(found.T_base_flange.matrix)
    matrix[:3, 3] = mm(matrix[:3, 3])
    return {
        "T_base_flange": matrix.tolist(),
        "q_rad_or_m": None if found.q is None else found.q.tolist(),
        "error_now_mm": _finite_mm(found.now),
        "error_after_mm": _finite_mm(found.after),
        "sentence": found.sentence(),
    }


def _finite_mm(value: float) -> float | None:
    return mm(value) if np.isfinite(value) else None
