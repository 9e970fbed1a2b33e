"""The sheet itself."""

from __future__ import annotations

from html import escape

import numpy as np

from app.calibration.captures import of_role, stack
from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.report.pictures import distance_picture, tilt_picture, tool_picture
from app.calibration.solving import Solved
from app.geometry import CONVENTIONS
from app.units import deg, mm

_STYLE = """
@page { size: A4; margin: 11mm 14mm }
* { box-sizing: border-box }
body { font: 11px/1.35 system-ui, "Noto Sans", "Noto Sans CJK SC", sans-serif; color: #1d2733; max-width: 182mm;
  margin: 8mm auto; -webkit-print-color-adjust: exact; print-color-adjust: exact }
h1 { font-size: 18px; margin: 0 } h2 { font-size: 12px; margin: 9px 0 3px; border-bottom: 1px solid #cfd6dd }
.sub { color: #5b6876; margin: 0 0 6px } .row { display: flex; gap: 16px; align-items: flex-start }
.row > * { flex: 1 1 0; min-width: 0 } .row > .wide { flex: 1.5 1 0 }
svg { width: 100%; max-height: 170px; display: block } .tall svg { max-height: 200px }
table { border-collapse: collapse; width: 100% }
td, th { padding: 1px 6px 1px 0; text-align: right; white-space: nowrap }
th { font-weight: 600; color: #5b6876 } td:first-child, th:first-child { text-align: left }
.light { padding: 4px 9px; border-left: 6px solid; background: #f5f7f9; margin: 6px 0 }
.green { border-color: #2e8b57 } .yellow { border-color: #d9a520 } .red { border-color: #c0392b }
.blanks td { text-align: left } p { margin: 2px 0 } ul { margin: 2px 0; padding-left: 16px }
.sign { display: flex; gap: 24px; margin-top: 26px }
.sign div { flex: 1; border-top: 1px solid #1d2733; padding-top: 3px; color: #5b6876 }
.mono { font-variant-numeric: tabular-nums }
@media print {
  body { margin: 0; max-width: none } h2 { break-after: avoid } .row, table, .sign { break-inside: avoid }
}
"""


def report(solved: Solved, *, title: str = "Tool calibration", made: str = "", operator: str = "") -> str:
    """One solved points file as one sheet.

    Args:
        solved: the file and its result.
        title: heading.
        made: date and time as text; empty leaves a line to fill in.
        operator: name, likewise.
    """
    result, points = solved.result, solved.points
    touched = bool(len(result.residual_vectors))
    rotations, _ = stack(of_role(points.captures, "touch"))
    robot = points.robot.title if points.robot else "not stated"
    head = [points.path.name, *([points.title] if points.title else []), f"robot: {robot}"]
    blocks = [
        f"<h1>{escape(title)}</h1>",
        f'<p class="sub">{escape(" · ".join(head))}{escape(" · " + made) if made else ""}</p>',
        f'<div class="light {solved.light.colour}"><b>{solved.light.colour.upper()}</b> '
        f"{escape(solved.light.reason)}. {escape(solved.light.action)}.</div>",
        f'<div class="row tall"><div class="wide">{_frame(solved)}</div><div>{tool_picture(result)}</div></div>',
    ]
    if touched:
        pictures = distance_picture(result, solved.left_out)
        tilts = tilt_picture(rotations) if len(rotations) else ""
        blocks += [
            "<h2>Touches</h2>",
            f'<div class="row"><div class="wide">{pictures}</div><div>{tilts}</div></div>',
            _touches(solved),
            "<h2>Figures</h2>",
            _figures(solved),
        ]
    blocks += [_remarks(solved), _conditions(solved), _signatures(made, operator)]
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>{escape(title)}: {escape(points.path.name)}</title><style>{_STYLE}</style></head>\n<body>\n"
        + "\n".join(blocks)
        + "\n</body></html>\n"
    )


