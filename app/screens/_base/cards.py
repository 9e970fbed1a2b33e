"""What the panel of the two-robot screen says."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.base.frame import in_parent
from app.calibration.base.wizard import Step
from app.calibration.result import Warning_
from app.estimation import HALF
from app.panel import markup as html
from app.screens._base.run import Run
from app.units import deg, mm

if TYPE_CHECKING:
    from app.screens.context import Context


def plan(context: Context, run: Run) -> str:
    """The steps: done, at hand, to come."""
    rows = []
    for k, step in enumerate(run.wizard.steps):
        mark = "●" if k < run.wizard.index else "▶" if k == run.wizard.index else "○"
        count = len(run.wizard.of(step.key))
        rows.append((f"{mark}  {named(context, step)}", str(count) if count else ""))
    return html.table(rows, testid="base-plan")


def named(context: Context, step: Step) -> str:
    """A step as the list has it."""
    kind = context.t(f"base.step_{step.kind}", **({"axis": step.axis} if step.axis else {}))
    return f"{context.t('base.robot_number', number=step.robot)} · {kind}"


def verdict(context: Context, run: Run) -> str:
    """How far two tools will miss each other, as a light; nothing before the relation is worked out."""
    t, relation = context.t, run.relation
    if relation is None:
        return ""
    severe = relation.T_base1_base2 is None
    colour = "red" if severe else "yellow" if _remarks(context, run) else "green"
    miss = f"{mm(relation.region_meeting):.2f}"
    sentence = t("base.light_none") if severe else t("base.light_found", miss=miss)
    return html.light(colour, sentence, testid="base-light")


def _remarks(context: Context, run: Run) -> list[tuple[Warning_, str]]:
    """What the checks of the relation and of both bases found, each with its words."""
    relation, language = run.relation, context.language
    found = [] if relation is None else [(w, w.said(language)) for w in relation.warnings]
    for number, base in enumerate(run.bases, 1):
        robot = context.t("base.robot_number", number=number)
        found += [(w, context.t("base.of_robot", robot=robot, words=w.said(language))) for w in base.warnings]
    return found


def result(context: Context, run: Run) -> str:
    """The relation beside the cell's hidden truth, and what the checks say."""
    t, relation = context.t, run.relation
    if relation is None:
        return ""
    found, out = _remarks(context, run), html.Markup("")
    if relation.T_base1_base2 is not None and (run.exam is None or run.exam.free):
        truth = run.cell.T_base1_base2
        gap = relation.T_base1_base2.inverse() @ truth
        half = HALF * np.sqrt(np.diag(in_parent(relation.T_base1_base2, relation.covariance)))
        position, true = mm(relation.T_base1_base2.position), mm(truth.position)
        rows = [
            (axis, f"{position[k]:.3f}", f"± {mm(half[k]):.3f}", f"{true[k]:.3f}")
            for k, axis in enumerate("XYZ")
        ]
        out += html.table(rows, head=("mm", t("base.found"), "95%", t("base.truth")), testid="base-relation")
        out += html.paragraph(
            t(
                "base.off",
                mm=f"{mm(float(np.linalg.norm(gap.position))):.3f}",
                deg=f"{deg(float(np.linalg.norm(gap.rotvec))):.4f}",
            ),
            testid="base-off",
        )
    elif relation.T_base1_base2 is not None:  # an exercise: its truth is told at its end
        half = HALF * np.sqrt(np.diag(in_parent(relation.T_base1_base2, relation.covariance)))
        rows = [
            (axis, f"{mm(relation.T_base1_base2.position[k]):.3f}", f"± {mm(half[k]):.3f}")
            for k, axis in enumerate("XYZ")
        ]
        out += html.table(rows, head=("mm", t("base.found"), "95%"), testid="base-relation")
    arcs = [
        (
            f"R{k} J{a.arc.axis}",
            f"{deg(a.length):.0f}°",
            f"{mm(a.radius):.1f}",
            f"{mm(a.rms):.3f}",
            f"{deg(HALF * a.sigma_axis):.4f}°",
        )
        for k, b in enumerate(run.bases, 1)
        for a in b.arcs
    ]
    out += html.table(
        arcs,
        head=(t("base.axis"), t("base.arc"), t("base.radius"), t("base.rms"), "± 95%"),
        testid="base-arcs",
    )
    out += (
        html.notes(
            [("red" if w.severe else "yellow", words) for w, words in found],
            testid="base-warnings",
        )
        if found
        else ""
    )
    return out
