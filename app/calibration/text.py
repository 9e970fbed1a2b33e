"""A solved points file as a page of text."""

from __future__ import annotations

import numpy as np

from app.calibration.captures import of_role, stack
from app.calibration.next_touch import propose
from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.result import ToolCalibration
from app.calibration.solving import Solved
from app.errors import DegenerateGeometryError
from app.geometry import CONVENTIONS
from app.units import deg, mm

_METHODS = {
    "joint": "joint fit of tool point and touched point (order-free)",
    "pairwise": "neighbouring differences (Xiong 2012, eqs. 6-9; depends on the order)",
    "robust": "joint fit, far-off touches count less (none is dropped)",
}
_ORIENTATIONS = {
    "default": "the flange's own axes",
    "z": "Z by a stroke, X the flange's made square",
    "zx": "X by a stroke, Z by a stroke made square (eqs. 15-18)",
    "xy": "X by a stroke, Y by a stroke made square",
}


def page(solved: Solved) -> str:
    """Everything about one file, for a person at a terminal."""
    result = solved.result
    blocks = [_head(solved), _point(result), _axes(result)]
    if len(result.residual_vectors):
        blocks += [_touches(solved), _figures(result)]
    blocks += [_rounding(solved), _verdict(solved), _next_touch(solved)]
    return "\n\n".join("\n".join(block) for block in blocks if block)


def _head(solved: Solved) -> list[str]:
    result, points = solved.result, solved.points
    lines = [f"{points.path.name}: {len(points.captures)} points, {len(result.residual_vectors)} touches"]
    if points.title:
        lines.append(points.title)
    if points.note:
        lines.append("note: " + points.note)
    lines.append("position: " + _METHODS.get(result.method, result.method))
    lines.append("axes: " + _ORIENTATIONS.get(result.orientation, result.orientation))
    return lines


def _point(result: ToolCalibration) -> list[str]:
    point, sigma, half = mm(result.tool_point), mm(result.sigma_tool), mm(half_widths(result))
    lines = ["tool point in the flange [mm]   value   std error   95% interval"]
    for axis, value, error, width in zip("xyz", point, sigma, half, strict=True):
        lines.append(f"  {axis}                      {value:>12.4f} {error:>10.3f}   ± {width:.3f}")
    if result.dof > 0:
        region = ellipsoid(result)
        long = ", ".join(f"{v:.2f}" for v in region.directions[:, 0])
        sizes = " x ".join(f"{v:.2f}" for v in mm(region.semi_axes))
        lines.append(f"  95% region: half axes {sizes} mm, the longest along ({long}) of the flange")
    return lines


def _axes(result: ToolCalibration) -> list[str]:
    rotation = result.T_flange_tool.rotation
    lines = ["R_flange_tool (columns: the tool's X, Y, Z in the flange)"]
    lines += ["  " + " ".join(f"{v + 0.0:>9.5f}" for v in np.round(row, 9)) for row in rotation]
    for form in CONVENTIONS.values():
        numbers = form.from_rotation(rotation)
        shown = deg(numbers) if form.angular else numbers
        places, unit = (4, "deg") if form.angular else (6, "")
        text = " ".join(f"{np.round(v, places) + 0.0:.{places}f}" for v in shown)
        lines.append(f"  {form.key:<11}{text} {unit:<4} {', '.join(form.makers)}".rstrip())
    for cone in result.cones:
        known = f"known to ± {deg(cone.half_angle):.3f} deg (95% cone)"
        lines.append(f"  {cone.axis.upper()} shown by a stroke of {mm(cone.stroke):.1f} mm: {known}")
    return lines


