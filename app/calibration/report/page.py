"""The sheet itself."""

from __future__ import annotations

from html import escape

import numpy as np

from app.calibration.captures import of_role, stack
from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.report.cell_picture import cell_picture
from app.calibration.report.pictures import distance_picture, tilt_picture, tool_picture
from app.calibration.solving import Solved
from app.calibration.wording import FALLBACK, name_of, phrase
from app.geometry import CONVENTIONS
from app.units import deg, mm

#: Touches that are listed; with more, those that lie farthest off.
_MOST_ROWS = 12

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


def report(
    solved: Solved,
    *,
    name: str = "",
    made: str = "",
    operator: str = "",
    language: str = FALLBACK,
) -> str:
    """One solved points file as one sheet.

    Args:
        solved: the file and its result.
        name: of the tool.
        made: date and time as text; empty leaves a line to fill in.
        operator: name, likewise.
        language: of the sheet.
    """
    return _Sheet(solved, name, made, operator, language).page()


class _Sheet:
    def __init__(self, solved: Solved, name: str, made: str, operator: str, language: str):
        self._solved, self._result, self._points = solved, solved.result, solved.points
        self._name, self._made, self._operator, self._language = name, made, operator, language

    def _t(self, key: str, **fields: object) -> str:
        """A text of the sheet, safe to stand in it."""
        return escape(phrase(f"sheet.{key}", **fields).text(self._language))

    def page(self) -> str:
        """The whole document."""
        solved, result, points, t = self._solved, self._result, self._points, self._t
        title = t("title_named", name=self._name) if self._name else t("title")
        robot = points.robot.title if points.robot else phrase("sheet.not_stated").text(self._language)
        head = [escape(points.path.name), *([escape(points.title)] if points.title else [])]
        head += [t("robot", name=robot), *([escape(self._made)] if self._made else [])]
        colour = escape(phrase(f"light.{solved.light.colour}").text(self._language))
        blocks = [
            f"<h1>{title}</h1>",
            f'<p class="sub">{" · ".join(head)}</p>',
            f'<div class="light {solved.light.colour}"><b>{colour}</b> '
            f"{escape(solved.light.sentence(self._language))}</div>",
            f'<div class="row tall"><div class="wide">{self._frame()}</div>'
            f"<div>{tool_picture(result, t)}</div></div>",
        ]
        if len(result.residual_vectors):
            rotations, _ = stack(of_role(points.captures, "touch") or of_role(points.captures, "plane"))
            tilts = tilt_picture(rotations, t) if len(rotations) else ""
            blocks += [
                f"<h2>{t('touches')}</h2>",
                f'<div class="row"><div class="wide">{distance_picture(result, solved.left_out, t)}</div>'
                f"<div>{tilts}</div><div>{cell_picture(result, points.captures, points.robot, t)}</div></div>",
                self._touches(),
                f"<h2>{t('figures')}</h2>",
                self._figures(),
            ]
        blocks += [self._remarks(), self._conditions(), self._signatures()]
        return (
            f'<!doctype html>\n<html lang="{self._language}"><head><meta charset="utf-8">'
            f"<title>{title}: {escape(points.path.name)}</title><style>{_STYLE}</style></head>\n<body>\n"
            + "\n".join(blocks)
            + "\n</body></html>\n"
        )

    def _frame(self) -> str:
        result, t = self._result, self._t
        rows = [_head(t("point"), t("value"), t("error"), "95% ±")]
        measured = bool(len(result.residual_vectors))
        for axis, value, sigma, half in zip(
            "xyz", mm(result.tool_point), mm(result.sigma_tool), mm(half_widths(result)), strict=True
        ):
            known = (f"{sigma:.3f}", f"{half:.3f}") if measured else ("-", "-")
            rows.append(_row(axis, f"{value:.3f}", *known))
        angles = [_head(t("orientation"), "")]
        for form in CONVENTIONS.values():
            numbers = form.from_rotation(result.T_flange_tool.rotation)
            shown = deg(numbers) if form.angular else numbers
            text = "&ensp;".join(f"{np.round(v, 4) + 0.0:.{3 if form.angular else 5}f}" for v in shown)
            makers = form.makers[0]
            angles.append(
                _row(f"{escape(form.key)} ({escape(makers)})", text + ("°" if form.angular else ""))
            )
        cones = ""
        for c in result.cones:
            fields = {"axis": c.axis.upper(), "stroke": mm(c.stroke), "deg": float(deg(c.half_angle))}
            cones += f"<li>{t('cone' if c.stroke > 0 else 'cone_seen', **fields)}</li>"
        tables = "".join(f'<table class="mono">{"".join(r)}</table>' for r in (rows, angles))
        return f"<h2>{t('frame')}</h2>{tables}" + (f"<ul>{cones}</ul>" if cones else "")

    def _touches(self) -> str:
        result, t = self._result, self._t
        left = {entry.index: entry for entry in self._solved.left_out}
        names = ("touch", "row", "distance", "x", "y", "z", "shift", "heldout", "weight")
        rows = [_head(*(name if len(name) == 1 else t(f"column_{name}") for name in names))]
        order = range(len(result.per_point))
        if len(order) > _MOST_ROWS:  # one sheet stays one sheet
            order = sorted(np.argsort(-result.per_point)[:_MOST_ROWS].tolist())
        for i in order:
            out = left.get(i)
            rows.append(
                _row(
                    t("worst", touch=i + 1) if i == result.worst else str(i + 1),
                    str(result.rows[i]) if i < len(result.rows) else "-",
                    f"{mm(float(result.per_point[i])):.3f}",
                    *(f"{v:+.3f}" for v in mm(result.residual_vectors[i])),
                    f"{mm(out.shift):.3f}" if out else "-",
                    f"{mm(out.heldout):.3f}" if out else "-",
                    f"{result.weights[i]:.2f}" if i < len(result.weights) else "-",
                )
            )
        more = len(result.per_point) - _MOST_ROWS
        note = f"<p>{t('more_rows', count=more)}</p>" if more > 0 else ""
        return f'<table class="mono">{"".join(rows)}</table>{note}'

    def _figures(self) -> str:
        result, t = self._result, self._t
        region = " × ".join(f"{v:.2f}" for v in mm(ellipsoid(result).semi_axes)) if result.dof > 0 else "?"
        rounded = " / ".join(f"{v:.3f}" for v in mm(self._solved.rounding.sigma_tool))
        pairs = [
            (t("mean"), f"{mm(result.mean):.3f} mm"),
            (t("max"), t("max_touch", value=mm(result.max), touch=result.worst + 1)),
            (t("rms"), f"{mm(result.rms):.3f} mm"),
            (t("delta"), f"{mm(result.delta):.4f} mm"),
            (t("sigma"), t("sigma_dof", value=mm(result.sigma), dof=result.dof)),
            (t("region"), f"{region} mm"),
            (t("condition"), f"{result.condition:.2f}"),
            (t("rounding"), f"{rounded} mm"),
        ]
        half = (len(pairs) + 1) // 2
        tables = "".join(
            f'<table class="mono">{"".join(_row(a, b) for a, b in part)}</table>'
            for part in (pairs[:half], pairs[half:])
        )
        return f'<div class="row">{tables}</div>'

    def _remarks(self) -> str:
        language = self._language
        remarks = [
            f"<b>{escape(name_of(w.code, language))}</b>: {escape(w.said(language))}"
            for w in self._result.warnings
        ]
        remarks += [escape(gap.sentence(language)) for gap in self._solved.gaps]
        items = "".join(f"<li>{remark}</li>" for remark in remarks or [self._t("nothing")])
        return f"<h2>{self._t('remarks')}</h2><ul>{items}</ul>"

    def _conditions(self) -> str:
        result, points, t = self._result, self._points, self._t
        form = points.written.convention
        read = phrase("sheet.read_poses", form=form.key) if form else phrase("sheet.read_joints")
        if not len(points.captures):
            read = phrase("sheet.read_typed")
        fields = {"method": result.method, "axes": result.orientation, "count": len(points.captures)}
        blanks = "".join(
            f"<td>{t(key)}: ________</td>" for key in ("payload", "temperature", "spike", "tool_0")
        )
        table = f'<table class="blanks"><tr>{blanks}</tr></table>'
        return f"<h2>{t('conditions')}</h2><p>{t('method', read=read, **fields)}</p>{table}"

    def _signatures(self) -> str:
        t = self._t
        fields = ((t("date"), self._made), (t("operator"), self._operator), (t("checked"), ""))
        lines = (f"<div>{name}{': ' + escape(value) if value else ''}</div>" for name, value in fields)
        return '<div class="sign">' + "".join(lines) + "</div>"


def _head(*cells: str) -> str:
    return "<tr>" + "".join(f"<th>{cell}</th>" for cell in cells) + "</tr>"


def _row(*cells: str) -> str:
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
