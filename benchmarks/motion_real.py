"""Torque of a real arm predicted on runs the model has not seen, joint by joint and step by step.

    python -m benchmarks.motion_real [FOLDER]      the folder with run_a.csv (learnt), run_b.csv, run_c.csv (judged)

Steps: the description alone; its masses fitted within their prior; dry and viscous friction; all that was found.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np

from app.diagnosis.motion.engine import ready
from app.diagnosis.motion.errors import ErrorTable
from app.diagnosis.motion.sampling import take_samples
from app.diagnosis.motion.study import examine
from app.kinematics import load_robot
from app.recordings import read_table

STEPS = ("description", "+ masses", "+ dry, viscous friction", "+ all found")


def run(folder: Path) -> dict[str, np.ndarray]:
    """File -> (steps, n) root mean square error [Nm] of a model learnt on run_a alone."""
    learnt = read_table(folder / "run_a.csv")
    robot = load_robot(learnt.keys["robot"], relative_to=folder)
    log, motion, _ = ready(learnt, robot)
    study = examine(log, robot, motion, lambda share, what: None, 0)
    table = ErrorTable(
        study.system,
        study.prior,
        [t.group for t in study.fit.terms],
        study.samples.y - study.fit.offset,
        study.done,
    )
    friction = [
        i for i, t in enumerate(study.fit.terms) if t.group.label in ("coulomb_friction", "viscous_friction")
    ]
    lasting = [
        i for i, t in enumerate(study.fit.terms) if t.group.law is not None and not t.group.law.windowed
    ]
    out = {}
    for name in ("run_b.csv", "run_c.csv"):
        new, moved, _ = ready(read_table(folder / name), robot)
        raw = take_samples(new, robot, moved, new.y, lambda share, what: None)
        rows = [_rms(raw.y, raw.usable)]
        for terms in ([], friction, lasting):
            theta = table._theta(*table.all, table._keep(terms))
            residual = raw.y.copy()
            at = study.system.inertial_size
            for j in range(residual.shape[1]):
                residual[:, j] -= raw.regressor[:, :, j] @ theta[:at]
            for i, term in enumerate(study.fit.terms):
                group, law = term.group, term.group.law
                assert law is not None
                part = theta[at : at + len(law.linear)]
                at += group.size
                if i not in terms:
                    continue
                columns = raw.pool(law.columns(raw.state, group.where, group.shape))
                if group.joint is None:
                    residual -= columns @ part
                else:
                    residual[:, group.joint] -= columns @ part
            rows.append(_rms(residual, raw.usable))
        out[name] = np.array(rows)
    return out


def _rms(residual: np.ndarray, usable: np.ndarray) -> np.ndarray:
    return np.array([np.sqrt(np.mean(r[u] ** 2)) for r, u in zip(residual.T, usable.T, strict=True)])


def main(folder: Path) -> None:
    for name, table in run(folder).items():
        joints = "".join(f"{'joint ' + str(j + 1):>9}" for j in range(table.shape[1]))
        print(
            f"{folder.name}/{name}: error on it of a model learnt on run_a [Nm]\n{'':<26}{joints}{'all':>9}"
        )
        for step, row in zip(STEPS, table, strict=True):
            print(f"{step:<26}" + "".join(f"{v:>9.3f}" for v in row) + f"{np.sqrt(np.mean(row**2)):>9.3f}")


if __name__ == "__main__":
    data = Path(os.environ.get("TEACHFRAME_DATA", Path(__file__).parents[2] / "shared" / "data"))
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else data / "ur10e_motion")
