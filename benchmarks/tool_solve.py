"""One seven-touch tool point, and 100,000 of them in one call, against numpy lstsq in a loop and a peer's package.

Run: python -m benchmarks.tool_solve        (scikit-surgerycalibration joins where it is installed)
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.calibration.solvers.joint import fit_joint, solve_joint
from app.geometry import exp_so3

TOUCHES, PROBLEMS, ROUNDS, CALLS = 7, 100_000, 30, 100


@dataclass(frozen=True)
class Row:
    """One line of the table; times of one problem [s]; ratio below 1 means that ours is quicker."""

    name: str
    ours: float
    peer: float
    peer_name: str

    @property
    def ratio(self) -> float:
        return self.ours / self.peer if self.peer else float("nan")


def draw(problems: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Flange rotations (m, 7, 3, 3) and positions (m, 7, 3) [m] of touches with 0.3 mm of noise."""
    tool, spike = np.array([0.1195, 0.0, 0.352]), np.array([1.2, 0.0, 1.2])
    rotations = exp_so3(rng.normal(0.0, 0.4, (problems, TOUCHES, 3)))
    positions = spike - rotations @ tool + rng.normal(0.0, 3e-4, (problems, TOUCHES, 3))
    return rotations, positions


def lstsq(rotations: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """The same problem as anybody writes it: [R_i | -I] (t, s) = -p_i."""
    count = len(positions)
    matrix = np.empty((3 * count, 6))
    matrix[:, :3] = rotations.reshape(-1, 3)
    matrix[:, 3:] = np.tile(-np.eye(3), (count, 1))
    return np.linalg.lstsq(matrix, -positions.reshape(-1), rcond=None)[0]


def surgery() -> Callable[[np.ndarray], object] | None:
    """scikit-surgerycalibration's pivot calibration, where it is installed."""
    try:
        from sksurgerycalibration.algorithms.pivot import pivot_calibration_aos
    except ImportError:
        return None
    return pivot_calibration_aos


def quickest(*functions: Callable[[int], object]) -> list[float]:
    """Seconds a call, each the best of many short rounds taken in turn, so that other load hits all alike."""
    best = [float("inf")] * len(functions)
    for _ in range(ROUNDS):
        for k, function in enumerate(functions):
            start = time.perf_counter()
            for i in range(CALLS):
                function(i)
            best[k] = min(best[k], (time.perf_counter() - start) / CALLS)
    return best


def run() -> list[Row]:
    """Measures and gives the rows; the results are compared before any time is believed."""
    rng = np.random.default_rng(0)
    rotations, positions = draw(PROBLEMS, rng)
    tools, _ = solve_joint(rotations, positions)
    worst = max(np.abs(tools[i] - lstsq(rotations[i], positions[i])[:3]).max() for i in range(CALLS))
    assert worst < 1e-9, worst
    matrices = np.tile(np.eye(4), (CALLS, TOUCHES, 1, 1))
    matrices[..., :3, :3], matrices[..., :3, 3] = rotations[:CALLS], positions[:CALLS]
    peer = surgery()
    functions: list[Callable[[int], object]] = [
        lambda i: solve_joint(rotations[i], positions[i]),
        lambda i: fit_joint(rotations[i], positions[i]),
        lambda i: lstsq(rotations[i], positions[i]),
    ]
    if peer is not None:
        functions.append(lambda i: peer(matrices[i]))
    ours, checked, plain, *others = quickest(*functions)
    batch = float("inf")
    for _ in range(3):
        begin = time.perf_counter()
        solve_joint(rotations, positions)
        batch = min(batch, time.perf_counter() - begin)
    rows = [
        Row("one tool point, 7 touches", ours, plain, "numpy lstsq"),
        Row("the same with checks and covariance", checked, plain, "numpy lstsq"),
        Row("one of 100,000 in one call", batch / PROBLEMS, plain, "numpy lstsq in a loop"),
    ]
    for other in others:
        name = "scikit-surgerycalibration"
        rows.append(Row("one tool point, 7 touches", ours, other, name))
        rows.append(Row("one of 100,000 in one call", batch / PROBLEMS, other, name + " in a loop"))
    return rows


def main() -> None:
    print(f"{'what':<40}{'ours':>11}{'peer':>11}{'ratio':>8}  peer")
    for row in run():
        times = f"{row.ours * 1e6:>8.2f} us{row.peer * 1e6:>8.1f} us{row.ratio:>8.3f}"
        print(f"{row.name:<40}{times}  {row.peer_name}")
        if row.name.startswith("one of"):
            print(f"{'':<40}{row.ours * PROBLEMS:>8.3f} s for all")


if __name__ == "__main__":
    main()