def _frame(solved: Solved) -> str:
    result = solved.result
    rows = ["<tr><th>tool point [mm]</th><th>value</th><th>std error</th><th>95% ±</th></tr>"]
    for axis, value, sigma, half in zip(
        "xyz", mm(result.tool_point), mm(result.sigma_tool), mm(half_widths(result)), strict=True
    ):
        rows.append(_row(axis, f"{value:.3f}", f"{sigma:.3f}", f"{half:.3f}"))
    angles = ["<tr><th>orientation</th><th></th></tr>"]
    for form in CONVENTIONS.values():
        numbers = form.from_rotation(result.T_flange_tool.rotation)
        shown = deg(numbers) if form.angular else numbers
        text = "&ensp;".join(f"{np.round(v, 4) + 0.0:.{3 if form.angular else 5}f}" for v in shown)
        makers = form.makers[0]
        angles.append(_row(f"{escape(form.key)} ({escape(makers)})", text + ("°" if form.angular else "")))
    cones = "".join(
        f"<li>{c.axis.upper()}: stroke {mm(c.stroke):.0f} mm, known to ± {deg(c.half_angle):.2f}° (95%)</li>"
        for c in result.cones
    )
    tables = "".join(f'<table class="mono">{"".join(r)}</table>' for r in (rows, angles))
    return f"<h2>Tool frame in the flange</h2>{tables}" + (f"<ul>{cones}</ul>" if cones else "")


def _touches(solved: Solved) -> str:
    result = solved.result
    left = {entry.index: entry for entry in solved.left_out}
    head = "<tr><th>touch</th><th>row</th><th>distance [mm]</th><th>x</th><th>y</th><th>z</th>"
    head += "<th>moves the tool by</th><th>missed by the others</th><th>weight</th></tr>"
    rows = [head]
    for i, (distance, vector) in enumerate(
        zip(mm(result.per_point), mm(result.residual_vectors), strict=True)
    ):
        out = left.get(i)
        rows.append(
            _row(
                f"{i + 1}{' (worst)' if i == result.worst else ''}",
                str(result.rows[i]),
                f"{distance:.3f}",
                *(f"{v:+.3f}" for v in vector),
                f"{mm(out.shift):.3f}" if out else "-",
                f"{mm(out.heldout):.3f}" if out else "-",
                f"{result.weights[i]:.2f}",
            )
        )
    return f'<table class="mono">{"".join(rows)}</table>'


def _figures(solved: Solved) -> str:
    result = solved.result
    region = " × ".join(f"{v:.2f}" for v in mm(ellipsoid(result).semi_axes)) if result.dof > 0 else "unknown"
    pairs = [
        ("mean distance (makers' figure)", f"{mm(result.mean):.3f} mm"),
        ("largest distance", f"{mm(result.max):.3f} mm, touch {result.worst + 1}"),
        ("rms distance", f"{mm(result.rms):.3f} mm"),
        ("delta, eq. (10)", f"{mm(result.delta):.4f} mm"),
        ("noise of a touch, one axis", f"{mm(result.sigma):.3f} mm ({result.dof} dof)"),
        ("95% region, half axes", f"{region} mm"),
        ("condition", f"{result.condition:.2f}"),
        (
            "rounding of the file, tool point",
            " / ".join(f"{v:.3f}" for v in mm(solved.rounding.sigma_tool)) + " mm",
        ),
    ]
    half = (len(pairs) + 1) // 2
    tables = "".join(
        f'<table class="mono">{"".join(_row(escape(a), escape(b)) for a, b in part)}</table>'
        for part in (pairs[:half], pairs[half:])
    )
    return f'<div class="row">{tables}</div>'


def _remarks(solved: Solved) -> str:
    remarks = [f"<b>{escape(w.code)}</b>: {escape(str(w))}" for w in solved.result.warnings]
    remarks += [escape(gap.sentence()) for gap in solved.gaps]
    if not remarks:
        remarks = ["No check found anything to remark."]
    return "<h2>Remarks</h2><ul>" + "".join(f"<li>{remark}</li>" for remark in remarks) + "</ul>"


def _conditions(solved: Solved) -> str:
    result, form = solved.result, solved.points.written.convention
    read = f"flange poses, angles {form.key}" if form else "joint angles"
    text = f"Method {result.method}, axes {result.orientation}; read as {read}; {len(solved.points.captures)} points."
    lines = ("Payload mounted", "Temperature", "Spike or gauge", "Tool 0 active while teaching")
    blanks = "".join(f"<td>{line}: ________</td>" for line in lines)
    return f'<h2>Conditions</h2><p>{escape(text)}</p><table class="blanks"><tr>{blanks}</tr></table>'


def _signatures(made: str, operator: str) -> str:
    fields = (("Date", made), ("Operator", operator), ("Checked by", ""))
    return (
        '<div class="sign">'
        + "".join(f"<div>{n}{': ' + escape(v) if v else ''}</div>" for n, v in fields)
        + "</div>"
    )


def _row(*cells: str) -> str:
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
