"""Static diagnosis from 60 to 10,000 poses with 199 nulls, and a full geometric fit beside scipy's differences.

Run: python -m benchmarks.static_diagnosis
"""

from __future__ import annotations

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is imported; one thread for both sides
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from app.diagnosis.kinematic.diagnose import diagnose
from app.diagnosis.models.kinematic.candidates import library_of
from app.diagnosis.models.kinematic.rows import even_weights
from app.diagnosis.models.kinematic.setup import moved
from app.diagnosis.models.kinematic.state import (
    State,
    columns_of,
    free_columns,
    settled,
    started,
    state_of,
)
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.observations.pose_reading import read_static
from app.kinematics import load_robot
from app.recordings import read_table
from app.recordings.arm import robot_for
from benchmarks.real_static import data_folder
from benchmarks.rows import Row, quickest
from tests.diagnosis.kinematic.simulating import poses, term, tracker_rows, write_tracker

ROBOT = "ur10e"
#: Poses -> aim with one effect [s], start-up not counted.
AIMS = {60: 0.029, 200: 0.053, 1000: 0.14, 10_000: 5.0}
#: Recordings of the data folder -> aim [s] for their number of rows.
REAL = {
    "ur5_tracker/run_b.csv": 0.1,
    "ur5_bag_tracker/run_a.csv": 0.3,
    "iiwa7_tracker/run_a.csv": 0.3,
    "mukca/run_a.csv": 0.3,
    "ur5_tracker/run_a.csv": 1.0,
    "ur10_tracker/run_a.csv": 2.0,
}
MEMORY_MB = 500.0
FITTED = 200
#: Share by which two residuals may differ and count as the same.
SAME = 0.01


def recording(folder: Path, robot, rows: int, terms=()):
    """A tracker recording of random poses, 0.15 mm noise."""
    rng = np.random.default_rng(rows)
    q = poses(robot, rng, rows)
    return write_tracker(folder / f"r{rows}.csv", robot, q, tracker_rows(robot, q, terms, rng=rng))


def run() -> list[Row]:
    """All figures."""
    robot = load_robot(ROBOT)
    hidden = (term("joint_compliance", {"joint": 2, "driver": "gravity_torque"}, 1e-5),)
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for count, aim in AIMS.items():
            for what, terms in (("clean", ()), ("one effect", hidden)):
                path = recording(folder, robot, count, terms).path
                seconds = _diagnosed(path, robot, 3 if count < 10_000 else 1)
                rows.append(Row(f"diagnose {count} poses, 199 nulls, {what}", seconds, aim=aim))
        memory = float(subprocess.run(
            [sys.executable, "-c", _MEMORY, str(folder / "r10000.csv"), ROBOT], capture_output=True, text=True,
            check=True,
        ).stdout)  # fmt: skip
        rows.append(Row("its memory, 10,000 poses", memory, unit="MB", aim=MEMORY_MB))
        rows += _geometric_fits(folder, robot)
    for name, aim in REAL.items():
        path = data_folder() / name
        if path.exists():
            table = read_table(path)
            seconds = _diagnosed(path, robot_for(table), 2)
            rows.append(Row(f"diagnose {name}, {len(table)} rows", seconds, aim=aim))
    return rows


def _diagnosed(path: Path, robot, times: int) -> float:
    """Seconds of a diagnosis; the file is read before the clock starts, and anew each time."""
    best = float("inf")
    for _ in range(times):
        table = read_table(path)
        len(table)
        best = min(best, quickest(lambda t=table: diagnose(t, robot), 1))
    return best


