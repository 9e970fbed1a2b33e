"""Writes a joint log as the contract has it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from app.proof.generator.files import joint_columns, term_json, write_csv
from app.proof.generator.motion.making import MadeMotion


def write_motion(made: MadeMotion, path: Path, robot: str, more: Mapping[str, str] | None = None) -> None:
    """The CSV of a motion recording; `robot` is what its header names, with `more` beside it."""
    plan, cell = made.plan, made.cell
    header: dict[str, Any] = {"kind": "motion", "robot": robot, **(more or {})}
    if plan.currents:
        header["drive_gain_Nm_per_A"] = "[" + ", ".join(f"{g:.3f}" for g in made.gains) + "]"
    if plan.stated:
        header["noise_Nm"] = "[" + ", ".join(f"{s:.5g}" for s in made.sigma) + "]"
    columns = {"t_s": [f"{t:.6f}" for t in cell.t]}
    columns |= joint_columns(cell.arm.slides, made.q, "q", 7)
    if made.commanded is not None:
        columns |= joint_columns(cell.arm.slides, made.commanded, "qc", 7)
    if plan.speeds:
        for j, values in enumerate(made.qd.T):
            unit = "m_s" if cell.arm.slides[j] else "rad_s"
            columns[f"qd{j + 1}_{unit}"] = [f"{v:.6f}" for v in values]
    for j, values in enumerate(made.torque.T):
        if plan.currents:
            columns[f"i{j + 1}_A"] = [f"{v:.6f}" for v in values / made.gains[j]]
        else:
            columns[f"tau{j + 1}_Nm"] = [f"{v:.5f}" for v in values]
    if plan.temperatures:
        for j, values in enumerate(made.temperature.T):
            columns[f"temperature{j + 1}_degC"] = [f"{v:.2f}" for v in values]
    write_csv(path, header, columns)


def motion_truth(made: MadeMotion) -> dict[str, Any]:
    """What is true of a log, JSON types only."""
    return {
        "format": "teachframe.truth/1",
        "kind": "motion",
        "effects": [
            {**term_json(term), "raw_rms_Nm": [float(v) for v in raw]}
            for term, raw in zip(made.terms, made.raw_rms, strict=True)
        ],
        "friction_everywhere": [term_json(term) for term in made.everywhere],
        "noise_Nm": [float(s) for s in made.sigma],
        "noise_kind": made.plan.noise_kind,
    }