def _touches(solved: Solved) -> list[str]:
    result = solved.result
    left = {entry.index: entry for entry in solved.left_out}
    weighted = result.method == "robust"
    head = "touch   row  distance to the touched point [mm]"
    head += "   without it the tool moves by   the others miss it by" if left else ""
    lines = [head + ("   weight" if weighted else "")]
    for i, distance in enumerate(mm(result.per_point)):
        mark = "worst" if i == result.worst else ""
        line = f"{i + 1:>5}{result.rows[i]:>6}{distance:>15.3f} {mark:<21}"
        if left:
            shown = f"{mm(left[i].shift):>16.3f}{mm(left[i].heldout):>29.3f}" if i in left else f"{'':>45}"
            line += shown + " " * 10
        lines.append((line + (f"{result.weights[i]:>9.2f}" if weighted else "")).rstrip())
    return lines


def _figures(result: ToolCalibration) -> list[str]:
    return [
        f"mean distance   {mm(result.mean):.4f} mm     (what makers show; it does not see geometry)",
        f"max distance    {mm(result.max):.4f} mm     (touch {result.worst + 1})",
        f"rms distance    {mm(result.rms):.4f} mm",
        f"delta           {mm(result.delta):.5f} mm    (eq. 10: norm of the neighbouring differences)",
        f"sigma           {mm(result.sigma):.4f} mm     (noise of one touch on one axis, "
        f"{result.dof} degrees of freedom)",
        f"condition       {result.condition:.4f}        (1 is best; above 10 tilt more, about two axes)",
    ]


def _rounding(solved: Solved) -> list[str]:
    effect, result = solved.rounding, solved.result
    if not len(result.residual_vectors):
        return []
    sigma = mm(effect.sigma_tool)
    if sigma.max() < 5e-4:
        lines = ["rounding: the written digits move the tool point by less than 0.001 mm"]
    else:
        text = ", ".join(f"{a} {v:.3f}" for a, v in zip("xyz", sigma, strict=True))
        lines = [
            f"rounding: the written digits alone scatter the tool point by {text} mm (one standard deviation), "
            f"mostly through {_list(effect.columns[:3])}"
        ]
        if result.sigma > 0:
            share = effect.touch / result.sigma
            whole = "all of" if share > 0.8 else f"{100 * min(share**2, 1):.0f}% of the variance of"
            lines.append(
                f"          a touch scatters by {mm(effect.touch):.3f} mm from rounding alone, "
                f"found were {mm(result.sigma):.3f} mm: rounding explains {whole} the residual"
            )
    return lines + [gap.sentence() for gap in solved.gaps]


def _verdict(solved: Solved) -> list[str]:
    lines = [str(solved.light)]
    return lines + [f"warning {warning.code}: {warning}" for warning in solved.result.warnings]


def _next_touch(solved: Solved) -> list[str]:
    """The touch that would help most, in the file's own convention."""
    result, points = solved.result, solved.points
    touches = of_role(points.captures, "touch")
    if solved.light.colour == "green" or result.method not in _METHODS or not result.sigma > 0:
        return []
    rotations, _ = stack(touches)
    try:
        found = propose(
            rotations,
            tool=result.tool_point,
            spike=result.p_base,
            touches=len(touches) + 1,
            noise=result.sigma,
            robot=points.robot,
            q_near=touches[-1].q,
        )
    except DegenerateGeometryError as error:
        return [f"no next touch to propose: {error}"]
    form = points.written.convention or CONVENTIONS["ZYX"]
    numbers = form.from_rotation(found.T_base_flange.rotation)
    names = [f"{n} {v:.1f}" for n, v in zip("xyz", mm(found.T_base_flange.position), strict=True)]
    shown = deg(numbers) if form.angular else numbers
    names += [f"{n} {v:.{1 if form.angular else 4}f}" for n, v in zip(form.columns, shown, strict=True)]
    lines = [
        f"best next touch: flange at {', '.join(names)} (mm, {'deg, ' if form.angular else ''}{form.key})"
    ]
    if found.q is not None and points.robot is not None:
        joints = [
            f"{mm(v):.1f} mm" if joint.prismatic else f"{deg(v):.1f} deg"
            for v, joint in zip(found.q, points.robot.joints, strict=True)
        ]
        lines.append("                 joints " + ", ".join(joints))
    return [*lines, "                 " + found.sentence()]


def _list(names: tuple[str, ...]) -> str:
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]
