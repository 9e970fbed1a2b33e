"""Static diagnosis from 60 to 10,000 poses with 199 nulls, and a full geometric fit beside scipy's differences.

Run: python -m benchmarks.static_diagnosis
"""

from __future__ import annotations

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is imported; one thread for both sides
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from app.diagnosis.static import diagnose
from app.diagnosis.static.as_built import geometry_terms
from app.diagnosis.static.cell import pose
from app.diagnosis.static.fit import apply_terms, fit
from app.diagnosis.static.noise import component_rms
from app.diagnosis.static.plain import plain_fit
from app.diagnosis.static.reading import read_static
from app.diagnosis.static.setup import moved, residual
from app.kinematics import load_robot
from benchmarks.rows import Row, quickest
from tests.diagnosis.static.simulating import poses, term, tracker_rows, write_tracker

ROBOT = "ur10e"
#: Poses -> aim [s], start-up not counted.
AIMS = {60: 0.05, 200: 0.2, 1000: 0.5, 10_000: 4.0}
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
                table = recording(folder, robot, count, terms)
                len(table)  # the file is read before the clock starts
                seconds = quickest(lambda t=table: diagnose(t, robot), 3 if count < 10_000 else 1)
                rows.append(Row(f"diagnose {count} poses, 199 nulls, {what}", seconds, aim=aim))
        rows += _geometric_fits(folder, robot)
    return rows


def _geometric_fits(folder: Path, robot) -> list[Row]:
    """The same data, residual and start for all; each runs until it stops moving."""
    hidden = tuple(term("link_length", {"link": k, "axis": "a"}, 4e-4) for k in range(1, 6))
    start = plain_fit(read_static(recording(folder, robot, FITTED, hidden), robot), ())
    free = tuple(type(t)(t.effect, t.place, t.values, tacit=True) for t in geometry_terms(start))

    def ours():
        return fit(start.recording, start.setup, free, start.weights)

    first = fit(start.recording, start.setup, free, start.weights, iterations=0)
    scale = np.linalg.norm(first.jacobian, axis=0)

    def whitened(x: np.ndarray) -> np.ndarray:
        """The residual alone, no columns: all that finite differences ask for."""
        recording, step = first.recording, x / scale
        setup = moved(first.setup, recording, step[: first.slices[0].start])
        pairs = zip(first.terms, first.slices, strict=True)
        terms = tuple(replace(term, values=term.values + step[at]) for term, at in pairs)
        cell = apply_terms(recording.situation, terms)
        posed = pose(recording.situation, cell, setup.tool_rows(recording))
        return (residual(recording, posed, setup, cell) * first.weights).reshape(-1)

    def peer():
        return least_squares(whitened, np.zeros(first.jacobian.shape[1]), method="trf")

    reached, theirs = ours(), peer()
    assert reached.rss <= 1.001 * 2.0 * theirs.cost, (reached.rss, 2.0 * theirs.cost)
    name = f"full geometric fit, {FITTED} poses, {len(scale)} parameters"
    seconds = quickest(ours, 5)
    rows = [
        Row(name, seconds, quickest(peer, 1), "scipy least_squares, finite differences of the same residual")
    ]
    try:
        figaroh = figaroh_fit(robot, start)
    except ImportError:
        return rows
    theirs_rms, ours_rms = figaroh.solve(), component_rms(reached, ~start.recording.angular, corrected=False)
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
