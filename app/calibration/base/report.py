"""A base calibration as JSON (teachframe.base/1, `sigma_…` one-sigma) and as a page of text (95%, as the screens)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from app.calibration.base.arcfit import ArcFit
from app.calibration.base.relation import Relation
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import TEXTS
from app.calibration.result import Warning_
from app.estimation import HALF
from app.figures import unsigned
from app.geometry import Pose
from app.geometry.conventions import convention
from app.phrases import FALLBACK, Phrase, padded
from app.units import deg, mm

FORMAT = "teachframe.base/1"


def matrix_mm(pose: Pose) -> list[list[float]]:
    """4x4 rows, lengths in mm."""
    m = pose.matrix.copy()
    m[:3, 3] = mm(m[:3, 3])
    return m.tolist()


def warnings_json(warnings: Sequence[Warning_]) -> list[dict[str, str]]:
    """The contract's list of warnings."""
    return [{"code": w.code, "message": str(w)} for w in warnings]


def arc_json(found: ArcFit, robot: int) -> dict[str, Any]:
    """One arc; lengths in mm, angles in degrees."""
    moved = {} if found.moved_at is None else {"moved_at_row": found.moved_at, "moved_mm": mm(found.moved_by)}
    return {
        "axis": found.arc.axis,
        "radius_mm": mm(found.radius),
        "arc_deg": deg(found.length),
        "rms_mm": mm(found.rms),
        "sigma_axis_deg": deg(found.sigma_axis),
        "robot": robot,
        "points": int(found.used.sum()),
        "direction": found.axes.direction.tolist(),
        "centre_mm": mm(found.centre).tolist(),
        "sigma_centre_mm": mm(found.sigma_centre),
        "noise_mm": mm(found.sigma),
        "rows_set_aside": sorted(found.outliers),
        **moved,
    }


def details_json(base: BaseCalibration) -> dict[str, Any]:
    """What the contract leaves open, for one robot."""
    out: dict[str, Any] = {
        "file": str(base.source.path),
        "sigma_mm": mm(base.sigma_position).tolist(),
        "sigma_deg": deg(base.sigma_rotation).tolist(),
        "covariance_m_rad": base.covariance.tolist(),
        "axis_distance_mm": mm(base.offset),
        "sigma_axis_distance_mm": mm(base.offset_sigma),
        "axis_angle_deg": deg(base.angle),
        "sigma_axis_angle_deg": deg(base.angle_sigma),
        "joint1_during_axis2_deg": deg(base.zero.angle) if base.zero and base.zero.known else None,
        "T_tracker_maker": None,
        "T_base_maker": None,
        "robot": base.source.robot,
        "notes": [str(note) for note in base.notes],
    }
    if base.maker is not None:
        out |= {
            "robot": base.maker.robot,
            "T_tracker_maker": matrix_mm(base.maker.T_tracker_maker),
            "T_base_maker": matrix_mm(base.maker.T_base_maker),
            "axis_distance_nominal_mm": mm(base.maker.offset_nominal),
        }
    return out


def base_json(bases: Sequence[BaseCalibration], relation: Relation | None) -> dict[str, Any]:
    """The contract's object for one robot, or for two and their relation."""
    found = []
    for number, b in enumerate(bases, 1):
        whose = f"robot {number}, " if len(bases) > 1 else ""
        found += [replace(w, message=whose + w.message) for w in b.warnings]
    found += list(relation.warnings) if relation else []
    frames = [matrix_mm(b.T_tracker_base) for b in bases]
    out: dict[str, Any] = {
        "format": FORMAT,
        "T_tracker_base": frames if relation else frames[0],
        "T_base1_base2": matrix_mm(relation.T_base1_base2) if relation and relation.T_base1_base2 else None,
        "arcs": [arc_json(a, number) for number, b in enumerate(bases, 1) for a in b.arcs],
        "warnings": warnings_json(found),
        "robots": [details_json(b) for b in bases],
    }
    if relation:
        makers = [b.maker.T_tracker_maker if b.maker else None for b in bases]
        out["relation"] = {
            "T_maker1_maker2": matrix_mm(makers[0].inverse() @ makers[1])
            if relation.T_base1_base2
            and makers[0]
            and makers[1]
            and not (relation.drift and relation.drift.moved)
            else None,
            "meeting_mm": mm(relation.meeting).tolist(),
            "sigma_meeting_mm": mm(relation.sigma_meeting),
            "region_meeting_mm": mm(relation.region_meeting),
            "covariance_m_rad": relation.covariance.tolist(),
            "notes": [str(note) for note in relation.notes],
        }
    return out


