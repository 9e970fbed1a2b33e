"""The sheet itself, by a template that escapes every text (Jinja2, autoescape)."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup, escape

from app.calibration.captures import of_role, stack
from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.report.cell_picture import cell_picture
from app.calibration.report.pictures import error_picture, tilt_picture, tool_picture
from app.calibration.solving import Solved
from app.calibration.vocabularies import vocabularies
from app.calibration.wording import FALLBACK, name_of, phrase
from app.estimation import HALF
from app.geometry import CONVENTIONS
from app.templating import templates
from app.units import deg, mm

#: Touches that are listed; with more, those that lie farthest off.
_MOST_ROWS = 12


def report(
    solved: Solved,
    *,
    name: str = "",
    made: str = "",
    operator: str = "",
    language: str = FALLBACK,
    of: str = "",
) -> str:
    """One solved points file as one sheet.

    Args:
        solved: the file and its result.
        name: of the tool.
        made: date and time as text; empty leaves a line to fill in.
        operator: name, likewise.
        language: of the sheet.
        of: what was taught, in that language, where the points are of no file.
    """
    return _Sheet(solved, name, made, operator, language, of).page()


class _Sheet:
    def __init__(self, solved: Solved, name: str, made: str, operator: str, language: str, of: str = ""):
        self._solved, self._result, self._points = solved, solved.result, solved.points
        self._name, self._made, self._operator, self._language = name, made, operator, language
        self._of = (of,) if of else (self._points.path.name, self._points.title)

    def _t(self, key: str, **fields: object) -> str:
        """A text of the sheet."""
        return phrase(f"sheet.{key}", **fields).text(self._language)

    def _drawn(self, key: str, **fields: object) -> str:
        """The same for a picture, which is markup already."""
        return str(escape(self._t(key, **fields)))

    def page(self) -> str:
        """The whole document."""
        solved, points, t = self._solved, self._points, self._t
        robot = points.robot.said("title", self._language) if points.robot else t("not_stated")
        head = [*self._of, t("robot", name=robot), self._made]
        measured = bool(len(self._result.residual_vectors))
        return (
            templates(__file__)
            .get_template("sheet.html")
            .render(
                t=t,
                language=self._language,
                title=t("title_named", name=self._name) if self._name else t("title"),
                file=self._of[0],
                head=[part for part in head if part],
                colour=solved.light.colour,
                colour_said=t("light", colour=phrase(f"light.{solved.light.colour}")),
                reason=solved.light.sentence(self._language),
                point_head=(t("point"), t("value"), "95% ±"),
                point=self._point(measured),
                angles=self._angles(),
                cones=self._cones(),
                pictures=self._pictures(measured),
                touches_head=self._touches_head(),
                touches=self._touches() if measured else (),
                more=self._more(),
                figures=self._figures() if measured else (),
                remarks=self._remarks(),
                method=self._method(),
                blanks=[t(key) for key in ("payload", "temperature", "spike", "tool_0")],
                signatures=((t("date"), self._made), (t("operator"), self._operator), (t("checked"), "")),
            )
        )

    def _pictures(self, measured: bool) -> dict[str, Markup]:
        result, points, t = self._result, self._points, self._drawn
        pictures = {"tool": tool_picture(result, t)}
        if measured:
            rotations, _ = stack(of_role(points.captures, "touch") or of_role(points.captures, "plane"))
            pictures["tilt"] = tilt_picture(rotations, t) if len(rotations) else ""
            pictures["error"] = error_picture(result, self._solved.left_out, t)
            pictures["cell"] = cell_picture(result, points.captures, points.robot, t)
        return {name: Markup(drawn) for name, drawn in pictures.items()}

    def _point(self, measured: bool) -> list[tuple[str, ...]]:
        result = self._result
        return [
            (axis, f"{value:.3f}", f"{half:.3f}" if measured else "-")
            for axis, value, half in zip("xyz", mm(result.tool_point), mm(half_widths(result)), strict=True)
        ]

    def _angles(self) -> list[tuple[str, str]]:
        rows = []
        for form in CONVENTIONS.values():
            numbers = form.from_rotation(self._result.T_flange_tool.rotation)
            radians = any(v.convention == form.key and v.angle_unit == "rad" for v in vocabularies().values())
            in_degrees = form.angular and not radians
            shown = deg(numbers) if in_degrees else numbers
            text = "\u2002".join(f"{v:.{3 if in_degrees else 5}f}" for v in shown)
            unit = "°" if in_degrees else " rad" if radians else ""
            rows.append((f"{form.key} ({form.makers[0]})", text + unit))
        return rows

    def _cones(self) -> list[str]:
        out = []
        for c in self._result.cones:
            fields = {"axis": c.axis.upper(), "stroke": mm(c.stroke), "deg": float(deg(c.half_angle))}
            out.append(self._t("cone" if c.stroke > 0 else "cone_seen", **fields))
        return out

    def _touches_head(self) -> list[str]:
        names = ("touch", "row", "error", "x", "y", "z", "shift", "heldout", "weight")
        return [name if len(name) == 1 else self._t(f"column_{name}") for name in names]

    def _touches(self) -> list[tuple[str, ...]]:
        result = self._result
        left = {entry.index: entry for entry in self._solved.left_out}
        order = range(len(result.per_point))
        if len(order) > _MOST_ROWS:  # one sheet stays one sheet
            order = sorted(np.argsort(-result.per_point)[:_MOST_ROWS].tolist())
        rows = []
        for i in order:
            out = left.get(i)
            rows.append(
                (
                    self._t("worst", touch=i + 1) if i == result.worst else str(i + 1),
                    str(result.rows[i]) if i < len(result.rows) else "-",
                    f"{mm(float(result.per_point[i])):.3f}",
                    *(f"{v:+.3f}" for v in mm(result.residual_vectors[i])),
                    f"{mm(out.shift):.3f}" if out else "-",
                    f"{mm(out.heldout):.3f}" if out else "-",
                    f"{result.weights[i]:.2f}" if i < len(result.weights) else "-",
                )
            )
        return rows

    def _more(self) -> str:
        more = len(self._result.per_point) - _MOST_ROWS
        return self._t("more_rows", count=more) if more > 0 else ""

    def _figures(self) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
        result, t = self._result, self._t
        region = " × ".join(f"{v:.2f}" for v in mm(ellipsoid(result).semi_axes)) if result.dof > 0 else "?"
        rounded = " / ".join(f"{v:.3f}" for v in HALF * mm(self._solved.rounding.sigma_tool))
        pairs = [
            (t("mean"), f"{mm(result.mean):.3f} mm"),
            (t("max"), t("max_touch", value=mm(result.max), touch=result.worst + 1)),
            (t("rms"), f"{mm(result.rms):.3f} mm"),
            (t("delta"), f"{mm(result.delta):.4f} mm"),
            (t("sigma"), t("sigma_dof", value=mm(result.sigma), dof=result.dof)),
            (t("region"), f"{region} mm"),
            (t("condition"), f"{result.condition:.2f}"),
            (t("rounding"), f"± {rounded} mm"),
        ]
        half = (len(pairs) + 1) // 2
        return pairs[:half], pairs[half:]

    def _remarks(self) -> list[tuple[str, str]]:
        """Name of a check, or "", and what it says."""
        language = self._language
        remarks = [(name_of(w.code, language), w.said(language)) for w in self._result.warnings]
        remarks += [("", gap.sentence(language)) for gap in self._solved.gaps]
        return remarks or [("", self._t("nothing"))]

    def _method(self) -> str:
        result, points = self._result, self._points
        form = points.written.convention
        read = phrase("sheet.read_poses", form=form.key) if form else phrase("sheet.read_joints")
        if not len(points.captures):
            read = phrase("sheet.read_typed")
        fields = {
            "method": phrase(f"method.{result.method}"),
            "axes": phrase(f"axes.{result.orientation}"),
            "count": len(points.captures),
        }
        return self._t("method", read=read, **fields)
