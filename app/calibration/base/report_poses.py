"""Bases from poses, as JSON (teachframe.base/1 without arcs) and as text."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from app.calibration.base.poserelation import PoseRelation
from app.calibration.base.poses import PoseBase
from app.calibration.base.report import FORMAT, half_line, matrix_mm, pose_lines, remark_lines, warnings_json
from app.calibration.base.wording import TEXTS
from app.calibration.result import Warning_
from app.phrases import FALLBACK, padded
from app.units import deg, mm


def poses_json(
    files: Sequence[Path],
    robots: Sequence[str],
    bases: Sequence[PoseBase],
    warnings: Sequence[Warning_],
    relation: PoseRelation | None,
    rows: Sequence[np.ndarray],
) -> dict[str, Any]:
    """The contract's object; `T_tracker_base` is the base link of the description."""
    frames = [matrix_mm(b.T_tracker_base) for b in bases]
    found = [*warnings, *(relation.warnings if relation else ())]
    return {
        "format": FORMAT,
        "T_tracker_base": frames if relation else frames[0],
        "T_base1_base2": matrix_mm(relation.T_base1_base2) if relation and relation.T_base1_base2 else None,
        "arcs": [],
        "warnings": warnings_json(found),
        "frame": "base link of the description",
        "robots": [
            {
                "file": str(path),
                "robot": name,
                "poses": b.count,
                "fit_rms_mm": mm(b.fit.rms),
                "heldout_rms_mm": mm(b.heldout_rms),
                "sigma_mm": mm(np.sqrt(np.diag(b.covariance)[:3])).tolist(),
                "sigma_deg": deg(np.sqrt(np.diag(b.covariance)[3:])).tolist(),
                "reflector_mm": mm(b.reflector).tolist(),
                "worst_mm": mm(float(b.heldout.max())),
                "wrist_deg": deg(b.wrist),
                "condition": b.fit.condition,
                "outliers": [
                    {"row": int(lines[i]), "off_mm": mm(off)} for i, off in zip(b.aside, b.off, strict=True)
                ],
            }
            for path, name, b, lines in zip(files, robots, bases, rows, strict=True)
        ],
    }


def poses_text(
    files: Sequence[Path],
    robots: Sequence[str],
    bases: Sequence[PoseBase],
    warnings: Sequence[Warning_],
    relation: PoseRelation | None,
    language: str = FALLBACK,
) -> str:
    """A page for a person."""

    def t(key: str, **fields: Any) -> str:
        return TEXTS.text(f"poses.{key}", language, **fields)

    lines = []
    for path, name, b in zip(files, robots, bases, strict=True):
        sigma = np.sqrt(np.diag(b.covariance))
        x, y, z = mm(b.reflector)
        worst = mm(float(b.heldout.max()))
        lines += [
            t("title", file=path.name, robot=name, count=b.count),
            f"  T_tracker_base   {pose_lines(b.T_tracker_base)}",
            half_line(sigma[:3], sigma[3:], t("frame"), language),
            f"  {padded(t('reflector'), -17)}{t('reflector_at', x=x, y=y, z=z)}",
            "  " + t("heldout", rms=mm(b.heldout_rms), worst=worst, fit=mm(b.fit.rms)),
        ]
    found = [*warnings, *(relation.warnings if relation else ())]
    if relation is not None:
        lines.append(TEXTS.text("report.two", language))
        if relation.T_base1_base2 is not None:
            lines.append(f"  T_base1_base2    {pose_lines(relation.T_base1_base2)}")
    return "\n".join(lines + remark_lines(found, language=language))
