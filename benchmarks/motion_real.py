"""Torque of a real arm predicted on runs the model has not seen, and what changed between two of them.

    python -m benchmarks.motion_real [FOLDER]      the folder with run_a.csv (learnt), run_b.csv, run_c.csv (judged)

Without FOLDER: ur10e_motion of TEACHFRAME_DATA.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np

from app.diagnosis.motion import STEPS, diagnose, judged_on
from app.diagnosis.result import Diagnosis
from app.kinematics import load_robot
from app.recordings import read_table
from benchmarks.rows import Row


def run() -> list[Row]:
    """Held-out torque error of what was named on run_a, beside the description alone, on every other run."""
    folder = recorded()
    if not folder.is_dir():
        return []
    learnt = read_table(folder / "run_a.csv")
    robot = load_robot(learnt.keys["robot"], relative_to=folder)
    others = [read_table(p) for p in sorted(folder.glob("run_[b-z].csv"))]
    rows = []
    for judged in judged_on(learnt, others, robot):
        error = dict(zip(STEPS, np.sqrt(np.mean(judged.errors**2, axis=1)), strict=True))
        rows.append(
            Row(
                f"torque error on {judged.file}, learnt on run_a",
                float(error["+ what was named"]),
                float(error[STEPS[0]]),
                "the description alone",
                "Nm",
            )
        )
    return rows


def recorded() -> Path:
    """Where the recordings are."""
    data = Path(os.environ.get("TEACHFRAME_DATA", Path(__file__).parents[2] / "shared" / "data"))
    return data / "ur10e_motion"


def table(folder: Path) -> None:
    """Held-out error of a model learnt on run_a, and of one learnt on itself for runs without a second."""
    learnt = read_table(folder / "run_a.csv")
    robot = load_robot(learnt.keys["robot"], relative_to=folder)
    for judged in judged_on(learnt, [read_table(p) for p in sorted(folder.glob("run_[b-z].csv"))], robot):
        joints = "".join(f"{'joint ' + str(j + 1):>9}" for j in range(judged.errors.shape[1]))
        print(f"{judged.file}: torque error on it of a model learnt on run_a.csv [Nm]")
        print(f"{'':<34}{joints}{'all':>9}")
        for step, row in zip(STEPS, judged.errors, strict=True):
            print(f"{step:<34}" + "".join(f"{v:>9.3f}" for v in row) + f"{np.sqrt(np.mean(row**2)):>9.3f}")


def changed(folder: Path) -> None:
    """What run_c has that run_b has not, and what the description alone would have claimed of run_c."""
    new, old = read_table(folder / "run_c.csv"), read_table(folder / "run_b.csv")
    robot = load_robot(new.keys["robot"], relative_to=folder)
    tell("run_c.csv against run_b.csv (--reference)", diagnose(new, robot, reference=old))
    tell("run_b.csv against run_c.csv, the other way round", diagnose(old, robot, reference=new))
    tell("run_c.csv against the description alone", diagnose(new, robot))


def tell(title: str, found: Diagnosis) -> None:
    print(
        f"\n{title}: {found.verdict}, held-out {found.before.heldout_rms:.3f} -> {found.after.heldout_rms:.3f} Nm"
    )
    for finding in found.findings:
        values = ", ".join(
            f"{p.name} {p.value:.4g} ± {p.std:.2g} {p.unit}".rstrip() for p in finding.parameters
        )
        where = " ".join(f"{k}={v}" for k, v in finding.where.items())
        others = ", ".join(
            f"{a.effect} {a.where.get('joint', a.where.get('link', ''))}".rstrip()
            for a in finding.alternatives
        )
        print(f"  {finding.effect} {where}: {values}" + (f"; or {others}" if others else ""))
    for note in found.notes:
        print(f"  - {note}")


if __name__ == "__main__":
    chosen = Path(sys.argv[1]) if len(sys.argv) > 1 else recorded()
    table(chosen)
    if (chosen / "run_c.csv").exists():
        changed(chosen)
