"""A tool calibration as a piece of page: light, numbers with their uncertainty, each touch, remarks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.quality.region import ellipsoid, half_widths
from app.calibration.solving import Solved
from app.calibration.wording import name_of
from app.estimation import HALF
from app.geometry import CONVENTIONS
from app.panel import markup as html
from app.scene.region import cone_factor, region_factor
from app.scene.residuals import magnification
from app.screens._tool.words import Words
from app.units import deg, mm

if TYPE_CHECKING:
    from app.screens.context import Context


def light_html(solved: Solved, language: str, todo: str = "") -> str:
    """The traffic light with its reason and what to do next: `todo`, where that is not the result's own any more."""
    return html.light(solved.light.colour, solved.light.sentence(language, todo))


def named(name: str, sentence: str) -> str:
    """What a check found, under the check's name."""
    return f"{name[:1].upper()}{name[1:]}: {sentence}"


def result_html(context: Context, solved: Solved) -> str:
    """Everything else about one result."""
    details = [_tool(context, solved), _figures(context, solved), _touches(context, solved)]
    remarks = _remarks(context, solved)
    severe = [note for note in remarks if note[0] == "red"]
    return (
        _headline(context, solved)
        + html.notes(severe, testid="severe")
        + html.more(context.t("tool.details"), html.joined(details) + html.notes(remarks), testid="details")
    )


def _headline(context: Context, solved: Solved) -> str:
    """The three numbers that are read first: the tool's own error, the makers' mean, the worst touch."""
    t, result = context.t, solved.result
    if not len(result.residual_vectors):
        return ""
    known = f"± {mm(ellipsoid(result).semi_axes[0]):.2f} mm" if result.sigma > 0 else "?"
    return html.facts(
        [
            (t("result.known"), known),
            (t("result.mean_short"), f"{mm(result.mean):.2f} mm"),
            (t("result.worst_short", touch=result.worst + 1), f"{mm(result.max):.2f} mm"),
        ],
        testid="headline",
    )


def _tool(context: Context, solved: Solved) -> str:
    t, result = context.t, solved.result
    point, half = mm(result.tool_point), mm(half_widths(result))
    measured = bool(len(result.residual_vectors))
    rows = [
        (axis, f"{value:.3f}", f"± {error:.3f}" if measured and np.isfinite(error) else "?")
        for axis, value, error in zip("xyz", point, half, strict=True)
    ]
    form = CONVENTIONS[context.convention]
    numbers = form.from_rotation(result.T_flange_tool.rotation)
    words = Words(context)
    if form.angular and not words.radians(form.key):
        shown = [f"{v:.2f}°" for v in deg(numbers)]
    else:
        shown = [f"{v:.5f}" for v in numbers]
    names = " ".join(words.angles(form.key)) + (" [rad]" if words.radians(form.key) else "")
    out = html.table(
        rows, head=(t("result.axis"), t("result.value"), t("result.sigma")), testid="tool-point"
    ) + html.table([(names, "  ".join(shown))], testid="tool-angles")
    if len(result.residual_vectors) and result.sigma > 0:
        sizes = " × ".join(f"{v:.2f}" for v in mm(ellipsoid(result).semi_axes))
        words = t("result.region", sizes=sizes, factor=region_factor(result))
        out += html.paragraph(words, faint=True, testid="region")
    for cone in result.cones:
        known = {"axis": cone.axis.upper(), "deg": f"{deg(cone.half_angle):.2f}", "factor": cone_factor(cone)}
        key = "result.cone" if cone.stroke > 0 else "result.cone_seen"
        out += html.paragraph(t(key, mm=f"{mm(cone.stroke):.0f}", **known), faint=True, testid="cone")
    return out


def _figures(context: Context, solved: Solved) -> str:
    t, result = context.t, solved.result
    if not len(result.residual_vectors):
        return ""
    length = lambda value: t("result.mm", value=f"{mm(value):.3f}")  # noqa: E731
    mean, largest = t("result.mean"), t("result.max", touch=result.worst + 1)
    maker = Words(context).vocabulary
    if maker is not None:  # the makers' two figures under the makers' names
        words = maker.words.get(context.language, maker.words["en"])
        mean, largest = f"{words.mean} ({maker.title})", f"{words.max} ({result.worst + 1})"
    rows = [
        (mean, length(result.mean)),
        (largest, length(result.max)),
        (t("result.rms"), length(result.rms)),
        (t("result.noise", dof=result.dof), length(result.sigma) if result.dof > 0 else "?"),
        (t("result.delta"), t("result.mm", value=f"{mm(result.delta):.5f}")),
        (t("result.condition"), f"{result.condition:.2f}"),
    ]
    return html.table(rows, testid="figures")


def _touches(context: Context, solved: Solved) -> str:
    t, result = context.t, solved.result
    if not len(result.residual_vectors):
        return ""
    left = {entry.index: entry for entry in solved.left_out}
    rows = [
        (
            t("result.worst", touch=i + 1) if i == result.worst else str(i + 1),
            f"{mm(float(miss)):.3f}",
            f"{mm(left[i].shift):.2f}" if i in left else "-",
            f"{mm(left[i].heldout):.2f}" if i in left else "-",
        )
        for i, miss in enumerate(result.per_point)
    ]
    head = (t("result.touch"), t("result.miss"), t("result.shift"), t("result.heldout"))
    return html.table(rows, head=head, testid="touches") + html.paragraph(
        t("result.arrows", factor=magnification(result)), faint=True, testid="arrows"
    )


def _remarks(context: Context, solved: Solved) -> list[tuple[str, str]]:
    """Warnings first, then what the written digits explain."""
    t, result, effect = context.t, solved.result, solved.rounding
    out = [
        (
            "red" if w.severe else "blue" if w.note else "yellow",
            named(name_of(w.code, context.language), w.said(context.language)),
        )
        for w in result.warnings
    ]
    half = HALF * mm(effect.sigma_tool)
    if len(result.residual_vectors) and half.max() >= 5e-4:
        x, y, z = (f"{v:.2f}" for v in half)
        out.append(("blue", t("result.rounding", x=x, y=y, z=z, columns=", ".join(effect.columns[:3]))))
        if result.sigma > 0:
            share = effect.touch / result.sigma
            fields = {"touch": f"{mm(effect.touch):.3f}", "found": f"{mm(result.sigma):.3f}"}
            key = "result.rounding_all" if share > 0.8 else "result.rounding_part"
            out.append(("blue", t(key, share=f"{100 * min(share**2, 1.0):.0f}", **fields)))
    for gap in solved.gaps:
        key = {"rounding": "gap_rounding", "touch noise": "gap_noise"}.get(gap.explained_by, "gap_nothing")
        x, y, z = (f"{v:+.3f}" for v in mm(gap.gap))
        most = float(np.max(np.abs(gap.sigmas))) / HALF
        words = t(f"result.{key}", name=gap.title(context.language), x=x, y=y, z=z, most=f"{most:.1f}")
        out.append(("red" if key == "gap_nothing" else "blue", words))
    return out