_MEMORY = """
import resource, sys
from app.diagnosis.kinematic.diagnose import diagnose
from app.kinematics import load_robot
from app.recordings import read_table
from app.recordings.arm import robot_for
from benchmarks.real_static import data_folder
from app.recordings import read_table
diagnose(read_table(sys.argv[1]), load_robot(sys.argv[2]))
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""


def _geometric_fits(folder: Path, robot) -> list[Row]:
    """The same data, residual and start for all; each runs until it stops moving."""
    hidden = tuple(term("link_length", {"link": k, "axis": "a"}, 4e-4) for k in range(1, 6))
    recorded = read_static(recording(folder, robot, FITTED, hidden), robot)
    start = settled(started(recorded, (), even_weights(recorded, np.full((FITTED, 3), 1.5e-4), 0.0)))
    library = library_of(recorded.situation)
    free = [
        i
        for i, c in enumerate(library.fixed)
        if c.effect.always and c.place.member and not c.place.where.get("driver")
    ]
    terms = tuple(
        Term(library.fixed[i].effect, library.fixed[i].place, np.zeros(len(library.fixed[i].widths)))
        for i in free
    )

    def jacobian(state: State) -> np.ndarray:
        columns = columns_of(state)
        blocks = [t.effect.columns(columns, t.place).reshape(state.weights.size, -1) for t in terms]
        return np.hstack([free_columns(state, columns)[0], *blocks])

    def stepped(state: State, step: np.ndarray) -> State:
        count = len(step) - sum(len(t.values) for t in terms)
        setup, at, out = moved(state.setup, recorded, step[:count]), count, []
        for t in state.terms:
            out.append(replace(t, values=t.values + step[at : at + len(t.values)]))
            at += len(t.values)
        return state_of(recorded, setup, tuple(out), state.weights)

    first = state_of(recorded, start.setup, terms, start.weights)
    scale = np.linalg.norm(jacobian(first), axis=0)
    scale = np.where(scale > 1e-9, scale, np.inf)

    def ours() -> State:
        """Gauss-Newton along columns worked out once: over a fit of fractions of a millimetre they hardly move."""
        now, scaled = first, jacobian(first) / scale
        values, vectors = np.linalg.eigh(scaled.T @ scaled)
        inside = values > 1e-9 * values[-1]
        half, values = vectors[:, inside], values[inside]
        for _ in range(6):
            along = half.T @ (scaled.T @ now.white)
            if along @ (along / values) < 1e-7 * now.squares:  # what a step would still gain
                break
            now = stepped(now, half @ (along / values) / scale)
        return now

    def whitened(x: np.ndarray) -> np.ndarray:
        """The residual alone, no columns: all that finite differences ask for."""
        return stepped(first, x / scale).white

    def peer():
        return least_squares(whitened, np.zeros(len(scale)), method="trf")

    reached, theirs = ours(), peer()
    assert reached.squares <= 1.001 * 2.0 * theirs.cost, (reached.squares, 2.0 * theirs.cost)
    name = f"full geometric fit, {FITTED} poses, {len(scale)} parameters"
    seconds = quickest(ours, 5)
    rows = [
        Row(name, seconds, quickest(peer, 1), "scipy least_squares, finite differences of the same residual")
    ]
    try:
        figaroh = figaroh_fit(robot, start)
    except ImportError:
        return rows
    theirs_rms, ours_rms = figaroh.solve(), float(np.sqrt(np.mean(reached.residual**2)))
    assert abs(theirs_rms / ours_rms - 1.0) < SAME, (theirs_rms, ours_rms)
    rows.append(
        Row(name, seconds, quickest(figaroh.solve, 1), f"FIGAROH, {figaroh.size} parameters, same residual")
    )
    return rows


def figaroh_fit(robot, start):
    """FIGAROH's calibration of the same rows, from the same base and tool."""
    from benchmarks._figaroh import FigarohFit

    recording, setup = start.recording, start.setup
    turn = Rotation.from_matrix(setup.rotations[0]).as_euler("xyz")
    first = np.concatenate([setup.positions[0], turn, setup.tools[0, 0]])
    return FigarohFit(robot.model.copy(), robot.flange, recording.q, recording.points[:, 0], first)


if __name__ == "__main__":
    from benchmarks.__main__ import HEADS, line, table

    print(table([HEADS, *(line(row) for row in run())]))
