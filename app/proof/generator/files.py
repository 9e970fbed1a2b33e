"""Writes recordings as the contract has them; truth goes beside them and into nothing else."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from app.files import write_text
from app.proof.generator.effects.term import Term
from app.proof.generator.rotations import to_quaternion
from app.proof.generator.static.making import Made
from app.units import mm


def write_static(
    made: Made,
    path: Path,
    robot: str,
    order: Sequence[int] | None = None,
    more: Mapping[str, str] | None = None,
) -> None:
    """The CSV of a touch or tracker recording.

    Args:
        robot: what its header names.
        order: which row (from 0) stands first, second …; without it as they were taken.
        more: further header keys, beside `robot`.
    """
    plan, cell = made.plan, made.cell
    header: dict[str, Any] = {"kind": plan.kind, "robot": robot, **(more or {})}
    if plan.stated:
        header["noise_mm"] = f"{mm(plan.noise):.6g}"
    if np.any(cell.load_kg):
        header["payload_com_m"] = "[" + ", ".join(f"{v:g}" for v in cell.load_at) + "]"
    if cell.compliance is not None:
        header["compliance_rad_per_Nm"] = "[" + ", ".join(f"{v:.6g}" for v in cell.compliance) + "]"
    columns = joint_columns(cell.arm.slides, cell.q, "q", 8)
    columns["t_s"] = [f"{t:.3f}" for t in cell.t]
    if plan.kind == "touch":
        columns["target"] = [f"T{k + 1}" for k in cell.target]
        if plan.known_targets:
            for axis, values in zip("xyz", made.points[:, 0].T, strict=True):
                columns[f"target_{axis}_mm"] = [f"{mm(v):.4f}" for v in values]
    elif made.lengths is not None:
        columns["length_mm"] = [f"{mm(v):.4f}" for v in made.lengths]
    else:
        for index in range(made.points.shape[1]):
            mark = "" if index == 0 else str(index + 1)
            for axis, values in zip("xyz", made.points[:, index].T, strict=True):
                columns[f"{axis}{mark}_mm"] = [f"{mm(v):.4f}" for v in values]
    if made.orientations is not None:
        for name, values in zip(("qw", "qx", "qy", "qz"), to_quaternion(made.orientations).T, strict=True):
            columns[name] = [f"{v:.9f}" for v in values]
    if made.torques is not None:
        for j, values in enumerate(made.torques.T):
            columns[f"tau{j + 1}_Nm"] = [f"{v:.4f}" for v in values]
    if np.any(cell.load_kg):
        columns["payload_kg"] = [f"{v:g}" for v in cell.load_kg]
    if plan.repeats and plan.labelled:
        columns["pose"] = [f"P{k}" for k in made.pose]
    if plan.sessions > 1:
        columns["session"] = [f"S{k + 1}" for k in cell.session]
    if order is not None:
        columns = {name: [cells[i] for i in order] for name, cells in columns.items()}
    write_csv(path, header, columns)


def joint_columns(slides: np.ndarray, q: np.ndarray, prefix: str, digits: int) -> dict[str, list[str]]:
    """Columns of joint positions; sliding joints in metres."""
    return {
        f"{prefix}{j + 1}_{'m' if slides[j] else 'rad'}": [f"{v:.{digits}f}" for v in q[:, j]]
        for j in range(q.shape[1])
    }


def write_csv(path: Path, header: Mapping[str, Any], columns: Mapping[str, Sequence[str]]) -> None:
    """`# key: value` lines, one header row, rows; whole or not at all."""
    lines = [f"# {key}: {value}" for key, value in header.items()]
    lines.append(",".join(columns))
    lines += [",".join(row) for row in zip(*columns.values(), strict=True)]
    write_text(path, "\n".join(lines) + "\n")


def truth_of(made: Made) -> dict[str, Any]:
    """What is true of a static recording, JSON types only."""
    return {
        "format": "teachframe.truth/1",
        "kind": made.plan.kind,
        "effects": [
            {**term_json(term), "raw_rms_mm": mm(raw)}
            for term, raw in zip(made.terms, made.raw_rms, strict=True)
        ],
        "noise_mm": mm(made.plan.noise),
        "noise_kind": made.plan.noise_kind,
        "outlier_rows": [int(i) + 1 for i in made.outliers],
        "tools_mm": mm(made.cell.tools).tolist(),
    }


def term_json(term: Term) -> dict[str, Any]:
    """An effect with its values in SI."""
    return {"effect": term.effect, "where": dict(term.where), "parameters": dict(term.parameters)}


def write_truth(path: Path, truth: Mapping[str, Any]) -> None:
    write_text(path, json.dumps(truth, indent=1) + "\n")


def truth_path(recording: Path) -> Path:
    """OUT.csv -> OUT.truth.json."""
    return (
        recording.with_suffix(".truth.json")
        if recording.suffix
        else recording.with_name(recording.name + ".truth.json")
    )


def read_rows(path: Path) -> tuple[dict[str, str], dict[str, list[str]]]:
    """Header keys and columns of a file written here, as text."""
    lines = path.read_text(encoding="utf-8").splitlines()
    header = {}
    while lines[0].startswith("#"):
        key, _, value = lines.pop(0).lstrip("# ").partition(": ")
        header[key] = value
    names = lines.pop(0).split(",")
    cells = zip(*(line.split(",") for line in lines), strict=True)
    return header, {name: list(column) for name, column in zip(names, cells, strict=True)}
