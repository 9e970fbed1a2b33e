"""A solved points file as a page of text."""

from __future__ import annotations

from app.calibration.next_touch.advised import advised_touch
from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.solving import Solved
from app.calibration.wording import FALLBACK, Phrase, name_of, phrase
from app.errors import DegenerateGeometryError
from app.estimation import HALF
from app.figures import unsigned
from app.geometry import CONVENTIONS
from app.phrases import padded
from app.units import deg, mm


def page(solved: Solved, language: str = FALLBACK) -> str:
    """Everything about one file, for a person at a terminal."""
    return unsigned(_Page(solved, language).text())


class _Page:
    def __init__(self, solved: Solved, language: str):
        self._solved, self._result, self._points = solved, solved.result, solved.points
        self._language = language

    def _t(self, key: str, **fields: object) -> str:
        return phrase(f"page.{key}", **fields).text(self._language)

    def text(self) -> str:
        """All blocks, an empty line between them."""
        blocks = [self._head(), self._point(), self._axes()]
        if len(self._result.residual_vectors):
            blocks += [self._touches(), self._figures()]
        blocks += [self._rounding(), self._verdict(), self._next_touch()]
        return "\n\n".join("\n".join(block) for block in blocks if block)

    def _head(self) -> list[str]:
        result, points, t = self._result, self._points, self._t
        lines = [
            t(
                "head",
                file=points.path.name,
                points=len(points.captures),
                touches=len(result.residual_vectors),
            )
        ]
        if points.title:
            lines.append(points.title)
        if points.note:
            lines.append(t("note", text=points.note))
        arm = points.robot
        if arm is not None:
            lines.append(t("arm", robot=arm.title, joints=arm.joint_count, base=arm.base, flange=arm.flange))
        lines.append(t("position", how=phrase(f"method.{result.method}")))
        lines.append(t("axes", how=phrase(f"axes.{result.orientation}")))
        return lines

    def _point(self) -> list[str]:
        result = self._result
        point, half = mm(result.tool_point), mm(half_widths(result))
        lines = [self._t("point_head")]
        for axis, value, width in zip("xyz", point, half, strict=True):
            lines.append(f"  {axis}                      {value:>12.4f}   ± {width:.3f}")
        if result.dof > 0:
            region = ellipsoid(result)
            long = ", ".join(f"{v:.2f}" for v in region.directions[:, 0])
            sizes = " x ".join(f"{v:.2f}" for v in mm(region.semi_axes))
            lines.append(self._t("region", sizes=sizes, along=long))
        return lines

    def _axes(self) -> list[str]:
        rotation = self._result.T_flange_tool.rotation
        lines = [self._t("rotation")]
        lines += ["  " + " ".join(f"{v:>9.5f}" for v in row) for row in rotation]
        for form in CONVENTIONS.values():
            numbers = form.from_rotation(rotation)
            shown = deg(numbers) if form.angular else numbers
            places, unit = (4, "deg") if form.angular else (6, "")
            text = " ".join(f"{v:z.{places}f}" for v in shown)
            lines.append(f"  {form.key:<11}{text} {unit:<4} {', '.join(form.makers)}".rstrip())
        for cone in self._result.cones:
            fields = {"axis": cone.axis.upper(), "stroke": mm(cone.stroke)}
            lines.append(self._t("cone", deg=float(deg(cone.half_angle)), **fields))
        return lines

    def _touches(self) -> list[str]:
        result, t = self._result, self._t
        left = {entry.index: entry for entry in self._solved.left_out}
        weighted = result.method == "robust"
        head = t("touch_head") + (t("touch_head_left") if left else "")
        lines = [(head + (t("touch_head_weight") if weighted else "")).rstrip()]
        worst = result.worst
        for i, distance in enumerate(mm(result.per_point)):
            mark = padded(t("worst") if i == worst else "", -21)
            line = f"{i + 1:>5}{result.rows[i]:>6}{distance:>15.3f} {mark}"
            if left:
                shown = (
                    f"{mm(left[i].shift):>16.3f}{mm(left[i].heldout):>29.3f}" if i in left else f"{'':>45}"
                )
                line += shown + " " * 10
            lines.append((line + (f"{result.weights[i]:>9.2f}" if weighted else "")).rstrip())
        return lines

    def _figures(self) -> list[str]:
        result, t = self._result, self._t
        return [
            t("mean", value=mm(result.mean)),
            t("max", value=mm(result.max), touch=result.worst + 1),
            t("rms", value=mm(result.rms)),
            t("delta", value=mm(result.delta)),
            t("sigma", value=mm(result.sigma), dof=result.dof),
            t("condition", value=result.condition),
        ]

    def _rounding(self) -> list[str]:
        effect, result, t = self._solved.rounding, self._result, self._t
        if not len(result.residual_vectors):
            return []
        half = HALF * mm(effect.sigma_tool)
        if half.max() < 5e-4:
            lines = [t("rounding_none")]
        else:
            text = ", ".join(f"{a} {v:.3f}" for a, v in zip("xyz", half, strict=True))
            lines = [t("rounding", half=text, columns=_list(effect.columns[:3]))]
            if result.sigma > 0:
                share = effect.touch / result.sigma
                fields = {"touch": mm(effect.touch), "found": mm(result.sigma)}
                key = "rounding_all" if share > 0.8 else "rounding_part"
                lines.append(t(key, share=100 * min(share**2, 1), **fields))
        return lines + [gap.sentence(self._language) for gap in self._solved.gaps]

    def _verdict(self) -> list[str]:
        language = self._language
        lines = [self._solved.light.said(language)]
        for warning in self._result.warnings:
            code = warning.code if language == FALLBACK else name_of(warning.code, language)
            lines.append(self._t("warning", code=code, said=warning.said(language)))
        return lines

    def _next_touch(self) -> list[str]:
        """The touch that would help most, in the file's own convention."""
        points, t = self._points, self._t
        found = advised_touch(self._solved)
        if found is None:
            return []
        if isinstance(found, DegenerateGeometryError):
            return [t("no_next", why=found.said if isinstance(found.said, Phrase) else str(found))]
        form = points.written.convention or CONVENTIONS["ZYX"]
        numbers = form.from_rotation(found.T_base_flange.rotation)
        names = [f"{n} {v:.1f}" for n, v in zip("xyz", mm(found.T_base_flange.position), strict=True)]
        shown = deg(numbers) if form.angular else numbers
        names += [f"{n} {v:.{1 if form.angular else 4}f}" for n, v in zip(form.columns, shown, strict=True)]
        lines = [t("next" if form.angular else "next_plain", numbers=", ".join(names), form=form.key)]
        if found.q is not None and points.robot is not None:
            joints = [
                f"{mm(v):.1f} mm" if joint.prismatic else f"{deg(v):.1f} deg"
                for v, joint in zip(found.q, points.robot.joints, strict=True)
            ]
            lines.append(t("next_joints", joints=", ".join(joints)))
        return [*lines, t("next_brings", said=found.sentence(self._language))]


def _list(names: tuple[str, ...]) -> Phrase | str:
    return names[0] if len(names) == 1 else phrase("page.and", several=", ".join(names[:-1]), last=names[-1])
