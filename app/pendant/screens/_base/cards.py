"""What the panel of the two-robot screen says."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.pendant import html
from app.pendant.screens._base.run import Run
from app.units import deg, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant


def plan(pendant: Pendant, run: Run) -> str:
    """The steps: done, at hand, to come."""
    rows = []
    for k, step in enumerate(run.wizard.steps):
        mark = "●" if k < run.wizard.index else "▶" if k == run.wizard.index else "○"
        kind = (
            pendant.t(f"base.step_{step.kind}", axis=step.axis)
            if step.axis
            else pendant.t(f"base.step_{step.kind}")
        )
        count = len(run.wizard.of(step.key))
        robot = pendant.t("base.robot_number", number=step.robot)
        rows.append((f"{mark}  {robot} · {kind}", str(count) if count else ""))
    return html.table(rows, testid="base-plan")


def result(pendant: Pendant, run: Run) -> str:
    """The relation beside the cell's hidden truth, and what the checks say."""
    t, relation = pendant.t, run.relation
    if relation is None:
        return ""
    found = list(relation.warnings) + [w for b in run.bases for w in b.warnings]
    severe = relation.T_base1_base2 is None
    colour = "red" if severe else "yellow" if found else "green"
    sentence = (
        t("base.light_none") if severe else t("base.light_found", miss=f"{mm(relation.sigma_meeting):.2f}")
    )
    out = html.light(colour, sentence, testid="base-light")
    if relation.T_base1_base2 is not None and (run.exam is None or run.exam.free):
        truth = run.cell.T_base1_base2
        gap = relation.T_base1_base2.inverse() @ truth
        sigma = np.sqrt(np.diag(relation.covariance))
        position, true = mm(relation.T_base1_base2.position), mm(truth.position)
        rows = [
            (axis, f"{position[k]:.3f}", f"± {mm(sigma[k]):.3f}", f"{true[k]:.3f}")
            for k, axis in enumerate("XYZ")
        ]
        out += html.table(rows, head=("mm", t("base.found"), "", t("base.truth")), testid="base-relation")
        out += html.paragraph(
            t(
                "base.off",
                mm=f"{mm(float(np.linalg.norm(gap.position))):.3f}",
                deg=f"{deg(float(np.linalg.norm(gap.rotvec))):.4f}",
            ),
            testid="base-off",
        )
    elif relation.T_base1_base2 is not None:  # an exercise: its truth is told at its end
        sigma = np.sqrt(np.diag(relation.covariance))
        rows = [
            (axis, f"{mm(relation.T_base1_base2.position[k]):.3f}", f"± {mm(sigma[k]):.3f}")
            for k, axis in enumerate("XYZ")
        ]
        out += html.table(rows, head=("mm", t("base.found"), ""), testid="base-relation")
    arcs = [
        (
            f"{k}.{a.arc.axis}",
            f"{deg(a.length):.0f}°",
            f"{mm(a.radius):.1f}",
            f"{mm(a.rms):.3f}",
            f"{deg(a.sigma_axis):.4f}°",
        )
        for k, b in enumerate(run.bases, 1)
        for a in b.arcs
    ]
    out += html.table(arcs, head=(t("base.axis"), t("base.arc"), "r mm", "rms mm", "± "), testid="base-arcs")
    out += (
        html.notes(
            [("red" if w.severe else "yellow", w.said(pendant.language)) for w in found],
            testid="base-warnings",
        )
        if found
        else ""
    )
    return out