def pose_lines(pose: Pose) -> str:
    """Position and angles on one line."""
    x, y, z = mm(pose.position)
    a, b, c = deg(np.asarray(convention("ZYX").from_rotation(pose.rotation)))
    return f"{x:>11.3f} {y:>11.3f} {z:>11.3f} mm   A {a:>9.4f}  B {b:>9.4f}  C {c:>9.4f} deg"


def half_line(sigma_position: np.ndarray, sigma_rotation: np.ndarray, frame: str, language: str) -> str:
    """The 95% half widths under a pose, from one-sigma (3,) [m] and (3,) [rad] along and about its axes."""
    sp, sr = HALF * mm(sigma_position), HALF * deg(sigma_rotation)
    about = TEXTS.text("report.about", language, x=float(sr[0]), y=float(sr[1]), z=float(sr[2]))
    return f"          95% ± {sp[0]:>13.3f} {sp[1]:>11.3f} {sp[2]:>11.3f} mm   {about}   {frame}"


def remark_lines(
    warnings: Sequence[Warning_], notes: Sequence[Phrase] = (), language: str = FALLBACK
) -> list[str]:
    """What the checks found and what no check can settle."""
    found = [f"  ! {w.code}: {w.said(language)}" for w in warnings]
    return found + [f"  · {note.text(language)}" for note in notes]


def base_text(base: BaseCalibration, language: str = FALLBACK) -> str:
    """What an operator reads about one robot."""

    def t(key: str, **fields: Any) -> str:
        return TEXTS.text(f"report.{key}", language, **fields)

    lines = [f"{base.source.path.name}"]
    heads = (("rows", 5), ("arc", 9), ("radius", 12), ("rms", 9), ("tilt", 16), ("centre", 17))
    lines.append(f"  {padded(t('axis'), -6)}" + "".join(padded(t(key), width) for key, width in heads))
    lines += [
        f"  {a.arc.axis:<6}{int(a.used.sum()):>5}{deg(a.length):>9.1f}{mm(a.radius):>12.3f}{mm(a.rms):>9.4f}"
        f"{HALF * deg(a.sigma_axis):>16.5f}{HALF * mm(a.sigma_centre):>17.4f}"
        for a in base.arcs
    ]
    lines.append(f"  T_tracker_base   {pose_lines(base.T_tracker_base)}")
    lines.append(half_line(base.sigma_position, base.sigma_rotation, t("frame"), language))
    if base.maker is not None:
        whose = t("maker", robot=base.maker.robot)
        lines.append(f"  T_tracker_maker  {pose_lines(base.maker.T_tracker_maker)}   {whose}")
    beside = {"nominal": mm(base.maker.offset_nominal)} if base.maker else {}
    apart = t(
        "apart_beside" if beside else "apart",
        offset=mm(base.offset),
        offset_half=HALF * mm(base.offset_sigma),
        angle=deg(base.angle),
        angle_half=HALF * deg(base.angle_sigma),
        **beside,
    )
    lines.append(f"  {padded(t('axes'), -17)}{apart}")
    return unsigned("\n".join(lines + remark_lines(base.warnings, base.notes, language)))


def relation_text(relation: Relation, language: str = FALLBACK) -> str:
    """What an operator reads about two robots."""
    lines = [TEXTS.text("report.two", language)]
    if relation.T_base1_base2 is not None:
        x, y, z = mm(relation.meeting)
        miss = mm(relation.region_meeting)
        lines.append(f"  T_base1_base2    {pose_lines(relation.T_base1_base2)}")
        lines.append("  " + TEXTS.text("report.meeting", language, x=x, y=y, z=z, miss=miss))
    return unsigned("\n".join(lines + remark_lines(relation.warnings, relation.notes, language)))
