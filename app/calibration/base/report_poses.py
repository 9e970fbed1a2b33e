"""Bases from poses, as JSON (teachframe.base/1 without arcs) and as text."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from app.calibration.base.poserelation import PoseRelation
from app.calibration.base.poses import PoseBase
from app.calibration.base.report import FORMAT, matrix_mm, pose_lines, warnings_json
from app.calibration.result import Warning_
from app.units import deg, mm


def poses_json(
    files: Sequence[Path],
    robots: Sequence[str],
    bases: Sequence[PoseBase],
    warnings: Sequence[Warning_],
    relation: PoseRelation | None,
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
            }
            for path, name, b in zip(files, robots, bases, strict=True)
        ],
    }


def poses_text(
    files: Sequence[Path],
    robots: Sequence[str],
    bases: Sequence[PoseBase],
    warnings: Sequence[Warning_],
    relation: PoseRelation | None,
) -> str:
    """A page for a person."""
    lines = []
    for path, name, b in zip(files, robots, bases, strict=True):
        sp, sr = mm(np.sqrt(np.diag(b.covariance)[:3])), deg(np.sqrt(np.diag(b.covariance)[3:]))
        x, y, z = mm(b.reflector)
        lines += [
            f"{path.name}: base of {name} from {b.count} poses (several axes moved at a time, so not from arcs)",
            f"  T_tracker_base   {pose_lines(b.T_tracker_base)}",
            f"                ± {sp[0]:>11.3f} {sp[1]:>11.3f} {sp[2]:>11.3f} mm   about X {sr[0]:.4f}, Y {sr[1]:.4f}, "
            f"Z {sr[2]:.4f} deg   (base link of the description)",
            f"  reflector at     {x:.2f}, {y:.2f}, {z:.2f} mm in the flange",
            f"  poses left out are predicted to {mm(b.heldout_rms):.3f} mm rms, worst {mm(float(b.heldout.max())):.3f} "
            f"(a coordinate of the poses fitted: {mm(b.fit.rms):.3f})",
        ]
    found = [*warnings, *(relation.warnings if relation else ())]
    if relation is not None:
        lines.append("two robots")
        if relation.T_base1_base2 is not None:
            lines.append(f"  T_base1_base2    {pose_lines(relation.T_base1_base2)}")
    lines += [f"  ! {w.code}: {w}" for w in found]
    return "\n".join(lines)
